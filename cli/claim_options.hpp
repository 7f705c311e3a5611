// --precision and --time-tolerance: what the judged engine claims.
#pragma once

#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include "cli/command.hpp"

namespace lorentz::cli {

struct ClaimOptions {
  std::string precision = "binary64";
  std::optional<std::string> time_tolerance;

  /// Throws InputError.
  Claim claim() const;

  Option precision_row();
  Option time_tolerance_row();
};

}  // namespace lorentz::cli
