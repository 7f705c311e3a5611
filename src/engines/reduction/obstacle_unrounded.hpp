// One obstacle and the line of flight in the scene's own numbers, in sums without rounding: the last resort of
// every decision about an obstacle. Private to the reduction engine.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>

#include "src/engines/base/expansion.hpp"
#include "src/engines/reduction/kernels.hpp"
#include "src/engines/reduction/one_flight.hpp"
#include "src/engines/reduction/predicates.hpp"

namespace lorentz {

/// Its centre and the velocity, in coordinates in which the obstacle is a ball. An expansion that is not exact
/// says nothing.
class UnroundedObstacle {
 public:
  /// The obstacle of this cell. Nothing if numbers of the scene or of the flight became zero when they were scaled.
  static std::optional<UnroundedObstacle> of(const Task& task, const Bravais& lattice,
                                             const std::array<std::int64_t, 3>& cell);

  Expansion slack() const;  ///< above 0: the line meets the obstacle
  Expansion along() const;  ///< above 0, where the line meets it and x lies outside: it is entered ahead
  Expansion gap() const;    ///< below 0: x lies in it

  /// A slack in the units of the engine, by which it is this one's value.
  double slack_scale() const { return slack_scale_; }

  /// Is it entered at a time below this one, which is above 0? For an obstacle that the line meets ahead.
  friend Decision is_entered_before(const UnroundedObstacle& obstacle, double time);
  /// The order in which two that the line meets are entered.
  friend std::optional<std::strong_ordering> order_of_entry(const UnroundedObstacle& one,
                                                            const UnroundedObstacle& other);

 private:
  Expansion v_[3], d_[3], radius_;
  double slack_scale_ = 1;
  bool is_ball_ = true;
};

/// Decides what double-double leaves open. `close` stays as it is where this is not known.
void look_unrounded(const UnroundedObstacle& obstacle, CloseLook<SplitProduct>& close);
Decision is_inside_unrounded(const UnroundedObstacle& obstacle);

/// True if an obstacle { A y : |y| < 1 }, whose semiaxes are the columns of A, overlaps its translate by
/// t_0 u_0 + t_1 u_1 + t_2 u_2. (Two that touch do not overlap.) Requires integers t below 2^30. Nothing if
/// products are so small that they are not exact.
std::optional<bool> overlaps_translate(const Vec (&semiaxes)[3], const Vec (&u)[3], const Vec& t);

}  // namespace lorentz
