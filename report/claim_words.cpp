#include "report/claim_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace lorentz::report {

namespace {

std::string range_text(const Domain::Range& range) {
  std::string text = range.low > 0 ? fmt::format("{}..", range.low) : "..";
  if (std::isfinite(range.high)) text += fmt::format("{}", range.high);
  return text;
}

// As the argument of --domain; empty for all.
std::string domain_text(const Domain& domain) {
  std::vector<std::string> parts;
  for (const auto& [name, range] : kDomainRanges)
    if (domain.*range != Domain::Range())
      parts.push_back(fmt::format("{}={}", name, range_text(domain.*range)));
  if (!domain.dimension_2 || !domain.dimension_3)
    parts.push_back(domain.dimension_2 ? "dimension=2" : "dimension=3");
  if (!domain.balls || !domain.ellipsoids) parts.push_back(domain.balls ? "shape=ball" : "shape=ellipsoid");
  if (!domain.limits) parts.push_back("limits=no");
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace

std::string words_of(const Claim& claim) {
  std::string words;
  if (claim.precision != NumberFormat::binary64) words += fmt::format(", in {}", name_of(claim.precision));
  if (const std::string domain = domain_text(claim.domain); !domain.empty()) words += ", for " + domain;
  if (claim.inside != StartInside::inside) words += fmt::format(", starts inside: {}", name_of(claim.inside));
  if (!claim.time_tolerance) return words;
  return words + (std::isinf(*claim.time_tolerance)
                      ? ", times not judged"
                      : fmt::format(", times within {}", *claim.time_tolerance));
}

std::string full_words_of(Claim claim) {
  const NumberFormat precision = std::exchange(claim.precision, NumberFormat::binary64);
  return fmt::format(" in {}{}{}", name_of(precision), claim.time_tolerance ? "" : ", times by ulps",
                     words_of(claim));
}

std::string arguments_of(const Claim& claim, double ulps) {
  std::string text;
  if (claim.precision != NumberFormat::binary64)
    text += fmt::format(" --precision {}", name_of(claim.precision));
  if (claim.time_tolerance) text += fmt::format(" --time-tolerance {}", *claim.time_tolerance);
  if (const std::string domain = domain_text(claim.domain); !domain.empty()) text += " --domain " + domain;
  if (claim.inside != StartInside::inside) text += fmt::format(" --starts-inside {}", name_of(claim.inside));
  if (ulps != oracle::kDefaultUlps) text += fmt::format(" --ulps {}", ulps);
  return text;
}

void add_claim(json::Members& object, const Claim& claim) {
  const std::string domain = domain_text(claim.domain);
  object.add("precision", name_of(claim.precision), "time_tolerance", claim.time_tolerance);
  if (!domain.empty()) object.add("domain", domain);
  if (claim.inside != StartInside::inside) object.add("starts_inside", name_of(claim.inside));
}

}  // namespace lorentz::report
