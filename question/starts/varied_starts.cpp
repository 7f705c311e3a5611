#include "question/starts/varied_starts.hpp"

#include <lorentz/geometry.hpp>

namespace lorentz::starts {

using cases::Random;

namespace {

constexpr std::uint64_t kSeldom = 16;
constexpr int kNear = 10, kFar = 30, kSpeed = 10;  // exponents of two
constexpr double kFarVectors = 1000;

// Keeps the speed. Starts on a surface keep their velocity, which leads away from it.
bool aim_at_obstacle(Random& random, const Scene& scene, Query& query) {
  if (query.from) return false;
  const double speed = length(query.v);
  aim(random, scene, query);
  query.v = scaled(query.v, speed / length(query.v));
  return true;
}

// Moves the start, and the obstacle that it leaves, by whole cells of the first lattice. In other lattices an obstacle
// is elsewhere then: a start on the surface of one of these stays.
bool move_by_cells(Random& random, const Scene& scene, Query& query) {
  const Lattice& lattice = scene.lattices[0];
  if (query.from && query.from->lattice != 0) return false;
  const int bits = random.one_in(kSeldom) ? random.exponent(kNear, kFar) : random.exponent(0, kNear);
  for (int i = 0; i < lattice.rank_in(scene.dimension); ++i) {
    const std::int64_t n = random.integer(-(std::int64_t{1} << bits), std::int64_t{1} << bits);
    query.x = plus(query.x, static_cast<double>(n), lattice.vectors[i]);
    if (query.from) query.from->cell[i] = query.from->cell[i].int64() + n;
  }
  return true;
}

// Starts on a surface keep their velocity, which leads away from it.
bool flatten(Random& random, const Scene& scene, Query& query) {
  const int axis = random.axis(scene.dimension);
  if (query.from || !random.one_in(kSeldom)) return false;
  query.v[axis] = 0;
  return true;
}

bool change_speed(Random& random, Query& query) {
  if (random.one_in(4)) return false;
  const double factor = random.octave(-kSpeed, kSpeed);
  for (double& component : query.v) component *= factor;
  return true;
}

}  // namespace

VariedStarts::VariedStarts(const Scene& scene, std::uint64_t seed, const Claim& claim)
    : scene_(scene),
      seed_(seed),
      claim_(claim),
      uniform_(scene, Kind::uniform, seed, claim.precision),
      surface_(scene, Kind::surface, seed, claim.precision),
      certified_(scene) {}

bool VariedStarts::is_fit(const Query& query) const {
  return !flaw_of(query, scene_) && claim_.domain.has(query) && uniform_.is_free(query);
}

template <class Change>
void VariedStarts::change(Query& query, const Change& change) const {
  Query changed = query;
  if (!change(changed)) return;
  changed = rounded(changed, claim_.precision);
  if (is_fit(changed)) query = changed;
}

// In crystals only flights along a plane of the axes go on for ever, but for a few.
double VariedStarts::drawn_limit(Random& random, const Query& query) const {
  const bool is_limited = random.one_in(kSeldom),
             is_flat = query.v[0] == 0 || query.v[1] == 0 || (scene_.dimension == 3 && query.v[2] == 0);
  if (!claim_.domain.limits || !(is_limited || is_flat || !is_crystal(scene_))) return VariedStart().max_time;
  const Answer exact = certified_.first_hit(query);
  if (exact.time && !is_limited) return VariedStart().max_time;
  const Lattice& first = scene_.lattices[0];
  const double far = kFarVectors * length(first.rank != 0 ? first.vectors[0]
                                                          : semiaxes_of(first.atoms[0], scene_.dimension)[0]);
  const double time = exact.time ? *exact.time : far / length(query.v);
  const double limit = rounded(time * random.octave(-2, 2), claim_.precision);
  return limit > 0 ? limit : VariedStart().max_time;
}

VariedStart VariedStarts::operator[](std::uint64_t index) const {
  constexpr cases::Series kVaried("varied starts");
  Random random(seed_, kVaried, index);
  VariedStart start{(random.one_in(kSeldom) ? surface_ : uniform_)[index]};
  Query& query = start.query;
  if (const auto inside = claim_.domain.bring_inside(query)) query = *inside;
  if (!is_crystal(scene_) && random.one_in(2))
    change(query, [&](Query& its) { return aim_at_obstacle(random, scene_, its); });
  change(query, [&](Query& its) { return move_by_cells(random, scene_, its); });
  change(query, [&](Query& its) { return flatten(random, scene_, its); });
  change(query, [&](Query& its) { return change_speed(random, its); });
  start.max_time = drawn_limit(random, query);
  return start;
}

}  // namespace lorentz::starts
