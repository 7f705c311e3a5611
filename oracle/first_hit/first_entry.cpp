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
Sighting<D> first_entry(const ExactScene<D>& scene, const ExactQuery<D>& query, bool pass_around) {
  Sighting<D> seen;
  std::vector<View<D>> views;
  if (pass_around)
    for_each_atom(scene, [&](int lattice, int atom) { views.push_back(query.view(scene, lattice, atom)); });
  else
    seen.around = smallest_around(scene, query, views);
  if (seen.around) return seen;
  auto view = views.begin();
  for_each_atom(scene, [&](int lattice, int atom) {
    search_first_hit(*view++, lattice, atom, query.from_in(lattice, atom), seen.earliest);
  });
  return seen;
}

// Along a row the time of exit is a concave function of k, so it is least at one of the row's ends.
template <std::size_t D>
std::optional<ExactEntry<D>> first_left(const ExactScene<D>& scene, const ExactQuery<D>& query) {
  std::optional<ExactEntry<D>> first;
  const auto look = [&](int lattice, int atom, const LatticePoint<D>& point) {
    ExactEntry<D> one = query.meeting(scene, {lattice, atom, to_cell(point.n)});
    const auto key = [](const ExactEntry<D>& e) { return std::tie(e.lattice, e.atom, e.n); };
    const int order = first ? compare_entries(-first->s, first->d, first->v2, -one.s, one.d, one.v2) : -1;
    if (order < 0 || (order == 0 && key(one) < key(*first))) first = std::move(one);
  };
  for_each_atom(scene, [&](int lattice, int atom) {
    const View<D> view = query.view(scene, lattice, atom);
    const ZVec<D>* from = query.from_in(lattice, atom);
    if (!view.near) return;
    visit_ball<D>(view.basis, view.offset, view.radius2,
                  [&](LatticePoint<D> begin, const LatticePoint<D>& step, const Z& last) {
                    LatticePoint<D> end = begin;
                    end.add_multiple(last, step);
                    if (from && begin.n == *from) begin.add_multiple(1, step);
                    if (from && end.n == *from) end.add_multiple(-1, step);
                    if (from && last == 0 && begin.n != end.n) return false;  // it was the only one
                    look(lattice, atom, begin), look(lattice, atom, end);
                    return false;
                  });
  });
  return first;
}

template std::optional<ObstacleId> smallest_around(const ExactScene<2>&, const ExactQuery<2>&);
template std::optional<ObstacleId> smallest_around(const ExactScene<3>&, const ExactQuery<3>&);
template Sighting<2> first_entry(const ExactScene<2>&, const ExactQuery<2>&, bool);
template Sighting<3> first_entry(const ExactScene<3>&, const ExactQuery<3>&, bool);
template std::optional<ExactEntry<2>> first_left(const ExactScene<2>&, const ExactQuery<2>&);
template std::optional<ExactEntry<3>> first_left(const ExactScene<3>&, const ExactQuery<3>&);

}  // namespace lorentz::oracle
