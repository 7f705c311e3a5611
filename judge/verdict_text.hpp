// Texts and numbers in the form that the verdict prints.
#pragma once

#include <optional>
#include <string>

namespace lorentz::judge {

struct JudgeReport;

/// "Ball 1.2", if the engine reports its name.
std::optional<std::string> library_text(const JudgeReport& report);

/// A number with two digits, or with all digits before the point.
std::string two_digits(double a);

}  // namespace lorentz::judge
