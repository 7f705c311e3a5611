// Numbers as the verdict has them.
#pragma once

#include <string>

namespace lorentz::judge {

/// Two digits, or all before the point.
std::string two_digits(double a);

}  // namespace lorentz::judge
