// Velocities in lanes, as ScaledVelocity of engine_base.hpp for one flight. Private to the batch engine.

/// Velocities scaled by powers of two so that their largest components lie in [1, 2). Lanes whose velocity is
/// far from 1, or has tiny components, are left over.
template <int D>
struct Velocity {
  V scaled[D], factor;

  HWY_INLINE Velocity(const V (&v)[D], Lanes& lanes) {
    V top = Abs(v[0]);
    for (int k = 1; k < D; ++k) top = Max(top, Abs(v[k]));
    factor = inverse_power_of(top);
    lanes.leave_unless(And(top > all(0x1p-490), top < all(0x1p490)));
    for (int k = 0; k < D; ++k) {
      scaled[k] = v[k] * factor;
      lanes.leave(And(Abs(scaled[k]) < all(kTinyComponent), v[k] != none()));
      lanes.leave_unless(Abs(v[k]) <= top);  // not a number
    }
  }

  /// Converts a time from the scaled units to those of the query. Nothing is rounded: times in lanes are 0,
  /// or between 2^-100 and 2^63 (lanes tell a start from its obstacle's surface to 2^-52 of a radius of 2^-40
  /// or more), exponents are at most 400, and the factor is between 2^-490 and 2^490.
  template <bool kUnit>
  HWY_INLINE V time_of(V time, double unit) const {
    if constexpr (!kUnit) time = time * all(unit);
    return time * factor;
  }

  /// Converts a limit of the query to the scaled units.
  template <bool kUnit>
  HWY_INLINE V limit_of(V limit, double inverse_unit) const {
    limit = limit * inverse_power_of(factor);
    return kUnit ? limit : limit * all(inverse_unit);
  }
};
