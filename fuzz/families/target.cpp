#include "fuzz/families/target.hpp"

#include "fuzz/families/family_list.hpp"

namespace lorentz::cases {

Case Target::make(std::uint64_t seed, std::uint64_t index, NumberFormat precision) const {
  const std::uint64_t row = index / kCasesPerScene, count = families_.size();
  return families_[row % count].make(seed, row / count * kCasesPerScene + index % kCasesPerScene, precision);
}

const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"generic", {generic_2d(), generic_3d()}},
                                       {"near-rational", {near_rational()}},
                                       {"corridor", {corridor_edge()}},
                                       {"tricylinder", {tricylinder()}},
                                       {"grazing", {grazing()}},
                                       {"tie", {ties()}},
                                       {"corner", {axis_and_diagonal()}},
                                       {"boundary", {boundary_starts()}},
                                       {"scale", {scale()}},
                                       {"leaving", {leaving()}},
                                       {"mixture", {mixture()}},
                                       {"rounding", {rounding()}},
                                       {"dense-layers", {dense_layers()}},
                                       {"slender", {slender()}},
                                       {"early", {early()}},
                                       {"nearly-parallel", {nearly_parallel()}},
                                       {"ellipsoid-edges", {ellipsoid_edges()}},
                                       {"drift", {drift()}},
                                       {"vast-ellipsoids", {vast_ellipsoids()}},
                                       {"nearby", {nearby()}},
                                       {"unequal-radii", {unequal_radii()}},
                                       {"dense-rows", {dense_rows()}},
                                       {"far-starts", {far_starts()}},
                                       {"skewed-cells", {skewed_cells()}},
                                       {"specks", {specks()}},
                                       {"skin", {skin()}},
                                       {"sizes", {sizes()}},
                                       {"large-radius", {large_radius()}},
                                       {"tiny-radius", {tiny_radius()}},
                                       {"long-flight", {long_flight()}},
                                       {"published-faults", {published_faults()}},
                                       {"crystals", {crystal_lattices()}},
                                       {"superpositions", {superpositions()}},
                                       {"ellipsoids", {ellipsoids()}},
                                       {"never", {never()}},
                                       {"ray-ball", {ball_3d(), ball_2d(), ellipsoid_alone()}},
                                       {"rows-and-layers", {rows_and_layers()}}};
  return all;
}

const Target* target_named(std::string_view name) {
  static const std::vector<Target> halves{{"generic-2d", {generic_2d()}}, {"generic-3d", {generic_3d()}}};
  for (const auto* all : {&targets(), &halves})
    for (const Target& target : *all)
      if (target.name() == name) return &target;
  return nullptr;
}

}  // namespace lorentz::cases
