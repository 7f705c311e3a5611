#include "fuzz/campaign/variants.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <lorentz/geometry.hpp>
#include "question/cases/ulps.hpp"

namespace lorentz::fuzz {

using namespace cases;

namespace {

// Flips a bit of the fraction.
double with_bit_flipped(Random& random, double x, NumberFormat precision) {
  if (precision == NumberFormat::binary32)
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(x)) ^
                                (std::uint32_t{1} << random.below(23)));
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (std::uint64_t{1} << random.below(52)));
}

// Makes one move; the result may be an invalid query.
Query one_move(Random& random, const Scene& scene, Query query, NumberFormat precision) {
  const auto dimension = static_cast<std::uint64_t>(scene.dimension);
  Vec& a = random.one_in(2) ? query.x : query.v;
  const std::uint64_t i = random.below(dimension), k = random.below(dimension);
  const std::uint64_t move = random.below(12);
  if (move < 4)
    a[i] = moved(a[i], drawn_ulps(random), precision);
  else if (move < 7)
    a[i] = with_bit_flipped(random, a[i], precision);
  else if (move == 7)
    std::swap(a[i], a[k]);
  else if (move == 8)
    a[i] = random.one_in(2) ? a[k] : random.one_in(2) ? -a[i] : 0.0;
  else if (move == 9)
    query.v = scaled(query.v, random.one_in(2) ? random.octave(-3, 3)
                                               : std::ldexp(1, static_cast<int>(random.integer(-8, 8))));
  else if (move == 10)
    query.x = sum(query.x, scaled(scene.lattices[0].vectors[i], random.sign()));
  else
    query.x = sum(query.x, scaled(query.v, std::ldexp(1, -static_cast<int>(random.integer(0, 40)))));
  return rounded(query, precision);
}

}  // namespace

Query moved_query(Random& random, const Scene& scene, const Query& query, NumberFormat precision) {
  constexpr int kTries = 8;
  for (int tries = 0; tries < kTries; ++tries) {
    Query candidate = one_move(random, scene, query, precision);
    if (!flaw_of(candidate, scene)) return candidate;
  }
  return query;
}

double Variant::margin() const {
  return hardest ? hardest->margin : std::numeric_limits<double>::infinity();
}

std::optional<Query> along_semiaxis(Random& random, const Place& place, const Variant& here) {
  const Scene& scene = place.scene();
  const Answer& exact = here.exact;
  if (exact.outcome != Outcome::hit) return std::nullopt;
  const Lattice& lattice = scene.lattices[exact.obstacle.lattice];
  const Atom& atom = lattice.atoms[exact.obstacle.atom];
  const std::vector<Vec>& axes = atom.semiaxes;
  if (axes.empty() || random.one_in(2)) return std::nullopt;
  const Vec &axis = axes[random.below(axes.size())], &other = axes[random.below(axes.size())];
  Query query = here.query;
  query.v = sum(axis, scaled(other, random.octave(-6, 3) * random.sign()));
  if (random.one_in(2)) {  // towards the atom of the cell 0, from nearby
    query.x = sum(atom.position, scaled(axis, -random.between(1.1, 3)));
    query.from.reset();
  }
  query = rounded(query, place.claim().precision);
  if (flaw_of(query, scene)) return std::nullopt;
  return query;
}

Query next_query(Random& random, const Place& place, const Variant& here, int move) {
  if (move == 0)
    if (auto near = query_near_decision(random, place, here.query, here.exact, here.hardest)) return *near;
  Query query = here.query;
  const Answer& exact = here.exact;
  if (random.one_in(12) && (exact.outcome == Outcome::hit || exact.outcome == Outcome::inside)) {
    query.from = exact.obstacle;  // asks what is hit next
    return query;
  }
  return moved_query(random, place.scene(), query, place.claim().precision);
}

Variant seen(const Place& place, const Query& query) {
  Variant variant{query, place.exact(query), {}};
  variant.hardest = place.margins().hardest_decision(query, variant.exact, 0);
  return variant;
}

std::vector<Variant> climb(Random random, const Query& base, const Place& place) {
  std::vector<Variant> tried;
  Variant best = seen(place, base);
  if (const auto along = along_semiaxis(random, place, best)) tried.push_back(best = seen(place, *along));
  for (int round = 0; round < kRounds; ++round) {
    const Variant here = best;
    for (int move = 0; move < kMovesPerRound; ++move) {
      tried.push_back(seen(place, next_query(random, place, here, move)));
      if (tried.back().margin() < best.margin()) best = tried.back();
    }
    if (best.margin() == 0) break;
  }
  return tried;
}

}  // namespace lorentz::fuzz
