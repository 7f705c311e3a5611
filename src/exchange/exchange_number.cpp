#include "src/exchange/exchange_number.hpp"

#include <charconv>
#include <clocale>
#include <cstdlib>
#include <string>

namespace lorentz {
namespace {

// The end of the digits that begin at `place`.
std::size_t after_digits(std::string_view text, std::size_t place) {
  while (place < text.size() && is_digit(text[place])) ++place;
  return place;
}

struct Notation {
  std::chars_format format;
  std::string_view prefix, digits;
};

constexpr Notation kDecimal{std::chars_format::general, "", "0123456789"};
constexpr Notation kHexadecimal{std::chars_format::hex, "0x", "0123456789abcdefABCDEF"};

// strtod rounds correctly, too, and knows the large from the small, however long the number is and however
// its digits and its exponent make up for each other. It expects the decimal point of a locale: here that of
// C.
double nearest_of_long(const std::string& text) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text.c_str(), nullptr, c_locale);
}

// std::from_chars rounds correctly, but reports "out of range" both for numbers that are too large and for
// numbers that are too small. Its exponents end somewhere beyond 2^16; with more digits than that, digits and
// exponent may make up for each other.
std::optional<double> nearest_unsigned(std::string_view text, const Notation& notation) {
  constexpr std::size_t kLong = 1 << 14;
  const bool begins =
      !text.empty() && (text.front() == '.' || notation.digits.find(text.front()) != notation.digits.npos);
  if (!begins) return std::nullopt;  // "inf", "nan", another sign
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value, notation.format);
  if (status == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
  if (status == std::errc{} && text.size() < kLong) return value;
  return nearest_of_long(std::string(notation.prefix).append(text));
}

}  // namespace

bool is_json_number(std::string_view text) {
  const auto at = [&](std::size_t place, char a, char b) {
    return place < text.size() && (text[place] == a || text[place] == b);
  };
  const std::size_t begin = at(0, '-', '-') ? 1 : 0;
  std::size_t end = after_digits(text, begin);
  if (end == begin || (text[begin] == '0' && end > begin + 1)) return false;
  if (at(end, '.', '.')) {
    const std::size_t fraction = end + 1;
    end = after_digits(text, fraction);
    if (end == fraction) return false;
  }
  if (at(end, 'e', 'E')) {
    const std::size_t exponent = at(end + 1, '+', '-') ? end + 2 : end + 1;
    end = after_digits(text, exponent);
    if (end == exponent) return false;
  }
  return end == text.size();
}

std::optional<double> nearest_decimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto value = nearest_unsigned(text, kDecimal);
  return value && negative ? -*value : value;
}

std::optional<double> nearest_hexadecimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  const auto value = nearest_unsigned(text.substr(2), kHexadecimal);
  return value && negative ? -*value : value;
}

}  // namespace lorentz
