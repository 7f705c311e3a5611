#include "report/claim_words.hpp"

#include <fmt/format.h>

namespace lorentz::report {

std::string words_of(const Claim& claim) {
  std::string words;
  if (claim.precision != NumberFormat::binary64) words += fmt::format(", in {}", name_of(claim.precision));
  if (!claim.time_tolerance) return words;
  return words + (std::isinf(*claim.time_tolerance)
                      ? ", times not judged"
                      : fmt::format(", times within {}", *claim.time_tolerance));
}

std::string full_words_of(const Claim& claim) {
  const std::string precision = std::string(" in ") + name_of(claim.precision);
  if (!claim.time_tolerance) return precision + ", times by ulps";
  return precision + words_of({NumberFormat::binary64, claim.time_tolerance});
}

std::string arguments_of(const Claim& claim) {
  std::string text;
  if (claim.precision != NumberFormat::binary64)
    text += fmt::format(" --precision {}", name_of(claim.precision));
  if (claim.time_tolerance) text += fmt::format(" --time-tolerance {}", *claim.time_tolerance);
  return text;
}

void add_claim(json::Members& object, const Claim& claim) {
  object.add("precision", name_of(claim.precision), "time_tolerance", claim.time_tolerance);
}

}  // namespace lorentz::report
