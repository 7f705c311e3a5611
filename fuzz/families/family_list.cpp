// All families by name: those that golden sets are made of, and the targets of campaigns. The order of both lists, the
// targets' names and the families' names must stay, because cases, sets and findings depend on them.
#include "fuzz/families/family.hpp"

namespace lorentz::cases {

// Each is defined in a file of its own or with related ones.
Family generic_2d(), generic_3d(), near_rational(), corridor_edge(), grazing(), large_radius(), tiny_radius(),
    long_flight(), boundary_starts(), axis_and_diagonal(), ties(), tricylinder(), published_faults(),
    crystal_lattices(), superpositions(), ellipsoids(), never(), ball_2d(), ball_3d(), ellipsoid_alone(),
    rows_and_layers(), leaving(), scale(), mixture(), rounding(), dense_layers(), slender(), early(),
    nearly_parallel(), ellipsoid_edges(), drift(), vast_ellipsoids(), nearby(), unequal_radii(), dense_rows(),
    far_starts(), skewed_cells(), specks(), skin(), sizes();

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
