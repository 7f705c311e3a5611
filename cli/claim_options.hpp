// --precision, --time-tolerance, --domain and --starts-inside: the claims of the judged engine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include "cli/command.hpp"
#include "question/engines.hpp"
#include "report/files/unknown_keys.hpp"

namespace lorentz::cli {

/// The number format that --precision names. Throws InputError.
NumberFormat number_format_named(const std::string& precision);

struct ClaimOptions {
  std::optional<std::string> precision, time_tolerance, domain, starts_inside;

  /// Asks the engines for their own claims. They apply where the options do not set a value; the coarsest
  /// claim applies if there are several; their domains and rules for starts inside must be the same. Returns the
  /// claim of each engine. Throws InputError.
  std::vector<std::optional<question::Introduction>> ask(const std::vector<question::EngineInfo>& engines,
                                                         bool strict = false);

  /// `otherwise`: the precision if neither the options nor the engines set one. Throws InputError.
  Claim claim(NumberFormat otherwise = NumberFormat::binary64) const;

  Option precision_row(const std::string& otherwise = "else binary64");
  Option time_tolerance_row();
  Option domain_row();
  Option starts_inside_row();

 private:
  std::optional<NumberFormat> said_precision_;  // by the engines
  std::optional<double> said_tolerance_;
  std::optional<Domain> said_domain_;
  std::optional<StartInside> said_inside_;
};

}  // namespace lorentz::cli
