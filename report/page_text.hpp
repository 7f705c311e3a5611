// The page without its report, made by report/web/build.mjs. Empty in a program that was built without npm.
#pragma once

#include <string_view>

namespace lorentz::report {

extern const std::string_view page_text;

}  // namespace lorentz::report
