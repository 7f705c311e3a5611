#include "family.hpp"

#include "family_list.hpp"

namespace lorentz::fuzz {

Case Family::make(std::uint64_t seed, std::uint64_t index) const {
  const std::uint64_t own = seed_for(seed, name_);
  constexpr std::uint64_t kScenes = 0x7363'656e'6573;  // a stream apart from that of the cases
  Source source{index, Random(own ^ kScenes, index / kCasesPerScene), Random(own, index)};
  return maker_(source);
}

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      generic_2d(),   generic_3d(),  near_rational(),    corridor_edge(),    grazing(),
      large_radius(), tiny_radius(), long_flight(),      boundary_starts(),  axis_and_diagonal(),
      ties(),         tricylinder(), published_faults(), crystal_lattices(), superpositions(),
      ellipsoids(),   never()};
  return all;
}

const Family* family_named(std::string_view name) {
  for (const Family& family : families())
    if (family.name() == name) return &family;
  return nullptr;
}

}  // namespace lorentz::fuzz
