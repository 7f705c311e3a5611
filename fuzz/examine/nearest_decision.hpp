// Moves a start so that a decision about an obstacle, or about two, is as close as it can be. Small blind
// moves do not get there: an ordinary query's margin is about 2^50 ulps, but the decisions that test a fast
// engine's error bounds have margins of a few ulps.
#pragma once

#include <optional>

#include <lorentz/margin.hpp>
#include "question/cases/random.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// The query with its start moved to where an obstacle is just met, where it just contains x, or where two
/// obstacles are entered at the same time. That is exact to the last bit of one component of x, and to some
/// bits more if that component can be near zero. The decision is the hardest so far, or a drawn one about the
/// obstacle that is hit. x is then rounded to the place's precision. Nothing if no obstacle is hit, or the
/// place is out of reach. The result may have any answer.
std::optional<Query> query_near_decision(cases::Random& random, const question::Place& place,
                                         const Query& query, const Answer& exact,
                                         const std::optional<oracle::HardestDecision>& hardest);

}  // namespace lorentz::fuzz
