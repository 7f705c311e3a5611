// The program lorentz_library_host, as bytes, so that it is available wherever this library is: in a program
// or in Python.
#pragma once

#include <string_view>

namespace lorentz::question {

std::string_view library_host_program();

}  // namespace lorentz::question
