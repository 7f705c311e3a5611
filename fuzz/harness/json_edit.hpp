// Small changes of JSON text that usually leave it JSON. Where every bit counts, random changes of bytes give
// nothing but syntax errors.
#pragma once

#include <random>
#include <string>
#include <string_view>

namespace lorentz::harness {

/// The text with one change. A number is moved a little, gets another sign or size, or is replaced by another
/// number of the text; a member, an element or a line is left out, doubled, or put in place of another.
std::string edited(std::string_view text, std::minstd_rand& random);

}  // namespace lorentz::harness
