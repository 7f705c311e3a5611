#include "cli/claim_options.hpp"

#include <algorithm>
#include <limits>

#include "cli/numbers.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

NumberFormat number_format_named(const std::string& precision) {
  const std::size_t number = index_of_name(precision, {"binary64", "binary32"}, "--precision");
  return number == 1 ? NumberFormat::binary32 : NumberFormat::binary64;
}

void ClaimOptions::ask(const std::vector<question::EngineInfo>& engines) {
  claim();  // what is wrong with the options is said first
  for (const question::EngineInfo& engine : engines) {
    const auto introduction = engine.introduce ? engine.introduce() : std::nullopt;
    if (!introduction) continue;
    const Claim& one = introduction->claim;
    if (bits_of(one.precision) < bits_of(said_.precision)) said_.precision = one.precision;
    if (one.time_tolerance)
      said_.time_tolerance = std::max(*one.time_tolerance, said_.time_tolerance.value_or(0));
  }
}

Claim ClaimOptions::claim() const {
  Claim claim = said_;
  if (precision) claim.precision = number_format_named(*precision);
  if (!time_tolerance) return claim;
  constexpr double kNotJudged = std::numeric_limits<double>::infinity();
  claim.time_tolerance = *time_tolerance == "inf" || *time_tolerance == "Inf"
                             ? kNotJudged
                             : number_from_zero(*time_tolerance, "--time-tolerance");
  return claim;
}

Option ClaimOptions::precision_row() {
  return {"--precision", &precision, "binary64|binary32",
          "of the engine's numbers: it is asked what consists of such numbers, and an ulp is one of them "
          "(default: what a "
          "cmd: engine says of itself, else binary64)"};
}

Option ClaimOptions::time_tolerance_row() {
  return {"--time-tolerance", &time_tolerance, "T",
          "a time is right if it is off by at most T times itself, not by ulps; inf: times are not judged "
          "(default: what a "
          "cmd: engine says of itself)"};
}

}  // namespace lorentz::cli
