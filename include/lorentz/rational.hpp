// Numbers that need not be binary64: rational numbers, exactly as written, and scenes made of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// numerator / denominator, denominator > 0; not necessarily in lowest terms.
struct Fraction {
  Integer numerator = 0, denominator = 1;
};

/// A rational number: a binary64, or a fraction.
using Rational = std::variant<double, Fraction>;

/// The exact number that a text denotes: "1/3", "-0.1" (one tenth, not the binary64 near it), "2.5e-3",
/// "0x1.8p-1" (a binary64). Nothing for any other text, or for a decimal exponent beyond 10^4.
std::optional<Rational> rational_from(std::string_view text);

/// True for a finite number above zero, whose denominator is above zero, too.
bool is_positive(const Rational& number);

/// scale * sqrt(root) + shift, which is as much as starts need. A rational number has no root.
struct Surd {
  Rational shift = 0.0, scale = 0.0;
  std::optional<Rational> root;  ///< >= 0

  Surd() = default;
  Surd(Rational number) : shift(std::move(number)) {}
};

/// Reads a rational number, "sqrt(2)", "sqrt(1/3)", "-sqrt(5)", or "golden", which is (1 + sqrt(5)) / 2.
/// Nothing for any other text.
std::optional<Surd> surd_from(std::string_view text);

using RationalVec = std::array<Rational, 3>;

/// Atom, Lattice and Scene (scene.hpp) in rational numbers.
struct RationalAtom {
  RationalVec position{};
  Rational radius = 0.0;
  std::vector<RationalVec> semiaxes;

  bool is_ball() const { return semiaxes.empty(); }
};

struct RationalLattice {
  std::array<RationalVec, 3> vectors{};
  std::vector<RationalAtom> atoms;
  int rank = 3;

  int rank_in(int dimension) const { return rank < dimension ? rank : dimension; }
};

struct RationalScene {
  int dimension = 0;
  std::vector<RationalLattice> lattices;
};

/// What is wrong with a scene, or nothing if it is valid; as for Scene (scene.hpp).
std::optional<std::string> flaw_of(const RationalScene& scene);

/// Returns the scene if it is valid; otherwise throws InputError.
const RationalScene& checked(const RationalScene& scene);

/// Where a particle starts: the position exactly, the velocity exactly or to any precision.
struct Start {
  RationalVec x{};
  std::array<Surd, 3> v{};
  std::optional<Rational> degrees;  ///< in place of v, in 2D: speed 1, at this angle from the first axis
  std::optional<ObstacleId> from;   ///< as in Query
};

/// What is wrong with a start in this scene, or nothing if it is valid: finite numbers, v != 0, no square
/// root of a number below zero, and `from` names an atom that exists.
std::optional<std::string> flaw_of(const Start& start, const RationalScene& scene);

/// Returns the start if it is valid in this scene; otherwise throws InputError.
const Start& checked(const Start& start, const RationalScene& scene);

/// The same numbers as rational numbers.
RationalScene rational(const Scene& scene);

/// The same scene with `number(x)` in place of each number x: from Scene to RationalScene, or back.
template <class To, class From, class Number>
To mapped(const From& scene, const Number& number) {
  To result{scene.dimension, {}};
  for (const auto& lattice : scene.lattices) {
    auto& its = result.lattices.emplace_back();
    using Vector = std::remove_reference_t<decltype(its.vectors[0])>;
    const auto vector = [&](const auto& a) { return Vector{number(a[0]), number(a[1]), number(a[2])}; };
    its.rank = lattice.rank;
    for (std::size_t i = 0; i < 3; ++i) its.vectors[i] = vector(lattice.vectors[i]);
    for (const auto& atom : lattice.atoms) {
      auto& obstacle = its.atoms.emplace_back();
      obstacle.position = vector(atom.position);
      obstacle.radius = number(atom.radius);
      for (const auto& axis : atom.semiaxes) obstacle.semiaxes.push_back(vector(axis));
    }
  }
  return result;
}

}  // namespace lorentz
