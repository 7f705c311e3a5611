// Single balls, which repeat in no direction, in lanes, as in src/engines/reduction/one_obstacle.hpp. Private
// to the batch engine.

template <int D>
struct SingleBallDirection {
  V v[D], v2, s_rho;

  HWY_INLINE void set(const Bravais& ball, const V (&velocity)[D]) {
    for (int k = 0; k < D; ++k) v[k] = velocity[k];
    v2 = speed_squared(v[0], v[1], D == 3 ? v[D - 1] : none());
    s_rho = width_of(all(ball.radius), v2);
  }
};

/// Looks at a ball in double-double. Rare code gets copies of its arguments.
template <int D>
HWY_NOINLINE CloseLook<LaneFma> look_at_close(SingleBallDirection<D> to, const Bravais& ball,
                                              Offset<LaneFma, D> at) {
  return CloseLook<LaneFma>(StableMeeting<LaneFma, D, true>(to.v, at.d, at.error, ball));
}

/// The search among the obstacles of one atom, of which there is one: in binary64, and in double-double where
/// binary64 is not certain.
template <int D>
class SingleBall {
 public:
  using Direction = SingleBallDirection<D>;

  LaneEntry<D, true> found;  ///< for the lanes that meet the ball: there found.s is finite
  M stage2;                  ///< the lanes in which double-double decided something

  HWY_INLINE SingleBall(const Direction& to, const Bravais& ball, const Offset<LaneFma, D>& start,
                        const Leaving<D>* leaving, V)
      : to_(to), ball_(ball), start_(start), leaving_(leaving) {}

  /// Looks at the ball in the active lanes.
  HWY_INLINE void run(Lanes& lanes) {
    stage2 = no_lane();
    for (V& n : found.n) n = none();
    found.v2 = to_.v2;
    const M asked = leaving_ != nullptr ? AndNot(leaving_->any, lanes.active) : lanes.active;
    const LoneBall<LaneFma, D> one(to_.v, start_.d, start_.error, to_.v2, ball_.radius);
    const M no = Or(one.is_missed(), one.is_behind());
    const M hit = And(AndNot(no, And(one.is_met(), one.is_ahead())), asked);
    found.s = select(hit, one.s, infinite()), found.s_error = where(hit, one.s_error);
    found.slack = where(hit, one.slack), found.slack_error = where(hit, one.slack_error);
    const M close = AndNot(Or(no, hit), asked);
    if (any(close)) look_closely(close, lanes);
  }

 private:
  HWY_INLINE void look_closely(M asked, Lanes& lanes) {
    const CloseLook<LaneFma> close = look_at_close(to_, ball_, start_);
    stage2 = Or(stage2, asked);
    const M met = And(close.is_met, close.is_ahead),
            passed = Or(close.is_missed, And(close.is_met, close.is_behind));
    lanes.leave(AndNot(Or(met, passed), asked));
    const M here = And(met, asked);
    found.s = select(here, close.s, found.s), found.s_error = select(here, close.s_error, found.s_error);
    found.slack = select(here, close.slack, found.slack);
    found.slack_error = select(here, close.slack_error, found.slack_error);
  }

  const Direction& to_;
  const Bravais& ball_;
  const Offset<LaneFma, D>& start_;
  const Leaving<D>* leaving_;
};
