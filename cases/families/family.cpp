#include "cases/families/family.hpp"

#include "cases/families/family_list.hpp"

namespace lorentz::cases {

Case Family::make(std::uint64_t seed, std::uint64_t index) const {
  Source source{index, Random(seed, name_, index / kCasesPerScene, Use::scenes), Random(seed, name_, index)};
  return maker_(source);
}

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      generic_2d(),     generic_3d(),  near_rational(),    corridor_edge(),    grazing(),
      large_radius(),   tiny_radius(), long_flight(),      boundary_starts(),  axis_and_diagonal(),
      ties(),           tricylinder(), published_faults(), crystal_lattices(), superpositions(),
      ellipsoids(),     never(),       ball_2d(),          ball_3d(),          ellipsoid_alone(),
      rows_and_layers()};
  return all;
}

const Family* family_named(std::string_view name) {
  for (const Family& family : families())
    if (family.name() == name) return &family;
  return nullptr;
}

}  // namespace lorentz::cases
