// One flight and one specular reflection in balls, and their derivative. Private to oracle/itinerary.
//
// Everything is linear algebra in coordinates w = K y in which the obstacle is a ball of radius R around 0
// (exact_problem.hpp: BallFrame); if the obstacle is a ball, K is 1. With u = K v, a = u.u, s = -w.u and the
// part across,
//   D = R^2 a - |w x u|^2,   t = (s - sqrt(D)) / a,   w' = w + t u,   y' = y + t v.
// The normal is along m = K^T w'. Because v.m = u.w' = -sqrt(D),
//   v' = v + 2 sqrt(D) / (m.m) m.
#pragma once

#include <optional>

#include "oracle/exact/exact_problem.hpp"
#include "oracle/itinerary/ball.hpp"

namespace lorentz::oracle {

/// A particle: its position y relative to the centre of the obstacle that it leaves, its velocity, and the
/// time since the start.
template <std::size_t D>
struct State {
  BallVec<D> y, v;
  Ball t;

  /// The same with y relative to another centre than `before`.
  State seen_from(const ZVec<D>& before, const ZVec<D>& centre) const {
    State state = *this;
    for (std::size_t i = 0; i < D; ++i) state.y[i] += Ball(before[i] - centre[i]);
    return state;
  }
};

/// An obstacle's form in balls: K (absent for a ball), R and R^2.
template <std::size_t D>
struct Form {
  std::optional<std::array<BallVec<D>, D>> to_ball;
  Ball radius, radius2;

  explicit Form(const ExactAtom<D>& atom) : radius(atom.radius), radius2(atom.radius * atom.radius) {
    if (!atom.frame) return;
    to_ball.emplace();
    for (std::size_t i = 0; i < D; ++i) (*to_ball)[i] = balls<D>(atom.frame->to_ball[i]);
  }

  BallVec<D> in_ball(const BallVec<D>& y) const {
    if (!to_ball) return y;
    BallVec<D> w;
    for (std::size_t i = 0; i < D; ++i) w[i] = dot((*to_ball)[i], y);
    return w;
  }
  /// K^T w
  BallVec<D> back(const BallVec<D>& w) const {
    if (!to_ball) return w;
    BallVec<D> m;
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t i = 0; i < D; ++i) m[k].add_product((*to_ball)[i][k], w[i]);
    return m;
  }
};

inline Ball across_squared(const BallVec<2>& w, const BallVec<2>& u) {
  return square(w[0] * u[1] - w[1] * u[0]);
}

inline Ball across_squared(const BallVec<3>& w, const BallVec<3>& u) {
  Ball sum;
  for (std::size_t i = 0; i < 3; ++i) sum += square(w[i] * u[(i + 1) % 3] - w[(i + 1) % 3] * u[i]);
  return sum;
}

template <std::size_t D>
struct EnclosedCollision {
  Ball flight;      ///< t
  Ball root;        ///< sqrt(D), above 0
  BallVec<D> w, m;  ///< w', m
  Ball m2;          ///< m.m
  State<D> before;  ///< with y relative to the centre of the obstacle that is hit
  State<D> after;
};

/// The collision of a particle with the obstacle around 0; nothing if it is not certain that the particle
/// meets it.
template <std::size_t D>
std::optional<EnclosedCollision<D>> collide(const State<D>& state, const Form<D>& form) {
  EnclosedCollision<D> c;
  c.before = state;
  const BallVec<D> w = form.in_ball(state.y), u = form.in_ball(state.v);
  const Ball a = dot(u, u), d = form.radius2 * a - across_squared(w, u);
  if (!d.is_positive()) return std::nullopt;
  c.root = sqrt(d);
  c.flight = (-dot(w, u) - c.root) / a;
  for (std::size_t i = 0; i < D; ++i) {
    c.w[i] = w[i] + c.flight * u[i];
    c.after.y[i] = state.y[i] + c.flight * state.v[i];
  }
  c.m = form.back(c.w);
  c.m2 = form.to_ball ? dot(c.m, c.m) : form.radius2;
  const Ball kick = scaled(c.root / c.m2, 1);
  for (std::size_t i = 0; i < D; ++i) c.after.v[i] = state.v[i] + kick * c.m[i];
  c.after.t = state.t + c.flight;
  return c;
}

/// The change of the particle after the collision that a small change before it causes. With
/// dq = K (dy + t dv):
///   dt = w'.dq / sqrt(D),   dw' = dq + u dt,   dm = K^T dw',   d(v.m) = dv.m + v.dm,
///   dv' = dv - 2 (d(v.m) m + (v.m) dm) / m^2 + 4 (v.m) (m.dm) m / m^4.
template <std::size_t D>
State<D> derivative(const EnclosedCollision<D>& c, const Form<D>& form, const State<D>& change) {
  BallVec<D> drift;
  for (std::size_t i = 0; i < D; ++i) drift[i] = change.y[i] + c.flight * change.v[i];
  BallVec<D> dw = form.in_ball(drift);
  const Ball dt = dot(c.w, dw) / c.root;
  const BallVec<D> u = form.in_ball(c.before.v);
  for (std::size_t i = 0; i < D; ++i) dw[i].add_product(u[i], dt);
  const BallVec<D> dm = form.back(dw);
  const Ball dvm = dot(change.v, c.m) + dot(c.before.v, dm);
  const Ball along = -scaled(dvm / c.m2 + scaled(c.root * dot(c.m, dm) / square(c.m2), 1), 1);
  const Ball beside = scaled(c.root / c.m2, 1);
  State<D> result;
  for (std::size_t i = 0; i < D; ++i) {
    result.y[i] = drift[i] + c.before.v[i] * dt;
    result.v[i] = change.v[i] + along * c.m[i] + beside * dm[i];
  }
  result.t = change.t + dt;
  return result;
}

}  // namespace lorentz::oracle
