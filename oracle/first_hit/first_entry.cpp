#include "oracle/first_hit/first_entry.hpp"

#include <vector>

#include "oracle/exact/inside.hpp"
#include "oracle/first_hit/first_hit.hpp"

namespace lorentz::oracle {
namespace {

// Returns the smallest obstacle that contains x. If no obstacle does, returns nothing, and `views` holds the
// views of all atoms in order.
template <std::size_t D>
std::optional<ObstacleId> smallest_around(const ExactScene<D>& scene, const ExactQuery<D>& query,
                                          std::vector<View<D>>& views) {
  std::size_t atoms = 0;
  for (const ExactLattice<D>& lattice : scene.lattices) atoms += lattice.atoms.size();
  views.reserve(atoms);
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
      views.push_back(query.view(scene, l, a));
      const auto n =
          smallest_inside<D>(scene, l, a, views.back(), query.from_in(l, a), query.length_exponent);
      if (n) return ObstacleId{l, a, to_cell(*n)};
    }
  return std::nullopt;
}

}  // namespace

template <std::size_t D>
std::optional<ObstacleId> smallest_around(const ExactScene<D>& scene, const ExactQuery<D>& query) {
  std::vector<View<D>> views;
  return smallest_around(scene, query, views);
}

template <std::size_t D>
Sighting<D> first_entry(const ExactScene<D>& scene, const ExactQuery<D>& query) {
  Sighting<D> seen;
  std::vector<View<D>> views;
  seen.around = smallest_around(scene, query, views);
  if (seen.around) return seen;
  auto view = views.begin();
  for_each_atom(scene, [&](int lattice, int atom) {
    search_first_hit(*view++, lattice, atom, query.from_in(lattice, atom), seen.earliest);
  });
  return seen;
}

template std::optional<ObstacleId> smallest_around(const ExactScene<2>&, const ExactQuery<2>&);
template std::optional<ObstacleId> smallest_around(const ExactScene<3>&, const ExactQuery<3>&);
template Sighting<2> first_entry(const ExactScene<2>&, const ExactQuery<2>&);
template Sighting<3> first_entry(const ExactScene<3>&, const ExactQuery<3>&);

}  // namespace lorentz::oracle
