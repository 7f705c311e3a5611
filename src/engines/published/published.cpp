#include "src/engines/published/published.hpp"

#include <lorentz/engine_base.hpp>
#include "src/engines/published/published_bravais.hpp"
#include "src/engines/published/published_unit.hpp"

namespace lorentz {
std::optional<std::string> Published::beyond(const Scene& scene) {
  if (is_unit_scene(scene)) {
    if (scene.lattices[0].atoms[0].radius > 0.5) return "does radii up to half the spacing only";
    return std::nullopt;
  }
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      if (auto why = PublishedBravais::beyond(scene, l, a)) return why;
  return std::nullopt;
}

Published::Published(const Scene& scene) : Engine(scene) {
  if (is_unit_scene(scene)) return;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      atoms_.emplace_back(scene, l, a);
}

Published::~Published() = default;

Answer Published::first_hit_counted(const Query& query, double max_time, Proposals& proposals) const {
  Answer answer;
  first_hit_by(query, max_time, answer, [&](const Ray& ray, double limit, Answer& given) {
    given = flight_of(ray, limit, proposals);
  });
  return answer;
}

// The earliest hit among the atoms, each of which is searched alone.
Answer Published::flight_of(const Ray& ray, double max_time, Proposals& proposals) const {
  if (atoms_.empty())
    return published_search::unit_flight<double>(ray, scene().dimension, scene().lattices[0].atoms[0].radius,
                                                 proposals);
  for (const PublishedBravais& atom : atoms_)
    if (auto answer = atom.start(ray)) return *answer;
  Answer first = Answer::never();
  double limit = max_time;
  for (const PublishedBravais& atom : atoms_) {
    Answer answer = atom.flight_of(ray, limit, proposals);
    if (answer.outcome == Outcome::undecided || answer.outcome == Outcome::error) return answer;
    if (answer.outcome != Outcome::hit || !(*answer.time < limit)) continue;
    limit = *answer.time;
    first = std::move(answer);
  }
  return first;
}

}  // namespace lorentz
