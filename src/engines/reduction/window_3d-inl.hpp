// A stretch of the flight in 3D, and the planes, lines and points of the lattice that are in it.

/// A lattice point relative to the anchor. `size` and `extent` are those of the terms from which p and z were
/// summed.
template <class Numbers, class Integer = typename Numbers::Number>
struct PointOf3 {
  using Number = typename Numbers::Number;

  Integer n[3];
  Number p[2], z, size, extent;

  LORENTZ_INLINE PointOf3 step(Number k, const ArmOf3<Numbers, Integer>& arm) const {
    PointOf3 to;
    for (int i = 0; i < 3; ++i) to.n[i] = n[i] + k * arm.n[i];
    for (int i = 0; i < 2; ++i) to.p[i] = stepped(p[i], k, arm.p[i]);
    to.z = stepped(z, k, arm.z);
    to.size = size + Abs(k * arm.p[0]) + Abs(k * arm.p[1]) + Abs(k) * arm.cancellation;
    to.extent = extent + Abs(k * arm.z);
    return to;
  }
};

/// The balls of a lattice line that the flight meets: those with |q + k p| < 1, which is a quadratic in k.
template <class Numbers, class Integer = typename Numbers::Number>
struct LineOf3 {
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;
  using Point = PointOf3<Numbers, Integer>;
  using Arm = ArmOf3<Numbers, Integer>;

  Number a, b, discriminant, unsure;
  Number first, last, slack;  ///< the range of k, and how far its ends may be off

  /// Sets the quadratic from a point of the line, which errs by `unsure_across` across, and the step. False
  /// where all balls are missed.
  LORENTZ_INLINE Mask set(const Point& q, const Arm& arm, Number unsure_across) {
    unsure = unsure_across;
    a = square_of(arm.p), b = sum_of_products(q.p[0], arm.p[0], q.p[1], arm.p[1]);
    const Number moment = moment_of_line(q.p, arm.p);
    discriminant = a * (1 + kDiscriminant * unsure) - moment * moment;  // rounded up
    return Not(discriminant < all(0));
  }

  LORENTZ_INLINE void set_ends() {
    const Number inverse = 1 / a, half = sqrt(discriminant) * inverse;
    first = Neg(b) * inverse - half, last = Neg(b) * inverse + half;
    slack = all(kSlop3d) + kLineEnd * unsure * sqrt(inverse);
  }

  /// Makes the range wider by the slack, but no longer than the part [z_first, z_last] of the window.
  LORENTZ_INLINE void cut(const Point& q, const Arm& arm, Number z_first, Number z_last) {
    first = first - slack, last = last + slack;
    const Mask ahead = arm.z > all(0);
    if (Numbers::kOne && nowhere(ahead)) return;
    const Number inverse_z = 1 / arm.z;
    first = select(ahead, Max(first, (z_first - q.z) * inverse_z - all(kSlop3d)), first);
    last = select(ahead, Min(last, (z_last - q.z) * inverse_z + all(kSlop3d)), last);
  }
};

/// A value that is named like one that is pointed to.
template <class T>
struct Held {
  T value;

  LORENTZ_INLINE explicit Held(const T* given) : value(*given) {}
  LORENTZ_INLINE const T* operator->() const { return &value; }
};

/// Arch computes products and sums of double-double; Numbers holds the results in between.
template <class Arch, class Numbers, bool kUnit, bool kBall, class Integer = typename Numbers::Number>
class WindowOf3 {
 protected:
  using DD = DoubleDouble<Arch>;
  using Pair = DoubleDouble<Numbers>;

 public:
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;
  using Direction = DirectionOf3<Numbers, kUnit, kBall, Integer>;
  using Basis = BasisOf3<Numbers, Integer>;
  using Point = PointOf3<Numbers, Integer>;
  using Arm = ArmOf3<Numbers, Integer>;

  const Bravais& lattice;
  const Direction& to;
  std::conditional_t<Numbers::kInRegisters, Held<Basis>, const Basis*> basis;
  Number begin;  ///< in units of s
  Point anchor_point;
  Number p_error, s_error, z_error;  ///< of the anchor
  Number z_first;                    ///< where the window begins, with its error

