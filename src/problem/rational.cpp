#include <lorentz/rational.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "src/problem/from_flaw.hpp"

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

// Digits, at most one point among them, and perhaps an exponent.
std::optional<Rational> decimal(std::string_view text, bool negative) {
  constexpr int kMostExponent = 10'000;
  int exponent = 0;
  if (const auto mark = text.find_first_of("eE"); mark != std::string_view::npos) {
    std::string_view power = text.substr(mark + 1);
    const bool below = take_sign(power);
    if (!all_digits(power)) return std::nullopt;
    const auto end = power.data() + power.size();
    if (std::from_chars(power.data(), end, exponent).ec != std::errc{} || exponent > kMostExponent)
      return std::nullopt;
    if (below) exponent = -exponent;
    text = text.substr(0, mark);
  }
  std::string digits(text);
  if (const auto point = digits.find('.'); point != std::string::npos) {
    exponent -= static_cast<int>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  if (!all_digits(digits)) return std::nullopt;
  std::string denominator = "1";
  (exponent < 0 ? denominator : digits).append(static_cast<std::size_t>(std::abs(exponent)), '0');
  return fraction_of(std::move(digits), std::move(denominator), negative);
}

// Of so few digits that nothing is rounded.
std::optional<Rational> hexadecimal(std::string_view text, bool negative) {
  const auto digits = static_cast<std::size_t>(std::count_if(
      text.begin(), std::find_if(text.begin(), text.end(), [](char c) { return c == 'p' || c == 'P'; }),
      [](char c) { return c != '.'; }));
  double value = 0;
  const auto end = text.data() + text.size();
  const auto [after, status] = std::from_chars(text.data(), end, value, std::chars_format::hex);
  constexpr std::size_t kExactDigits = 13;  // 52 bits
  if (status != std::errc{} || after != end || !std::isfinite(value) || digits > kExactDigits + 1)
    return std::nullopt;
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

bool is_positive(const Rational& number) {
  if (const double* value = std::get_if<double>(&number)) return *value > 0;
  const std::string numerator = std::get<Fraction>(number).numerator.decimal();
  return numerator != "0" && !numerator.starts_with('-');
}

namespace {

std::optional<std::string> flaw_of_rational_atom(const RationalAtom& atom, int dimension) {
  if (atom.is_ball())
    return is_positive(atom.radius) ? std::nullopt : std::optional("radius must be above zero");
  if (atom.semiaxes.size() == static_cast<std::size_t>(dimension)) return std::nullopt;
  return "needs as many semiaxes as dimensions (" + std::to_string(dimension) + ")";
}

}  // namespace

std::optional<std::string> flaw_of(const RationalScene& scene) {
  if (scene.dimension != 2 && scene.dimension != 3) return "dimension must be 2 or 3";
  if (scene.lattices.empty()) return "a scene needs at least one lattice";
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const std::string where = "lattice " + std::to_string(l);
    if (scene.lattices[l].atoms.empty()) return where + ": needs at least one atom";
    for (std::size_t a = 0; a < scene.lattices[l].atoms.size(); ++a)
      if (auto flaw = flaw_of_rational_atom(scene.lattices[l].atoms[a], scene.dimension))
        return where + ", atom " + std::to_string(a) + ": " + *flaw;
  }
  return std::nullopt;
}

std::optional<std::string> flaw_of(const Start& start, const RationalScene& scene) {
  const auto is_zero = [](const Rational& number) {
    if (const double* value = std::get_if<double>(&number)) return *value == 0;
    return std::get<Fraction>(number).numerator == Integer(0);
  };
  const bool rests = std::all_of(start.v.begin(), start.v.end(), [&](const Surd& component) {
    return component.root ? is_zero(*component.root) && is_zero(component.shift) : is_zero(component.shift);
  });
  if (rests && !start.degrees) return "v is zero: the particle needs a direction";
  return start.from ? from_flaw(*start.from, scene) : std::nullopt;
}

RationalScene rational(const Scene& scene) {
  const auto vector = [](const Vec& a) { return RationalVec{a[0], a[1], a[2]}; };
  RationalScene result{scene.dimension, {}};
  for (const Lattice& lattice : scene.lattices) {
    RationalLattice& its = result.lattices.emplace_back();
    its.missing = lattice.missing;
    for (std::size_t i = 0; i < 3; ++i) its.vectors[i] = vector(lattice.vectors[i]);
    for (const Atom& atom : lattice.atoms) {
      RationalAtom& obstacle = its.atoms.emplace_back();
      obstacle.position = vector(atom.position);
      obstacle.radius = atom.radius;
      for (const Vec& axis : atom.semiaxes) obstacle.semiaxes.push_back(vector(axis));
    }
  }
  return result;
}

}  // namespace lorentz
