// For classes derived from Engine: flights in the form that engines take, and the scaling of the velocity.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <lorentz/engine.hpp>

namespace lorentz {

/// Velocity components below this size, scaled as in Ray, may have lost digits.
inline constexpr double kTinyComponent = 0x1p-450;

/// A flight in the form that engines take. The velocity is scaled by a power of two so that its largest
/// component lies in [1, 2), which avoids needless overflow and underflow.
struct Ray {
  const Vec& x;
  const Vec& v;
  const ObstacleId* from;  ///< the obstacle that the flight leaves, or null
  const Vec& given_v;      ///< the velocity before scaling

  /// True if a component of v is below kTinyComponent but was not zero as given. It may have lost digits,
  /// even all of them.
  bool has_tiny_component() const {
    bool tiny = false;
    for (std::size_t i = 0; i < 3; ++i) tiny |= given_v[i] != 0 && std::fabs(v[i]) < kTinyComponent;
    return tiny;
  }
};

/// 2^exponent. Requires a normal result.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// A nonzero velocity v, scaled as in Ray: v = scaled * 2^exponent.
struct ScaledVelocity {
  Vec scaled;
  int exponent;

  explicit ScaledVelocity(const Vec& v) {
    const double a = std::fabs(v[0]), b = std::fabs(v[1]), c = std::fabs(v[2]), ab = a > b ? a : b;
    const double largest = ab > c ? ab : c;
    exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - 1023;
    if (!(exponent > -1000 && exponent < 1000)) {
      set_extreme(v, largest);
      return;
    }
    const double factor = power_of_two(-exponent);
    scaled = {v[0] * factor, v[1] * factor, v[2] * factor};
  }

 private:
  void set_extreme(const Vec& v, double largest);
};

/// A time or a length times 2^exponent; fast where the factor is a normal number.
inline double scaled_time(double time, int exponent) {
  return exponent > -500 && exponent < 500 ? time * power_of_two(exponent) : std::scalbn(time, exponent);
}

/// A limit in the scaled units. It stays above zero if it was above zero, and finite if it was finite.
inline double scaled_limit(double limit, int exponent) {
  using Range = std::numeric_limits<double>;
  if (!(limit > 0 && limit < Range::infinity())) return limit;
  return std::clamp(scaled_time(limit, exponent), Range::min(), Range::max());
}

template <class Fly>
void Engine::first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const {
  answer.clear();
  if (auto flaw = flaw_of(query, scene_, max_time)) {
    answer = Answer::error(*flaw);
    return;
  }
  const ScaledVelocity velocity(query.v);
  fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, query.v},
      scaled_limit(max_time, velocity.exponent), answer);
  if (answer.time) answer.time = scaled_time(*answer.time, -velocity.exponent);
  if (max_time < HUGE_VAL && !decides_limit()) answer = limited(std::move(answer), max_time);
}

}  // namespace lorentz
