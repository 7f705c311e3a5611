// A single obstacle on the line of flight: nothing to search for. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/atom_direction.hpp"
#include "src/engines/reduction/found.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/lone_obstacle-inl.hpp"
#undef LORENTZ_INLINE

/// A direction of flight for a single ball. (A single ellipsoid takes AtomDirection: in its own frame it is
/// as in a lattice.)
template <int D>
struct LoneDirection {
  struct {
    Vec v;
    double v2, s_rho;
  } direction;
  Octant octant;

  template <class Arch>
  LoneDirection(Arch, const Bravais& obstacle, const Vec& v) {
    octant.turn<false>(v, direction.v);
    direction.v2 = speed_squared(direction.v[0], direction.v[1], direction.v[2]);
    direction.s_rho = width_of(obstacle.radius, direction.v2);
  }

  template <class Arch>
  static void set(std::optional<LoneDirection>& to, Arch arch, const Bravais*, const Bravais& obstacle,
                  const Vec& v) {
    to.emplace(arch, obstacle, v);
  }
};

/// As Search2 and Search3. A ball in binary64 if that is certain; else, and an ellipsoid, in double-double.
template <int D, bool kBall>
class LoneSearch {
 public:
  Found<D> found;

  template <class Direction>
  LoneSearch(const Bravais& obstacle, const Direction& to, const Offset<SplitProduct, D>& offset)
      : obstacle_(obstacle), v_{to.v[0], to.v[1], D == 3 ? to.v[2] : 0}, v2_(to.v2), offset_(offset) {}

  Outcome run(const Wide* from, double) {
    if (from) return Outcome::never;  // which can be no other
    for (Wide& n : found.N) n = Wide();
    if constexpr (kBall) {
      double v[D];
      std::copy_n(v_.begin(), D, v);
      const LoneBall<SplitProduct, D> ball(v, offset_.d, offset_.error, v2_, obstacle_.radius);
      if (ball.is_missed() || ball.is_behind()) return Outcome::never;
      found.s = ball.s, found.s_error = ball.s_error;
      found.slack = ball.slack, found.slack_error = ball.slack_error;
      if (ball.is_met() && ball.is_ahead()) return Outcome::hit;
    }
    return run_closely();
  }

 private:
  [[gnu::noinline]] Outcome run_closely() {
    found.needs(Stage::double_double);
    const StableMeeting<SplitProduct, D, kBall> meeting(v_, offset_.d, offset_.error, obstacle_);
    for (const Decision decision : {meets(meeting), is_ahead(meeting)}) {
      if (decision == Decision::no) return Outcome::never;
      if (decision == Decision::yes) continue;
      found.stage = Stage::undecided;
      return Outcome::undecided;
    }
    found.s = meeting.s.hi, found.slack = meeting.slack.hi;
    found.s_error = meeting.s_error + kRoundoff * found.s;
    found.slack_error = meeting.slack_error + kRoundoff * found.slack;
    if constexpr (D == 2) found.h = difference_of_products(offset_.d[1], v_[0], offset_.d[0], v_[1]).hi;
    return Outcome::hit;
  }

  const Bravais& obstacle_;
  const Vec v_;
  const double v2_;
  const Offset<SplitProduct, D>& offset_;
};

}  // namespace lorentz
