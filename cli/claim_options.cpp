#include "cli/claim_options.hpp"

#include <algorithm>
#include <limits>

#include "cli/numbers.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

NumberFormat number_format_named(const std::string& precision) {
  constexpr NumberFormat kFormats[] = {NumberFormat::binary64, NumberFormat::binary32};
  return kFormats[index_of_name(precision, {"binary64", "binary32"}, "--precision")];
}

std::vector<std::optional<question::Introduction>> ClaimOptions::ask(
    const std::vector<question::EngineInfo>& engines) {
  std::vector<std::optional<question::Introduction>> all;
  claim();  // reports errors of the options first
  for (const question::EngineInfo& engine : engines) {
    const auto& said = all.emplace_back(engine.introduce ? engine.introduce() : std::nullopt);
    if (!said) continue;
    if (said->precision && (!said_precision_ || bits_of(*said->precision) < bits_of(*said_precision_)))
      said_precision_ = said->precision;
    if (said->time_tolerance) said_tolerance_ = std::max(*said->time_tolerance, said_tolerance_.value_or(0));
  }
  return all;
}

Claim ClaimOptions::claim(NumberFormat otherwise) const {
  Claim claim{precision ? number_format_named(*precision) : said_precision_.value_or(otherwise),
              said_tolerance_};
  if (!time_tolerance) return claim;
  constexpr double kNotJudged = std::numeric_limits<double>::infinity();
  claim.time_tolerance = *time_tolerance == "inf" || *time_tolerance == "Inf"
                             ? kNotJudged
                             : number_from_zero(*time_tolerance, "--time-tolerance");
  return claim;
}

Option ClaimOptions::precision_row(const std::string& otherwise) {
  return {"--precision", &precision, "binary64|binary32",
          "of the engine's numbers: it is asked what consists of such numbers, and an ulp is one of them "
          "(default: what a cmd: or lib: engine says of itself, " +
              otherwise + ")"};
}

Option ClaimOptions::time_tolerance_row() {
  return {"--time-tolerance", &time_tolerance, "T",
          "a time is right if it is off by at most T times itself, not by ulps; inf: times are not judged "
          "(default: what a cmd: or lib: engine says of itself)"};
}

}  // namespace lorentz::cli
