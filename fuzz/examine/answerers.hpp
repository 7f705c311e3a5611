// Engines as campaigns ask them.
#pragma once

#include <vector>

#include "question/engines.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// Makes the answerers that a campaign examines.
question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options = {});

/// The replies to all questions of the source, in order. If another program was given up on the way, the rest
/// is asked again, one question at a time: a query is not in error because it was not asked.
std::vector<question::Reply> replies_to(const question::Source& source, question::Answerer& answerer);

}  // namespace lorentz::fuzz
