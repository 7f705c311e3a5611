#include "cli/claim_options.hpp"

#include <limits>

#include "cli/numbers.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

Claim ClaimOptions::claim(NumberFormat otherwise) const {
  constexpr NumberFormat kFormats[] = {NumberFormat::binary64, NumberFormat::binary32};
  Claim claim;
  claim.precision =
      precision ? kFormats[index_of_name(*precision, {"binary64", "binary32"}, "--precision")] : otherwise;
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
          "(default: " +
              otherwise + ")"};
}

Option ClaimOptions::time_tolerance_row() {
  return {"--time-tolerance", &time_tolerance, "T",
          "a time is right if it is off by at most T times itself, not by ulps; inf: times are not judged"};
}

}  // namespace lorentz::cli
