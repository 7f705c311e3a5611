// Engines as campaigns ask them: some are asked in two ways at once, some tell more, some give up sooner.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <lorentz/batch.hpp>
#include "question/engines.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// Makes what a campaign examines.
question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options = {});

/// `reduction` flies both ways: at once, and along a direction prepared for many starts (or as it is told
/// here). The two must say the same, or the reply is an error.
using FlyPrepared = std::function<Flight(const Reduction&, const Query&, double max_time)>;
std::unique_ptr<question::Answerer> reduction_both_ways(FlyPrepared prepared = {});

/// Queries are flown together, and each besides alone (or as it is told here): what the two do not both say,
/// to the bit, is an error.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
std::unique_ptr<question::Answerer> batch_both_ways(FlyAlone alone = {});

/// The replies to all questions of the source, in order. Another program that was given up on the way is asked
/// the rest again, one at a time: it is no error of a query that it was not asked.
std::vector<question::Reply> replies_to(const question::Source& source, question::Answerer& answerer);

}  // namespace lorentz::fuzz
