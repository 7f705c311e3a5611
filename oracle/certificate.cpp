#include "certificate.hpp"

#include <charconv>

#include "integer.hpp"

namespace lorentz::oracle {

std::string text_of(const WindowEnd& end) {
  const Z mantissa = to_z(end.mantissa);
  return std::string(mantissa < 0 ? "-0x" : "0x") + Z(abs(mantissa)).get_str(16) + "p" +
         std::to_string(end.exponent);
}

std::optional<WindowEnd> window_end_from(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  if (!text.starts_with("0x")) return std::nullopt;
  text.remove_prefix(2);
  const std::size_t digits = std::min(text.find_first_not_of(kDigits), text.size());
  if (digits == 0 || digits == text.size() || text[digits] != 'p') return std::nullopt;
  const std::string_view exponent_text = text.substr(digits + 1);
  long exponent = 0;
  const auto [end, error] =
      std::from_chars(exponent_text.data(), exponent_text.data() + exponent_text.size(), exponent);
  if (error != std::errc() || end != exponent_text.data() + exponent_text.size()) return std::nullopt;
  const Z mantissa(std::string(text.substr(0, digits)), 16);
  return WindowEnd(to_integer(negative ? Z(-mantissa) : mantissa), exponent);
}

std::optional<double> binary64_of(const WindowEnd& end) {
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
