#include <lorentz/rational.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

#include <lorentz/errors.hpp>

namespace lorentz {
namespace {

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Takes a sign from the front; true if it was '-'.
bool take_sign(std::string_view& text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  return negative;
}

Fraction fraction_of(std::string numerator, std::string denominator, bool negative) {
  Fraction fraction;
  fraction.numerator = *Integer::from_decimal((negative ? "-" : "") + numerator);
  fraction.denominator = *Integer::from_decimal(denominator);
  return fraction;
}

std::optional<Rational> quotient(std::string_view text, bool negative) {
  const auto bar = text.find('/');
  std::string_view numerator = text.substr(0, bar), denominator = text.substr(bar + 1);
  if (!all_digits(numerator) || !all_digits(denominator)) return std::nullopt;
  if (denominator.find_first_not_of('0') == std::string_view::npos) return std::nullopt;
  return fraction_of(std::string(numerator), std::string(denominator), negative);
}

// Takes the exponent from the end: 0 without one; nothing if it is not an integer, or beyond 10^4.
std::optional<int> take_exponent(std::string_view& text, const char* marks) {
  constexpr int kMostExponent = 10'000;
  const auto mark = text.find_first_of(marks);
  if (mark == std::string_view::npos) return 0;
  std::string_view power = text.substr(mark + 1);
  const bool below = take_sign(power);
  if (!all_digits(power)) return std::nullopt;
  int exponent = 0;
  const auto status = std::from_chars(power.data(), power.data() + power.size(), exponent).ec;
  if (status != std::errc{} || exponent > kMostExponent) return std::nullopt;
  text = text.substr(0, mark);
  return below ? -exponent : exponent;
}

// Takes the first point out; returns how many digits follow it.
int take_point(std::string& digits) {
  const auto point = digits.find('.');
  if (point == std::string::npos) return 0;
  digits.erase(point, 1);
  return static_cast<int>(digits.size() - point);
}

// Digits, at most one point among them, and perhaps an exponent.
std::optional<Rational> decimal(std::string_view text, bool negative) {
  const auto power = take_exponent(text, "eE");
  std::string digits(text), denominator = "1";
  const int exponent = power.value_or(0) - take_point(digits);
  if (!power || !all_digits(digits)) return std::nullopt;
  (exponent < 0 ? denominator : digits).append(static_cast<std::size_t>(std::abs(exponent)), '0');
  return fraction_of(std::move(digits), std::move(denominator), negative);
}

// Rejects numbers that a binary64 rounds.
std::optional<Rational> hexadecimal(std::string_view text, bool negative) {
  const auto power = take_exponent(text, "pP");
  std::string digits(text);
  int exponent = power.value_or(0) - 4 * take_point(digits);
  for (; digits.size() > 1 && digits.ends_with('0'); digits.pop_back()) exponent += 4;
  std::uint64_t whole = 0;
  const auto end = digits.data() + digits.size();
  const auto [read, status] = std::from_chars(digits.data(), end, whole, 16);
  const bool is_long = std::countl_zero(whole) + std::countr_zero(whole) < 64 - 53;
  if (!power || status != std::errc{} || read != end || is_long) return std::nullopt;
  const double scaled = static_cast<double>(whole), value = std::scalbn(scaled, exponent);
  if (!std::isfinite(value) || std::scalbn(value, -exponent) != scaled) return std::nullopt;
  return negative ? -value : value;
}

}  // namespace

std::optional<Rational> rational_from(std::string_view text) {
  const bool negative = take_sign(text);
  if (text.starts_with("0x") || text.starts_with("0X")) return hexadecimal(text.substr(2), negative);
  return text.find('/') != std::string_view::npos ? quotient(text, negative) : decimal(text, negative);
}

std::optional<Surd> surd_from(std::string_view text) {
  if (const auto number = rational_from(text)) return Surd(*number);
  const bool negative = take_sign(text);
  Surd surd;
  if (text == "golden") {
    surd.shift = surd.scale = negative ? -0.5 : 0.5;
    surd.root = 5.0;
    return surd;
  }
  if (!text.starts_with("sqrt(") || !text.ends_with(')')) return std::nullopt;
  text = text.substr(5, text.size() - 6);
  const auto root = rational_from(text);
  if (!root || text.starts_with('-')) return std::nullopt;
  surd.scale = negative ? -1.0 : 1.0;
  surd.root = *root;
  return surd;
}

namespace {

bool is_above_zero(const Integer& n) {
  return n != Integer(0) && !n.decimal().starts_with('-');
}

// The sign of a number: -1, 0 or 1. For a number that is not finite, or a fraction whose denominator is not
// above zero, the result is not finite. Whether a scene or a start is valid depends on signs alone, so the
// scene or the query made of the signs, in binary64, is checked.
double sign_of(const Rational& number) {
  if (const double* value = std::get_if<double>(&number))
    return std::isfinite(*value) ? (*value > 0) - (*value < 0) : *value;
  const auto& [numerator, denominator] = std::get<Fraction>(number);
  if (!is_above_zero(denominator)) return std::numeric_limits<double>::quiet_NaN();
  return numerator == Integer(0) ? 0 : is_above_zero(numerator) ? 1 : -1;
}

Scene signs_of(const RationalScene& scene) {
  return mapped<Scene>(scene, [](const Rational& number) { return sign_of(number); });
}

// Zero, a finite number other than zero, or, if a part is not finite, a number that is not.
double sign_of(const Surd& number) {
  const double root = number.root ? sign_of(*number.root) : 0, part = root * sign_of(number.scale);
  return part == 0 ? sign_of(number.shift) : part + 0 * sign_of(number.shift);
}

}  // namespace

bool is_positive(const Rational& number) {
  return sign_of(number) == 1;
}

std::optional<std::string> flaw_of(const RationalScene& scene) {
  return flaw_of(signs_of(scene));
}

std::optional<std::string> flaw_of(const Start& start, const RationalScene& scene) {
  Query signs{{}, {}, start.from};
  for (std::size_t i = 0; i < 3; ++i) {
    signs.x[i] = sign_of(start.x[i]);
    if (start.v[i].root && sign_of(*start.v[i].root) < 0)
      return "v has the square root of a number below zero";
    signs.v[i] = sign_of(start.v[i]);
  }
  if (start.degrees) signs.v = {1 + 0 * sign_of(*start.degrees), 0, 0};
  return flaw_of(signs, signs_of(scene));
}

const RationalScene& checked(const RationalScene& scene) {
  if (const auto flaw = flaw_of(scene)) throw InputError("scene: " + *flaw);
  return scene;
}

const Start& checked(const Start& start, const RationalScene& scene) {
  if (const auto flaw = flaw_of(start, scene)) throw InputError("start: " + *flaw);
  return start;
}

RationalScene rational(const Scene& scene) {
  return mapped<RationalScene>(scene, [](double number) { return Rational(number); });
}

}  // namespace lorentz
