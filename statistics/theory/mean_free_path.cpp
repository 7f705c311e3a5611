// The mean free path between collisions, by Santalo's formula: free volume over surface.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <lorentz/scene_check.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/theory/incommensurate.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::flights {
namespace {

constexpr const char* kBeyond = "not given: beyond the range of binary64";

// Why overlaps cannot be excluded; empty if they can.
std::string overlap_in(const Scene& scene, oracle::Pairs pairs) {
  const oracle::Contacts contacts = oracle::contacts_in(scene, 1000, pairs);
  for (const oracle::Contact& contact : contacts.found)
    if (contact.overlap) return "not given: " + oracle::description_of(contact);
  return contacts.end == oracle::SearchEnd::complete
             ? ""
             : "not given: obstacles may overlap, not every pair was looked at";
}

MeanFreePath without_overlaps(const Scene& scene) {
  const std::optional<Filling> filling = filling_of(scene);
  if (!filling) return {std::nullopt, kBeyond};
  return {filling->mean_free_path, "exact: free volume over surface"};
}

// Each lattice covers its share of the space and of the surface that the others leave free.
MeanFreePath of_independent(const Scene& scene) {
  double free = 1, surface = 0;
  for (const Lattice& lattice : scene.lattices) {
    const std::optional<Filling> filling = filling_of({scene.dimension, {lattice}});
    if (!filling) return {std::nullopt, kBeyond};
    surface = surface * (1 - filling->fraction) + filling->surface * free;
    free *= 1 - filling->fraction;
  }
  const double mean = (scene.dimension == 2 ? std::numbers::pi : 4) * free / surface;
  if (!std::isfinite(mean)) return {std::nullopt, kBeyond};
  return {mean, "exact for incommensurate lattices: free volume over surface, with overlaps"};
}

}  // namespace

MeanFreePath mean_free_path_of(const Scene& scene) {
  if (!is_crystal(scene))
    return {std::nullopt, "not given: most flights never end, because the scene is not a crystal"};
  if (std::string why = overlap_in(scene, oracle::Pairs::within_lattices); !why.empty())
    return {std::nullopt, why};
  if (scene.lattices.size() == 1) return without_overlaps(scene);
  if (independent(scene)) return of_independent(scene);
  if (std::string why = overlap_in(scene, oracle::Pairs::all); !why.empty()) return {std::nullopt, why};
  return without_overlaps(scene);
}

}  // namespace lorentz::flights
