// Engines as campaigns ask them: some are asked in two ways at once, some report more, some give up sooner.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <lorentz/batch.hpp>
#include "question/engines.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// Makes the answerers that a campaign examines.
question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options = {});

/// `reduction` flies both ways: at once, and along a direction prepared for many starts (or by the function
/// given here). The two answers must be the same, or the reply is an error.
using FlyPrepared = std::function<Flight(const Reduction&, const Query&, double max_time)>;
std::unique_ptr<question::Answerer> reduction_both_ways(FlyPrepared prepared = {});

/// Queries are flown together, and each one also alone (or by the function given here). If the two answers
/// are not the same to the bit, the reply is an error.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
std::unique_ptr<question::Answerer> batch_both_ways(FlyAlone alone = {});

/// The replies to all questions of the source, in order. If another program was given up on the way, the rest
/// is asked again, one question at a time: a query is not in error because it was not asked.
std::vector<question::Reply> replies_to(const question::Source& source, question::Answerer& answerer);

}  // namespace lorentz::fuzz
