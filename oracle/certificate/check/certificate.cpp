#include <lorentz/certificate.hpp>

#include <charconv>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

std::string text_of(const WindowEnd& end) {
  if (end.infinite) return "inf";
  const Z mantissa = to_z(end.mantissa);
  return std::string(mantissa < 0 ? "-0x" : "0x") + Z(abs(mantissa)).get_str(16) + "p" +
         std::to_string(end.exponent);
}

std::optional<WindowEnd> window_end_from(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  if (text.size() > kLongestText) return std::nullopt;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  text.remove_prefix(2);
  const auto take_digits = [&] {
    const std::string_view taken = text.substr(0, text.find_first_not_of(kDigits));
    text.remove_prefix(taken.size());
    return taken;
  };
  std::string digits(take_digits());
  long exponent = 0, fraction = 0;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::string_view behind = take_digits();
    digits += behind;
    fraction = static_cast<long>(behind.size());
  }
  if (digits.empty()) return std::nullopt;
  if (!text.empty()) {
    if (text.front() != 'p' && text.front() != 'P') return std::nullopt;
    text.remove_prefix(1);
    if (text.starts_with('+')) {
      text.remove_prefix(1);
      if (text.starts_with('-')) return std::nullopt;  // from_chars would take it
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  }
  constexpr long kMost = WindowEnd::kMostExponent;
  if (exponent < 4 * fraction - kMost || exponent > 4 * fraction + kMost) return std::nullopt;
  exponent -= 4 * fraction;
  const Z mantissa(digits, 16);
  return WindowEnd(to_integer(negative ? Z(-mantissa) : mantissa), exponent);
}

std::optional<double> binary64_of(const WindowEnd& end) {
  if (end.infinite) return HUGE_VAL;
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (!end.mantissa.fits_int64() || end.mantissa.int64() > kMost || end.mantissa.int64() < -kMost ||
      end.exponent > 1100 || end.exponent < -1200)
    return std::nullopt;
  const auto mantissa = static_cast<double>(end.mantissa.int64());
  const double value = std::ldexp(mantissa, static_cast<int>(end.exponent));
  const bool exact = std::isfinite(value) && std::ldexp(value, -static_cast<int>(end.exponent)) == mantissa;
  return exact ? std::optional(value) : std::nullopt;
}

}  // namespace lorentz::oracle
