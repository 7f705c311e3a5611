// Makes cases harder: moves that change a query a little, and a climb towards the smallest margin.
#pragma once

#include <cstdint>
#include <vector>

#include <lorentz/margin.hpp>
#include "question/cases/random.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

using question::Place;

/// The query changed by one small move: a component by ulps or by one bit, components exchanged or copied, a
/// sign, a zero, the velocity in another length, the start moved by a lattice vector or by a part of the
/// flight. It consists of numbers of the precision.
Query moved_query(cases::Random& random, const Scene& scene, const Query& query,
                  NumberFormat precision = NumberFormat::binary64);

struct Variant {
  Query query;
  Answer exact;
  std::optional<oracle::HardestDecision>
      hardest;  ///< of the decisions that a narrow search sees; nothing for `never`

  double margin() const;  ///< an upper bound; infinite for `never`
};

/// A query with its answer and its margin.
Variant seen(const Place& place, const Query& query);

/// If an ellipsoid is hit, in every second case: a flight nearly along one of its semiaxes, or such a flight
/// beside it. In the metric in which the ellipsoid is a ball, the terms of such a velocity nearly cancel. No
/// margin would lead a climb there, so the climb begins there.
std::optional<Query> along_semiaxis(cases::Random& random, const Place& place, const Variant& here);

/// The query with its start moved to where an obstacle is just met, where it just contains x, or where two
/// obstacles are entered at the same time. That is exact to the last bit of one component of x, and to some
/// bits more if that component can be near zero. The decision is the hardest so far, or a drawn one about the
/// obstacle that is hit. x is then rounded to the place's precision. Nothing if no obstacle is hit, or the
/// place is out of reach. The result may have any answer.
std::optional<Query> query_near_decision(cases::Random& random, const Place& place, const Query& query,
                                         const Answer& exact,
                                         const std::optional<oracle::HardestDecision>& hardest);

/// The query for move number `move` of a round. The first move is a start near a decision
/// (query_near_decision); the others are small moves, or exclude the obstacle that was the answer.
Query next_query(cases::Random& random, const Place& place, const Variant& here, int move);

/// A climb's rounds, and the moves tried in each.
inline constexpr int kRounds = 6, kMovesPerRound = 4;

/// In each round the climb tries a start near a decision and small moves of the best query so far; the query
/// with the smallest margin is the next to be moved. Returns all that was tried, in order. Costs kRounds *
/// kMovesPerRound exact answers and narrow searches for a margin, and about a hundred answers if a decision
/// is bisected: about 2 ms in 2D and 10 ms in 3D. Ends early at a margin of 0. All queries consist of numbers
/// of the place's precision, as the base must.
std::vector<Variant> climb(cases::Random random, const Query& base, const Place& place);

}  // namespace lorentz::fuzz
