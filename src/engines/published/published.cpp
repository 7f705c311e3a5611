#include "src/engines/published/published.hpp"

#include <cmath>

#include "src/engines/published/published_bravais.hpp"
#include "src/engines/published/published_search.hpp"

namespace lorentz {
namespace {

using namespace published_search;

ObstacleId obstacle_of(const Vec& n) {
  return {0, 0, {Integer(std::llround(n[0])), Integer(std::llround(n[1])), Integer(std::llround(n[2]))}};
}

// The collision with a disc or sphere that the search came up with; its closest approach if the line misses
// it.
Answer hit_on(const Vec& centre, const Ray& ray, double r) {
  const Vec relative = minus(ray.x, centre);
  const double closest = -dot(relative, ray.v) / dot(ray.v, ray.v);
  return Answer::hit(obstacle_of(centre), entry_time(relative, ray.v, r).value_or(closest));
}

Answer published_2d(const Ray& ray, double r, const Vec* from, Proposals& proposals) {
  const Disc leaving = from ? Disc{(*from)[0], (*from)[1]} : Disc{}, v{ray.v[0], ray.v[1]};
  long passes = Published::kMaxPasses;
  PlaneResult result = first_disc({ray.x[0], ray.x[1]}, v, r, from ? &leaving : nullptr, passes);
  if (from && result.found == Found::disc && result.disc == leaving) {
    // The paper has no `from`, and its search in columns may end there: it goes on where the line leaves it.
    const double there = exit_time(minus(ray.x, *from), ray.v, r);
    result = first_disc({ray.x[0] + there * v[0], ray.x[1] + there * v[1]}, v, r, &leaving, passes);
    if (result.found == Found::disc && result.disc == leaving) return Answer::undecided();
  }
  proposals.passes += Published::kMaxPasses - passes + 1;
  if (auto answer = answer_for(result.found)) return *answer;
  ++proposals.made;
  return hit_on({result.disc[0], result.disc[1], 0}, ray, r);
}

Answer published_3d(const Ray& ray, double r, const Vec* from, Proposals& proposals) {
  const double speed = std::sqrt(dot(ray.v, ray.v));
  const Vec v{ray.v[0] / speed, ray.v[1] / speed, ray.v[2] / speed};
  const auto is_hit = [&](const Vec& centre, const Vec& x, double) {
    ++proposals.made;
    auto time = entry_time(minus(x, centre), v, r);
    if (!time) ++proposals.false_tricylinder;
    if (time && !(*time >= 0 && !(from && *from == centre))) time.reset();
    return time;
  };
  Vec centre{};
  Answer answer = first_sphere(ray.x, v, r, from, {Published::kMaxPasses, false, proposals.passes}, kNoLimit,
                               is_hit, centre);
  if (answer.outcome == Outcome::hit) return Answer::hit(obstacle_of(centre), *answer.time / speed);
  return answer;
}

bool lies_inside(const Vec& x, double r, const Vec* from) {
  const Vec home{std::round(x[0]), std::round(x[1]), std::round(x[2])};
  const Vec relative = minus(x, home);
  return dot(relative, relative) < r * r && !(from && *from == home);
}

// One ball at the origin of the unit square or cubic lattice.
Answer unit_flight(const Ray& ray, int dimension, double r, Proposals& proposals) {
  for (const double component : ray.x)
    if (!(std::fabs(component) < kMaxStart))
      return Answer::unsupported_because("start too far from the origin for binary64");
  Vec from{};
  const Vec* leaving = ray.from && cell_of(*ray.from, from) ? &from : nullptr;
  if (lies_inside(ray.x, r, leaving))
    return Answer::inside(obstacle_of({std::round(ray.x[0]), std::round(ray.x[1]), std::round(ray.x[2])}));
  return dimension == 2 ? published_2d(ray, r, leaving, proposals) : published_3d(ray, r, leaving, proposals);
}

}  // namespace

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

// The earliest hit of the atoms, each of which flies alone.
Answer Published::flight_of(const Ray& ray, double max_time, Proposals& proposals) const {
  if (atoms_.empty())
    return unit_flight(ray, scene().dimension, scene().lattices[0].atoms[0].radius, proposals);
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
