// Engines as the subjects of campaigns, by name.
#pragma once

#include <string>

#include "compare/answerer.hpp"
#include "fuzz/examine/subject.hpp"

namespace lorentz::cli {

/// Makes what a campaign examines: any engine by its name, another program among them. Throws InputError for
/// an unknown name.
fuzz::MakeSubject subject_maker(const std::string& engine, const AnswererOptions& options = {});

}  // namespace lorentz::cli