  LORENTZ_INLINE WindowOf3(const Bravais& of_lattice, const Direction& direction,
                           const Offset<Numbers, 3>& start)
      : lattice(of_lattice), to(direction), basis(&direction.basis), begin(all(0)), error_(start.error) {
    to.template forms_of<Arch>(start.d, start_);
    start_size_ = (Abs(start.d[0].hi) + Abs(start.d[1].hi)) + Abs(start.d[2].hi);
  }

  /// Is a short vector of a unit lattice nearly parallel to the flight?
  LORENTZ_INLINE Mask is_nearly_parallel() const {
    Mask any_of_three = Not(everywhere(true));
    for (const Arm& arm : basis->b) {
      const Number across = (Abs(arm.p[0]) + Abs(arm.p[1])) * all(lattice.radius);
      any_of_three =
          Or(any_of_three, And(across < all(kNearlyParallel), arm.largest_coefficient() < all(kShortVector)));
    }
    return any_of_three;
  }

  // ---- Planes: k b_2 + (b_0, b_1) -----------------------------------------------------------------------

  /// The number of the plane through the point. The plane through the start of the window's axis has a number
  /// of about 0.
  LORENTZ_INLINE Number plane_of(const Point& point) const { return coordinate(2, point, point.z); }

  /// The range of k whose planes meet the window, if the anchor is on plane kappa.
  LORENTZ_INLINE void set_planes(Number kappa, Number& low, Number& high) const {
    const Number tilt = basis->tilt(), slop = all(kSlop3d);
    low = Min(all(0), tilt) - basis->slope - kappa - slop;
    high = Max(all(0), tilt) + basis->slope - kappa + slop;
  }

  /// Where the cylinder cuts the plane: a section of an ellipse, between z_first and z_last, and the range of
  /// its lines. In the coordinates xi (along the normal), eta (across it) and z the plane is
  /// slope xi + tilt z = kappa.
  struct Section {
    Number z_first, z_last, xi_error, low, high;
  };

  /// Sets the section of the plane of this point, up to `end`. False where the flight misses it.
  LORENTZ_INLINE Mask set_section(const Point& point, Number kappa, Number end, Section& section) const {
    const Number slop = all(kSlop3d), tilt = basis->tilt();
    const auto& g1 = basis->dual[1];
    section.z_first = z_first, section.z_last = end;
    const Mask met = Not(misses(kappa, section));
    if (Numbers::kOne && nowhere(met)) return met;
    const Number xi_first = distance_of_plane(kappa, tilt, section.z_first, basis->inverse_slope),
                 xi_last = distance_of_plane(kappa, tilt, section.z_last, basis->inverse_slope);
    const Number nearest = nearest_of(xi_first, xi_last);
    section.xi_error = xi_error(point);
    const Number eta = sqrt(Max(all(0), 1 - nearest * nearest) + 2 * section.xi_error) + slop;
    const Number a = basis->dual1_normal * xi_first + g1[2] * section.z_first,
                 b = basis->dual1_normal * xi_last + g1[2] * section.z_last;
    const Number here = coordinate(1, point, point.z), half = Abs(basis->dual1_level) * eta;
    const Number spread = slop * (1 + Abs(basis->dual1_normal) + Abs(g1[2]));
    section.low = Ceil(Min(a, b) - half - here - spread);
    section.high = Max(a, b) + half - here + spread;
    return met;
  }

  /// The least |xi| of a plane between two places.
  static LORENTZ_INLINE Number nearest_of(Number xi_first, Number xi_last) {
    return where(xi_first * xi_last > all(0), Min(Abs(xi_first), Abs(xi_last)));
  }

  // ---- Lines and balls ----------------------------------------------------------------------------------

  /// The error across of a line through this point.
  LORENTZ_INLINE Number line_error(const Point& q) const {
    const Number error = kLine * kRoundoff * (1 + q.size) + p_error;
    if constexpr (kBall)
      return error;
    else
      return error + all(to.scale_error);
  }

