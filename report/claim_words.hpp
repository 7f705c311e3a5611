// The claim by which an engine was judged: in words, as arguments and as JSON.
#pragma once

#include <string>

#include <lorentz/claim.hpp>
#include <lorentz/verdict.hpp>
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

/// ", in binary32, times within 1e-4"; empty for binary64 and times judged by ulps.
std::string words_of(const Claim& claim);

/// " in binary64, times by ulps": always has both.
std::string full_words_of(Claim claim);

/// As arguments, each with a space before it, with the tolerance; empty if all is as usual.
std::string arguments_of(const Claim& claim, double ulps = oracle::kDefaultUlps);

void add_claim(json::Members& object, const Claim& claim);

}  // namespace lorentz::report
