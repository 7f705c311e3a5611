// A single ball on the lines of flight, in lanes: src/engines/reduction/lone_obstacle.hpp. Private to the
// batch engine.
#if defined(LORENTZ_BATCH_LONE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_LONE_INL_HPP
#undef LORENTZ_BATCH_LONE_INL_HPP
#else
#define LORENTZ_BATCH_LONE_INL_HPP
#endif

#include "src/engines/batch/time-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

#define LORENTZ_INLINE HWY_INLINE
#include "src/engines/reduction/lone_obstacle-inl.hpp"
#undef LORENTZ_INLINE

/// As Search2 and Search3: in binary64, and in double-double where that is not certain.
template <int D>
class LoneSearch {
 public:
  struct Direction {
    V v[D], v2, s_rho;

    HWY_INLINE void set(const Bravais& ball, const V (&velocity)[D]) {
      for (int k = 0; k < D; ++k) v[k] = velocity[k];
      v2 = speed_squared(v[0], v[1], D == 3 ? v[D - 1] : none());
      s_rho = width_of(all(ball.radius), v2);
    }
  };

  LaneEntry<D, true> found;  ///< of the lanes in which it is met: found.s is finite
  M stage2;

  HWY_INLINE LoneSearch(const Direction& to, const Bravais& ball, const Offset<LaneFma, D>& start,
                        const Leaving<D>* leaving, V)
      : to_(to), ball_(ball), start_(start), leaving_(leaving) {}

  /// Of the lanes that are active.
  HWY_INLINE void run(Lanes& lanes) {
    M asked = lanes.active;
    if (leaving_ != nullptr) asked = AndNot(leaving_->any, asked);
    const LoneBall<LaneFma, D> ball(to_.v, start_.d, start_.error, to_.v2, ball_.radius);
    const M no = Or(ball.is_missed(), ball.is_behind());
    M hit = And(AndNot(no, And(ball.is_met(), ball.is_ahead())), asked);
    found.s = ball.s, found.s_error = ball.s_error;
    found.slack = ball.slack, found.slack_error = ball.slack_error;
    found.v2 = to_.v2;
    for (V& n : found.n) n = none();
    stage2 = AndNot(Or(no, hit), asked);
    if (any(stage2)) look_closely(hit, lanes);
    found.s = select(hit, found.s, infinite());
  }

 private:
  struct Close {
    V s, s_error, slack, slack_error;
    M hit, undecided;
  };

  // What is rare gets copies.
  HWY_INLINE void look_closely(M& hit, Lanes& lanes) {
    const Close close = closely(to_, ball_, start_);
    lanes.give_up(And(close.undecided, stage2));
    const M here = And(close.hit, stage2);
    hit = Or(hit, here);
    found.s = select(here, close.s, found.s), found.s_error = select(here, close.s_error, found.s_error);
    found.slack = select(here, close.slack, found.slack);
    found.slack_error = select(here, close.slack_error, found.slack_error);
  }

  static HWY_NOINLINE Close closely(Direction to, const Bravais& ball, Offset<LaneFma, D> start) {
    const StableMeeting<LaneFma, D, true> meeting(to.v, start.d, start.error, ball);
    Close close;
    close.s = meeting.s.hi, close.slack = meeting.slack.hi;
    close.s_error = meeting.s_error + kRoundoff * close.s;
    close.slack_error = meeting.slack_error + kRoundoff * close.slack;
    const M missed = close.slack<Neg(meeting.slack_error), met = close.slack> meeting.slack_error;
    const M behind = And(met, close.s < Neg(meeting.s_error));
    close.hit = And(met, close.s > meeting.s_error);
    close.undecided = Not(Or(Or(close.hit, behind), missed));
    return close;
  }

  const Direction& to_;
  const Bravais& ball_;
  const Offset<LaneFma, D>& start_;
  const Leaving<D>* leaving_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
