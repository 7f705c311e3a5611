// Engines as the subjects of campaigns, by name.
#pragma once

#include <string>

#include "compare/answerer.hpp"
#include "fuzz/examine/subject.hpp"

namespace lorentz::fuzz {

/// Makes what a campaign examines: any engine by its name, another program among them. Throws InputError for
/// an unknown name.
MakeSubject subject_maker(const std::string& engine, const compare::AnswererOptions& options = {});

}  // namespace lorentz::fuzz
