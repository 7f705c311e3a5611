// --precision and --time-tolerance: what the judged engine claims.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include "cli/command.hpp"
#include "question/engines.hpp"

namespace lorentz::cli {

/// Of --precision. Throws InputError.
NumberFormat number_format_named(const std::string& precision);

struct ClaimOptions {
  std::optional<std::string> precision, time_tolerance;

  /// What these engines say of themselves holds where the options say nothing: of several, the coarsest. Throws
  /// InputError.
  void ask(const std::vector<question::EngineInfo>& engines);

  /// Throws InputError.
  Claim claim() const;

  Option precision_row();
  Option time_tolerance_row();

 private:
  Claim said_;  // by the engines
};

}  // namespace lorentz::cli
