// Makes a case readable while it keeps failing: fewer bits in every number, smaller integers, a simpler
// scene, no `from`, a shorter flight.
#pragma once

#include <functional>
#include <memory>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/question.hpp"

namespace lorentz::fuzz {

/// Whether a case still fails in the way that is to be kept. The case may have flaws.
using StillFails = std::function<bool(const Scene&, const Query&)>;

/// The same for a case without flaws, of numbers of the place's precision, in a scene that is sound and sane.
/// Makes a place once for each scene.
StillFails in_places(
    const std::function<std::shared_ptr<question::Place>(const Scene&)>& place_of,
    const std::function<bool(const std::shared_ptr<question::Place>&, const Query&)>& still_fails);

/// The length of the flight in the case that StillFails last said yes to.
using FlightLength = std::function<double()>;

/// The number of significant bits: 1 for powers of two, 0 for 0.
int bits_of(double x);

/// The largest number of significant bits in the case.
int most_bits(const Scene& scene, const Query& query);

/// The quantity that shrinking reduces. Lattices, atoms, ellipsoids and `from` dominate it; then come ten for
/// each bit of each number, and a little for exponents and signs.
long complexity(const Scene& scene, const Query& query);

/// The cost of a case in units of an ordinary try: 1 if the numbers of the case spread over up to
/// kOrdinarySpread bits, from the highest to the lowest. Exact answers take integers of several times that,
/// and a time that grows with its square.
double price(const Scene& scene, const Query& query);
inline constexpr int kOrdinarySpread = 512;

/// False if the scene is so dense that an oracle, asked which of a million obstacles contain x, is slow.
/// Shrinking does not go there.
bool is_sane(const Scene& scene);

inline constexpr int kShrinkTries = 3000;

/// When shrinking has cost enough.
struct ShrinkBudget {
  double tries = kShrinkTries;       ///< measured by price()
  std::function<bool()> is_up = {};  ///< any other reason to stop
};

struct Shrunk {
  Scene scene;
  Query query;
  int tries = 0;  ///< number of cases asked
};

/// The simplest case found by greedy steps. Each step makes complexity() smaller (or the flight shorter at no
/// greater complexity) and keeps the failure. Asks about no case twice, and about none beyond the budget; the
/// result depends on the answers alone. The given case must fail.
Shrunk shrink(const Scene& scene, const Query& query, const StillFails& still_fails,
              const FlightLength& length = {}, const ShrinkBudget& budget = {});

}  // namespace lorentz::fuzz
