// Engines as the subjects of campaigns, by name.
#pragma once

#include <functional>
#include <string>

#include <lorentz/reduction.hpp>
#include "compare/answerer.hpp"
#include "compare/engines.hpp"
#include "fuzz/examine/subject.hpp"

namespace lorentz::fuzz {

/// Makes what a campaign examines.
MakeSubject subject_maker(const compare::EngineInfo& engine, const compare::AnswererOptions& options = {});

/// `reduction` flies both ways: at once, and along a direction prepared for many starts (or as it is told
/// here). The two must say the same, or the reply is an error.
using FlyPrepared = std::function<Flight(const Reduction&, const Query&, double max_time)>;
std::unique_ptr<Subject> make_reduction_subject(FlyPrepared prepared = {});

}  // namespace lorentz::fuzz
