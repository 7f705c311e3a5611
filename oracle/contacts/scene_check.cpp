#include <lorentz/scene_check.hpp>

#include "oracle/exact/dependence.hpp"

namespace lorentz::oracle {

std::optional<std::string> dependence_in(const Scene& scene) {
  return dependence_of(scene);
}

std::string description_of(const Contact& contact) {
  const auto name = [](int lattice, int atom) {
    return "lattice " + std::to_string(lattice) + ", atom " + std::to_string(atom);
  };
  const std::string first = name(contact.lattice, contact.atom),
                    second = name(contact.other_lattice, contact.other_atom),
                    verb = contact.overlap ? " overlap" : " touch";
  if (first == second) return "the obstacles of " + first + verb + " their own translates";
  return "obstacles of " + first + " and of " + second + verb;
}

}  // namespace lorentz::oracle