  /// 1 - |p|^2, and a bound on its error.
  LORENTZ_INLINE void set_across(const Point& point, Number& margin, Number& spread) const {
    constexpr double kScaleOfBall = kScale * kRoundoff;
    const Number square = square_of(point.p), error = kAcross * kRoundoff * point.size + p_error;
    spread = (1 + square) * (2 * error + all(kBall ? kScaleOfBall : to.scale_error));
    margin = 1 - square;
  }

  /// s, and a bound on its error.
  LORENTZ_INLINE void set_along(const Point& point, Number& s, Number& error) const {
    s = begin + point.z * basis->length;
    error = s_error + kAlong * kRoundoff * point.extent * basis->length;
  }

  /// The place in the window beyond which nothing more is needed, if an obstacle at s is found.
  LORENTZ_INLINE Number end_before(Number s) const {
    return Min(all(1), (s - begin) / basis->length) + all(kSlop3d) + 2 * z_error;
  }

  // ---- The next window ----------------------------------------------------------------------------------

  /// Moves right behind this window; or, where no plane was met, to where the next plane comes within r of
  /// the line. Rounded down, so that there is no gap between the windows.
  LORENTZ_INLINE void advance(Mask none_met, Number kappa) {
    Number step = all(1);
    if (!Numbers::kOne || any(none_met)) step = select(none_met, windows_to_next_plane(kappa), step);
    const Number next = begin + step * all(1 - kSlop3d) * basis->length;
    begin = Max(begin, next - kNextWindow * kRoundoff * next);
  }

 protected:
  // Sets the anchor point to the home cell, in binary64.
  LORENTZ_INLINE void set_point_of_home() {
    for (int i = 0; i < 2; ++i) anchor_point.p[i] = to.scale[i] * start_[i].hi;
    anchor_point.z = (start_[2].hi - begin) / basis->length;
  }

  // Sets the steps from the anchor to the lattice point near the middle of the window, where that is wanted.
  // Returns the largest.
  LORENTZ_INLINE Number steps_to_middle(Mask wanted, Number (&k)[3]) const {
    for (int i = 0; i < 3; ++i)
      k[i] = where(wanted, Neg(Round(coordinate(i, anchor_point, anchor_point.z - all(kMiddle)))));
    return Max(Max(Abs(k[0]), Abs(k[1])), Abs(k[2]));
  }

  // Sets the lattice point n cells from the home cell. `from` is the along of the home cell, counted from the
  // window's begin.
  LORENTZ_INLINE void set_place(const Number (&n)[3], const Pair& from, Point& point) const {
    const auto& form = to.form();
    point.p[0] = to.scale[0] * compensated_sum_from<DD, Direction::kFirstTerms>(start_[0], form[0], n);
    point.p[1] = to.scale[1] * compensated_sum_from<DD>(start_[1], form[1], n);
    point.z = compensated_sum_from<DD, 3, Direction::kLowParts>(from, form[2], n) / basis->length;
  }

  // Makes this the point from which others are counted.
  static LORENTZ_INLINE void set_zero(Point& point) {
    for (Integer& n : point.n) n = all(0);
    point.size = Abs(point.p[0]) + Abs(point.p[1]);
    point.extent = Abs(point.z);
  }

  // Sets the errors for an anchor n cells from the home cell. False where it is not known well enough.
  LORENTZ_INLINE Mask set_errors(const Number (&n)[3]) {
    Number terms = start_size_;
    for (int j = 0; j < 3; ++j) terms = terms + Abs(n[j]) * all(to.size_of[j]);
    Number error = kAnchorTerms * terms;
    if constexpr (!kUnit) error = error + error_;
    error = kForm * error + all(kFlushed);
    p_error = error * all(to.inverse_r);
    if constexpr (kBall)
      s_error = error + kRoundoff * begin;
    else
      s_error = to.along_size * error + kRoundoff * begin + kForm * lattice.shape.metric_error * terms;
    z_error = s_error / basis->length;
    z_first = Neg(2 * z_error + all(kWindowStart));
    return p_error < all(kSlop3d / 2);
  }

