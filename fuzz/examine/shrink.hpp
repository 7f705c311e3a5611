// Making a case readable while it keeps failing: fewer bits in every number, smaller integers, a simpler
// scene, no `from`, a shorter flight.
#pragma once

#include <functional>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::fuzz {

/// Whether a case still fails in the way that is to be kept. It is asked of cases that may have flaws, too.
using StillFails = std::function<bool(const Scene&, const Query&)>;

/// How long the flight is that the case which StillFails last said yes to asks for.
using FlightLength = std::function<double()>;

/// The significant bits of a number: 1 of powers of two, 0 of 0.
int bits_of(double x);

/// The most that any number of the case has.
int most_bits(const Scene& scene, const Query& query);

/// What shrinking makes smaller: dominated by lattices, atoms, ellipsoids, `from`; then ten for each bit of
/// each number, and a little for exponents and signs.
long complexity(const Scene& scene, const Query& query);

/// How many tries it takes to ask about a case, in money of ordinary ones: 1 where the numbers of the case
/// spread over up to kOrdinarySpread bits, from the highest to the lowest. Exact answers take integers of
/// several times that, and a time that grows with its square.
double price(const Scene& scene, const Query& query);
inline constexpr int kOrdinarySpread = 512;

/// Not so dense that an oracle, asked which of a million obstacles contain x, takes its time: where shrinking
/// does not go.
bool is_sane(const Scene& scene);

inline constexpr int kShrinkTries = 3000;

/// When shrinking has cost enough.
struct ShrinkBudget {
  double tries = kShrinkTries;       ///< by their price()
  std::function<bool()> is_up = {};  ///< what else there is to say about it
};

struct Shrunk {
  Scene scene;
  Query query;
  int tries = 0;  ///< cases that were asked about
};

/// The simplest case found by greedy steps, each of which makes complexity() smaller (or the flight shorter
/// at no greater complexity) and keeps the failure. Asks about no case twice, and about none beyond the
/// budget; the same for the same answers. The case itself must fail.
Shrunk shrink(const Scene& scene, const Query& query, const StillFails& still_fails,
              const FlightLength& length = {}, const ShrinkBudget& budget = {});

}  // namespace lorentz::fuzz
