#include "question/starts/free_starts.hpp"

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/ulps.hpp"
#include "question/starts/surface.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::starts {

using cases::Random;
using cases::Series;

const std::vector<std::string>& kind_names() {
  static const std::vector<std::string> names{"uniform", "surface", "near-rational", "grazing"};
  return names;
}

Kind kind_named(const std::string& name, const std::string& what) {
  return static_cast<Kind>(index_of_name(name, kind_names(), what));
}

flights::Ensemble ensemble_named(const std::string& name, const std::string& what) {
  return static_cast<flights::Ensemble>(index_of_name(name, {"uniform", "surface"}, what));
}

namespace {

// A primitive vector of one of the lattices, with components up to 9, or a direction beside it: off by up to
// 3 ulps in each non-zero component, or by 2^-40 to 2^-52 of its size towards another lattice vector (in
// binary32 by 2^-11 to 2^-23).
Vec near_rational_direction(Random& random, const Scene& scene, NumberFormat format) {
  constexpr std::int64_t kRange = 9, kUlps = 3;
  const int d = scene.dimension;
  Lattice lattice = scene.lattices[random.below(scene.lattices.size())];
  if (lattice.rank < scene.dimension) lattice.vectors = cases::Box::of(scene).vectors;
  Vec v = cases::cartesian(lattice, cases::drawn_primitive(random, d, kRange));
  if (random.one_in(2)) {
    cases::jitter(random, v, d, kUlps << (53 - bits_of(format)));
    return v;
  }
  const Vec aside = cases::cartesian(lattice, cases::drawn_primitive(random, d, kRange));
  return sum(v, scaled(aside, random.sign() * random.octave(1 - bits_of(format), 13 - bits_of(format))));
}

}  // namespace

FreeStarts::FreeStarts(const Scene& scene, Kind kind, std::uint64_t seed, NumberFormat format)
    : scene_(scene),
      kind_(kind),
      seed_(seed),
      format_(format),
      candidates_(scene, kind == Kind::surface ? flights::Ensemble::surface : flights::Ensemble::uniform,
                  seed),
      oracle_(scene),
      certified_(scene) {}

bool FreeStarts::is_free(const Query& start) const {
  oracle::Request at_once;
  at_once.max_time = 0;
  return certified_.first_hit(start, at_once).outcome != Outcome::inside;
}

bool FreeStarts::make(Random& random, Query& start) const {
  if (kind_ == Kind::grazing) {
    if (!is_crystal(scene_)) aim(random, scene_, start);
    const auto off_edge = [&] { return random.sign() * random.octave(1 - bits_of(format_), -10); };
    return cases::move_to_edge(off_edge, scene_, oracle_, start);
  }
  if (!is_free(start)) return false;
  if (kind_ == Kind::near_rational) start.v = near_rational_direction(random, scene_, format_);
  return true;
}

bool FreeStarts::round(Query& start) const {
  if (format_ == NumberFormat::binary64) return true;
  start = rounded(start, format_);
  return !flaw_of(start, scene_) && is_free(start);
}

void aim(Random& random, const Scene& scene, Query& start) {
  const Lattice& lattice = scene.lattices[random.below(scene.lattices.size())];
  const Atom& atom = lattice.atoms[random.below(lattice.atoms.size())];
  const Vec aside = Surface(atom, scene.dimension).point(random).offset;
  const Vec aim = plus(sum(atom.position, scaled(aside, random.uniform())), -1, start.x);
  if (aim != Vec{}) start.v = aim;
}

void FreeStarts::draw(std::uint64_t index, Query& start) const {
  constexpr Series kHard("hard starts");
  for (std::uint64_t attempt = 0; attempt < Candidates::kMostAttempts; ++attempt) {
    Random random(seed_, kHard, index, cases::Use::cases, attempt);
    candidates_.draw(index, attempt, start);
    if (make(random, start) && round(start)) return;
  }
  throw InputError(nowhere_to_start(Candidates::kMostAttempts));
}

}  // namespace lorentz::starts
