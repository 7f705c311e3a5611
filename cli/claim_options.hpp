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

  /// What these engines say of themselves holds where the options say nothing: of several, the coarsest. Returns
  /// what each said. Throws InputError.
  std::vector<std::optional<question::Introduction>> ask(const std::vector<question::EngineInfo>& engines);

  /// `otherwise`: where neither the options nor the engines say a precision. Throws InputError.
  Claim claim(NumberFormat otherwise = NumberFormat::binary64) const;

  Option precision_row(const std::string& otherwise = "else binary64");
  Option time_tolerance_row();

 private:
  std::optional<NumberFormat> said_precision_;  // by the engines
  std::optional<double> said_tolerance_;
};

}  // namespace lorentz::cli
