// Numbers as the verdict has them.
#pragma once

#include <optional>
#include <string>

namespace lorentz::judge {

struct JudgeReport;

/// "Ball 1.2", if the engine says its name.
std::optional<std::string> library_text(const JudgeReport& report);

/// Two digits, or all before the point.
std::string two_digits(double a);

}  // namespace lorentz::judge