  // Makes the window longer from here on, with a basis that suits its length.
  LORENTZ_INLINE void lengthen(Mask wanted) {
    const Number factor = select(wanted, growth(), all(1));
    if constexpr (Numbers::kInRegisters) {
      to.template lengthen<Arch>(basis.value, factor, wanted);
    } else {
      if (basis != &longer_) longer_ = *basis;
      to.template lengthen<Arch>(longer_, factor, wanted);
      basis = &longer_;
    }
  }

  LORENTZ_INLINE void shorten(Mask wanted) { to.template shorten<Arch>(basis.value, wanted); }

  Pair start_[3];

 private:
  LORENTZ_INLINE Number coordinate(int i, const Point& point, Number z) const {
    const auto& g = basis->dual[i];
    return sum_of_products(g[0], point.p[0], g[1], point.p[1], g[2], z);
  }

  // Cuts a section to the part in which the plane is within r of the line. True where no part is.
  LORENTZ_INLINE Mask misses(Number kappa, Section& section) const {
    const Number tilt = basis->tilt(), slop = all(kSlop3d), slope = basis->slope * all(1 + kSlop3d);
    const Number at_first = kappa - tilt * section.z_first, at_last = kappa - tilt * section.z_last;
    const Mask cut = Or(Abs(at_first) > slope, Abs(at_last) > slope);
    if (Numbers::kOne && nowhere(cut)) return cut;
    const Number below = Neg(slope);
    const Mask beside = Or(And(at_first > slope, at_last > slope), And(at_first < below, at_last < below));
    if (Numbers::kOne && any(beside)) return beside;
    const Number one = (kappa - slope) / tilt, other = (kappa + slope) / tilt;
    section.z_first = select(cut, Max(section.z_first, Min(one, other) - slop), section.z_first);
    section.z_last = select(cut, Min(section.z_last, Max(one, other) + slop), section.z_last);
    return And(cut, Or(beside, section.z_first > section.z_last));
  }

  // The error of xi where the line passes the plane of this point. If the line passes a plane at nearly the
  // radius, the section has the half width sqrt(1 - xi^2), whose square is off by twice that error: more than
  // all of it if the section is thin.
  LORENTZ_INLINE Number xi_error(const Point& point) const {
    const auto& g = basis->dual[2];
    const Number terms = 1 + Max(Abs(g[0]), Abs(g[1])) * point.size + Abs(g[2]) * point.extent;
    return p_error + all(to.scale_error) +
           basis->inverse_slope *
               (basis->tilt_error + Abs(g[2]) * s_error / basis->length + kPlane * kRoundoff * terms);
  }

  // By how much the next window is longer. Near the direction of the shortest vector it is as long as can be
  // while it meets few lines of the lattice, if not few balls, and while integers hold its cells.
  LORENTZ_INLINE Number growth() const {
    const Number(&p)[2] = basis->b[0].p;
    const Number few_lines = all(kLinesInWindow) / (basis->inverse_volume * (Abs(p[0]) + Abs(p[1]))),
                 in_range = all(kLargest<Integer> / 8) * sqrt(to.v2) / basis->length;
    return Max(all(kLonger), Min(few_lines, in_range));
  }

  // The line meets planes at k + kappa - tilt z = 0. Returns how many windows ahead the nearest of them comes
  // within r of the line.
  LORENTZ_INLINE Number windows_to_next_plane(Number kappa) const {
    const Number tilt = basis->tilt(), steepest = Abs(tilt) + basis->tilt_error;
    const Number up = gap_above(tilt - kappa), down = gap_above(kappa - tilt);
    // A tilt below its error may have either sign.
    const Number gap = select(Abs(tilt) <= basis->tilt_error, Min(up, down), select(tilt > all(0), up, down));
    return Min(Max(all(1), 1 + (gap - all(kSlop3d)) / steepest), all(kMaxJump));
  }
  LORENTZ_INLINE Number gap_above(Number here) const {
    return Ceil(here + basis->slope) - here - basis->slope;
  }

  Basis longer_;
  Number error_, start_size_;
};
