#include "src/exchange/exchange_number.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

namespace lorentz {
namespace {

// The end of the digits that begin at `place`.
std::size_t after_digits(std::string_view text, std::size_t place) {
  while (place < text.size() && is_digit(text[place])) ++place;
  return place;
}

// A notation, and how far from 1 a binary64 can be in powers of its exponent's base.
struct Notation {
  std::chars_format format;
  std::string_view digits;
  std::string_view exponent_marks;
  std::int64_t exponents_a_digit;
  std::int64_t far;
};

constexpr Notation kDecimal{std::chars_format::general, "0123456789", "eE", 1, 400};
constexpr Notation kHexadecimal{std::chars_format::hex, "0123456789abcdefABCDEF", "pP", 4, 1200};

// The number 0.DIGITS base^exponent. DIGITS has no zero in front, and is empty for zero.
struct Parts {
  std::string digits;
  std::int64_t exponent = 0;
};

// An exponent beyond 2^60 counts as 2^60, which is beyond any number of digits in memory.
std::int64_t exponent_of(std::string_view text) {
  constexpr std::int64_t kMost = std::int64_t{1} << 60;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  std::int64_t exponent = 0;
  const auto status = std::from_chars(text.data(), text.data() + text.size(), exponent).ec;
  if (status != std::errc{}) exponent = kMost;
  return negative ? -std::min(exponent, kMost) : std::min(exponent, kMost);
}

// The parts of a text that std::from_chars has found to be a number.
Parts parts_of(std::string_view text, const Notation& notation) {
  Parts parts;
  const auto mark = std::min(text.find_first_of(notation.exponent_marks), text.size());
  if (mark < text.size()) parts.exponent = exponent_of(text.substr(mark + 1));
  const auto point = std::min(text.find('.'), mark);
  parts.digits = text.substr(0, point);
  if (point < mark) parts.digits += text.substr(point + 1, mark - point - 1);
  const auto zeros = std::min(parts.digits.find_first_not_of('0'), parts.digits.size());
  parts.digits.erase(0, zeros);
  parts.exponent +=
      notation.exponents_a_digit * (static_cast<std::int64_t>(point) - static_cast<std::int64_t>(zeros));
  return parts;
}

// Rewrites the number with its digits at the front, so that neither the place of the point nor the exponent
// is far from 0.
double nearest_of_parts(const Parts& parts, const Notation& notation) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (parts.digits.empty() || parts.exponent < -notation.far) return 0;
  if (parts.exponent > notation.far) return kInfinity;
  const std::string text = "0." + parts.digits + notation.exponent_marks[0] + std::to_string(parts.exponent);
  double value = 0;
  const auto status = std::from_chars(text.data(), text.data() + text.size(), value, notation.format).ec;
  if (status == std::errc::result_out_of_range) return parts.exponent > 0 ? kInfinity : 0;
  return value;
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
  return nearest_of_parts(parts_of(text, notation), notation);
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
