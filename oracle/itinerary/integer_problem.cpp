#include "oracle/itinerary/integer_problem.hpp"

#include <algorithm>

#include <lorentz/errors.hpp>
#include "oracle/exact/quadratic.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

struct Ratio {
  Z numerator, denominator = 1;  ///< > 0, in lowest terms
};

Ratio ratio_of(const Rational& number) {
  if (const double* value = std::get_if<double>(&number)) {
    const Dyadic dyadic(*value);
    if (dyadic.exponent < 0) return {dyadic.mantissa, shifted_left(Z(1), -dyadic.exponent)};
    return {shifted_left(dyadic.mantissa, dyadic.exponent), 1};
  }
  const auto& fraction = std::get<Fraction>(number);
  const Z numerator = to_z(fraction.numerator), denominator = to_z(fraction.denominator);
  if (numerator == 0) return {0, 1};
  const Z common = gcd(numerator, denominator);
  return {numerator / common, denominator / common};
}

Z times(const Rational& number, const Z& unit) {
  const Ratio ratio = ratio_of(number);
  return ratio.numerator * (unit / ratio.denominator);
}

// Exact if there is no root.
Ball times(const Surd& number, const Z& unit) {
  if (!number.root) return Ball(times(number.shift, unit));
  return (to_ball(number.shift) + to_ball(number.scale) * sqrt(to_ball(*number.root))) * Ball(unit);
}

BallVec<2> turned(const Rational& degrees) {
  const Ratio ratio = ratio_of(degrees);
  fmpq_t half_turns;
  fmpq_init(half_turns);
  fmpz_set_mpz(fmpq_numref(half_turns), ratio.numerator.view());
  fmpz_set_mpz(fmpq_denref(half_turns), Z(180 * ratio.denominator).view());
  fmpq_canonicalise(half_turns);
  BallVec<2> direction;
  arb_sin_cos_pi_fmpq(direction[1].raw(), direction[0].raw(), half_turns, Ball::WorkingPrecision::now());
  fmpq_clear(half_turns);
  return direction;
}

// Rounded twice if there is a root, which hardly ever changes the result.
double nearest_surd(const Surd& number) {
  if (!number.root) return nearest(number.shift);
  const Ball::WorkingPrecision precision(256);
  return times(number, 1).nearest();
}

}  // namespace

double nearest(const Rational& number) {
  if (const double* value = std::get_if<double>(&number)) return *value;
  const Ratio ratio = ratio_of(number);
  return round_to_binary64({ratio.numerator, +1, 0, ratio.denominator, 0});
}

Scene nearest(const RationalScene& scene) {
  return mapped<Scene>(scene, [](const Rational& number) { return nearest(number); });
}

Query nearest(const Start& start) {
  Query query{{}, {}, start.from};
  for (std::size_t i = 0; i < 3; ++i) {
    query.x[i] = nearest(start.x[i]);
    query.v[i] = nearest_surd(start.v[i]);
  }
  if (start.degrees) {
    const Ball::WorkingPrecision precision(256);
    const BallVec<2> direction = turned(*start.degrees);
    query.v = {direction[0].nearest(), direction[1].nearest(), 0};
  }
  return query;
}

Ball to_ball(const Rational& number) {
  const Ratio ratio = ratio_of(number);
  const Ball numerator(ratio.numerator);
  return ratio.denominator == 1 ? numerator : numerator / Ball(ratio.denominator);
}

template <std::size_t D>
IntegerProblem<D>::IntegerProblem(const RationalScene& rational_scene, const Start& start) : unit(1) {
  const auto see = [&](const Rational& number) {
    unit = lcm(unit, ratio_of(number).denominator);
    return Z();
  };
  in_integers<D>(rational_scene, see);  // for what `see` does
  for (std::size_t i = 0; i < D; ++i) {
    see(start.x[i]);
    if (!start.v[i].root) see(start.v[i].shift);
  }
  const auto in_units = [&](const Rational& number) { return times(number, unit); };
  scene = in_integers<D>(rational_scene, in_units);
  std::transform(start.x.begin(), start.x.begin() + D, x.begin(), in_units);
}

template <std::size_t D>
BallVec<D> velocity_of(const Start& start, const Z& unit) {
  BallVec<D> v;
  for (std::size_t i = 0; i < D; ++i) v[i] = times(start.v[i], unit);
  if constexpr (D == 2)
    if (start.degrees) {
      v = turned(*start.degrees);
      for (Ball& component : v) component = component * Ball(unit);
    }
  return v;
}

template struct IntegerProblem<2>;
template struct IntegerProblem<3>;
template BallVec<2> velocity_of(const Start&, const Z&);
template BallVec<3> velocity_of(const Start&, const Z&);

}  // namespace lorentz::oracle
