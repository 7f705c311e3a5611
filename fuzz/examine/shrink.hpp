// Making a case readable while it keeps failing: fewer bits in every number, smaller integers, a simpler
// scene, no `from`, a shorter flight.
#pragma once

#include <functional>

#include <lorentz/problem.hpp>

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

inline constexpr int kShrinkTries = 3000;

struct Shrunk {
  Scene scene;
  Query query;
  int tries = 0;  ///< cases that were asked about
};

/// The simplest case found by greedy steps, each of which makes complexity() smaller (or the flight shorter
/// at no greater complexity) and keeps the failure. Asks about `tries` cases at the most, of none twice; the
/// same for the same answers. The case itself must fail.
Shrunk shrink(const Scene& scene, const Query& query, const StillFails& still_fails,
              const FlightLength& length = {}, int tries = kShrinkTries);

}  // namespace lorentz::fuzz
