#include "report/scene_name.hpp"

#include <fmt/format.h>

namespace lorentz::report {

std::optional<double> common_radius(const Scene& scene) {
  std::optional<double> radius;
  bool same = true;
  for_each_atom(scene, [&](const Atom& atom) {
    same = same && atom.is_ball() && (!radius || *radius == atom.radius);
    radius = atom.radius;
  });
  return same ? radius : std::nullopt;
}

std::string name_with_radius(const std::string& name, const Scene& scene) {
  const std::optional<double> radius = common_radius(scene);
  return radius ? fmt::format("{}, r = {:g}", name, *radius) : name;
}

}  // namespace lorentz::report
