// A start moved so that a decision about an obstacle, or about two, is as close as it can be. Small
// blind moves do not come there: of an ordinary query the margin is some 2^50 ulps, and the decisions whose
// error bounds a fast engine lives by are those within a few.
#pragma once

#include <optional>

#include <lorentz/margin.hpp>
#include "cases/random.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// The query with its start moved to where an obstacle is just met, where it just contains x, or where two
/// are entered at the same time, to the last bit that one component of x has, and some bits further if that
/// component can be near zero. Of the decisions it takes the hardest so far, or draws one about the obstacle
/// that is hit. x then is rounded to the place's precision. Nothing if no obstacle is hit, or the place is out of reach; the result may have any answer.
std::optional<Query> query_near_decision(cases::Random& random, const question::Place& place,
                                         const Query& query, const Answer& exact,
                                         const std::optional<oracle::HardestDecision>& hardest);

}  // namespace lorentz::fuzz
