// Small changes of JSON text that leave it JSON, mostly: where every bit counts, bytes changed at random come
// to nothing but syntax errors.
#pragma once

#include <random>
#include <string>
#include <string_view>

namespace lorentz::harness {

/// The text with one change: a number moved a little, or its sign, its size, or by another of the text; a
/// member, an element or a line left out, doubled, or in place of another.
std::string edited(std::string_view text, std::minstd_rand& random);

}  // namespace lorentz::harness
