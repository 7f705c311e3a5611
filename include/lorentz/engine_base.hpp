// For those who derive an Engine: flights as engines take them, and the scaling of the velocity.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <lorentz/engine.hpp>

namespace lorentz {

/// Components of a velocity that are smaller, scaled as a Ray's, may have lost digits.
inline constexpr double kTinyComponent = 0x1p-450;

/// A flight as the engines take it: the velocity scaled by a power of two so that its largest component lies
/// in [1, 2), which avoids needless overflow and underflow.
struct Ray {
  const Vec& x;
  const Vec& v;
  const ObstacleId* from;  ///< or null
  const Vec& given_v;      ///< the velocity before it was scaled

  /// Is a component of v below kTinyComponent, but not zero as given? It may have lost digits, even all.
  bool has_tiny_component() const {
    bool tiny = false;
    for (std::size_t i = 0; i < 3; ++i) tiny |= given_v[i] != 0 && std::fabs(v[i]) < kTinyComponent;
    return tiny;
  }
};

/// Of an exponent of normal numbers.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// A velocity v other than zero, scaled to a Ray's; v = scaled * 2^exponent.
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

/// A time or a length times 2^exponent, fast where the factor is a normal number.
inline double scaled_time(double time, int exponent) {
  return exponent > -500 && exponent < 500 ? time * power_of_two(exponent) : std::scalbn(time, exponent);
}

/// A limit in such units: above zero, or finite, if it was.
inline double scaled_limit(double limit, int exponent) {
  using Range = std::numeric_limits<double>;
  if (!(limit > 0 && limit < Range::infinity())) return limit;
  return std::clamp(scaled_time(limit, exponent), Range::min(), Range::max());
}

template <class Fly>
void Engine::first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const {
  answer.clear();
  if (auto flaw = flaw_of(query, scene_)) {
    answer = Answer::error(*flaw);
    return;
  }
  const ScaledVelocity velocity(query.v);
  fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, query.v},
      scaled_limit(max_time, velocity.exponent), answer);
  if (answer.time) answer.time = scaled_time(*answer.time, -velocity.exponent);
  if (std::isfinite(max_time) && !decides_limit()) answer = limited(std::move(answer), max_time);
}

}  // namespace lorentz
