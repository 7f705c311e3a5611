// A scene and a start of rational numbers, in integers: all lengths and the velocity are multiplied by one
// number, so times stay the same. Private to oracle/itinerary.
#pragma once

#include <lorentz/itinerary.hpp>
#include "oracle/exact/exact_problem.hpp"
#include "oracle/itinerary/ball.hpp"

namespace lorentz::oracle {

template <std::size_t D>
struct IntegerProblem {
  Z unit;  ///< the length 1, in integers
  IntegerScene<D> scene;
  ZVec<D> x;

  IntegerProblem(const RationalScene& scene, const Start& start);
};

/// The velocity in the problem's unit, to the current precision; exact if it is rational.
template <std::size_t D>
BallVec<D> velocity_of(const Start& start, const Z& unit);

Ball to_ball(const Rational& number);

}  // namespace lorentz::oracle
