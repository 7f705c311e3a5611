#include "cli/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/verdict.hpp>

namespace lorentz::cli {

std::uint64_t whole_number(const std::string& text, const char* option, std::uint64_t least,
                           std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool good = status == std::errc{} && end == text.data() + text.size();
  if (!good && status != std::errc::result_out_of_range) {
    double real = -1;
    try {
      real = parse_number(text);
    } catch (const InputError&) {
    }
    good = real >= 0 && real <= 0x1p53 && real == std::floor(real);
    if (good) value = static_cast<std::uint64_t>(real);
  }
  if (!good || value < least || value > most)
    throw InputError(
        fmt::format("{}: {} is no whole number from {} to {}", option, json_quoted(text), least, most));
  return value;
}

namespace {

double number(const std::string& text, const char* option) {
  try {
    return parse_number(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

}  // namespace

std::optional<double> positive_number(const std::optional<std::string>& text, const char* option) {
  if (!text) return std::nullopt;
  const double value = number(*text, option);
  if (!(value > 0)) throw InputError(fmt::format("{}: must be above zero", option));
  return value;
}

double tolerance(const std::optional<std::string>& text) {
  const double ulps = text ? number(*text, "--ulps") : oracle::kDefaultUlps;
  if (!(ulps >= 0)) throw InputError("--ulps: must not be below zero");
  if (ulps > oracle::kLargestMargin)
    throw InputError(
        fmt::format("--ulps: {} is above {}, up to which margins are known", ulps, oracle::kLargestMargin));
  return ulps;
}

}  // namespace lorentz::cli
