// --precision and --time-tolerance: what the judged engine claims.
#pragma once

#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include "cli/command.hpp"

namespace lorentz::cli {

struct ClaimOptions {
  std::optional<std::string> precision;  ///< binary64, unless `otherwise` says so
  std::optional<std::string> time_tolerance;

  /// Throws InputError.
  Claim claim(NumberFormat otherwise = NumberFormat::binary64) const;

  Option precision_row(const std::string& otherwise = "binary64");
  Option time_tolerance_row();
};

}  // namespace lorentz::cli
