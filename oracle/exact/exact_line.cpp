#include "oracle/exact/exact_line.hpp"

namespace lorentz::oracle {
namespace {

// Integers k such that every earliest entry at t >= 0 has its index in k - 1 .. k + 2 of one of them.
struct Near {
  std::optional<Z> one, other;  // none if the row is missed
};

// In the plane of (k, t) the balls at real k fill a convex region E: {|x + t v - c(k)| < r}. The lower end of
// E at k is the entry t(k), which is convex in k.
// - If E meets the axis t = 0, it does so in an open interval: its integers are the obstacles that contain x.
//   E then lies on one side of the axis to the left of the interval, and on one side to the right of it. The
//   earliest entries are those next to the interval, the next but one if that is `from`. If the interval is
//   shorter than 2, they are within 2 of its middle, and `from` is in it or it holds no integer.
// - Otherwise E lies on one side of the axis, and t(k) is least next to its real minimum.
// - A row along v is a strip of constant width: the entries increase along the flight, and the first is the
//   one next to t = 0.
Near near_interval(const Z& centre, const Z& half2, const Z& gg) {  // (centre -+ sqrt(half2)) / gg
  if (half2 < gg * gg) return {floor_div(centre, gg), std::nullopt};
  return {floor_surd(centre, -1, half2, gg), -floor_surd(-centre, -1, half2, gg)};
}

Near near_first(const ExactRow<3>& row, const Z& rho2) {
  if (row.A == 0) {
    const Z d = rho2 - row.C;
    if (d <= 0) return {};
    // s0 + k sg = sqrt(d), so k = (-s0 + sqrt(d)) / sg.
    return {row.sg > 0 ? floor_surd(-row.s0, +1, d, row.sg) : floor_surd(row.s0, -1, d, -row.sg), {}};
  }
  const Z strip = row.B * row.B - row.A * (row.C - rho2);
  if (strip <= 0) return {};
  const Z inside = row.cg * row.cg - row.gg * (row.cc - rho2);
  if (inside > 0) return near_interval(-row.cg, inside, row.gg);
  // dt/dk = 0: A k + B = -sign(sg) sqrt(sg^2 strip / gg).
  return {floor_surd(-row.B * row.gg, -sgn(row.sg), row.sg * row.sg * strip * row.gg, row.A * row.gg), {}};
}

// The same in the plane, where A = h_g^2, B = h0 h_g and C = h0^2 allow shorter numbers.
Near near_first(const FlightPoint& start, const FlightPoint& step, const Z& rho2) {
  if (step.h == 0) {
    const Z d = rho2 - start.h * start.h;
    if (d <= 0) return {};
    return {step.s > 0 ? floor_surd(-start.s, +1, d, step.s) : floor_surd(start.s, -1, d, -step.s), {}};
  }
  const Z gg = step.s * step.s + step.h * step.h, off = minor_of(start.s, start.h, step.s, step.h);
  const Z inside = gg * rho2 - off * off;
  if (inside > 0) return near_interval(-(start.s * step.s + start.h * step.h), inside, gg);
  return {
      floor_surd(-sgn(step.h) * start.h * gg, -sgn(step.s), step.s * step.s * rho2 * gg, gg * abs(step.h)),
      {}};
}

// Offers the entry at t >= 0 into the obstacle n + k step, if there is one.
template <std::size_t D>
void offer_entry(const Search<D>& search, Z s, Z d, const ZVec<D>& n, const Z& k, const ZVec<D>& step) {
  if (s <= 0) return;
  if (d <= 0) return;
  if (s * s < d) return;  // v^2 c.c = s^2 + |h|^2: x lies in it
  const int order = search.earliest.order_of(s, d, search.velocity.v2);
  if (order > 0) return;
  ZVec<D> cell = n;
  for (std::size_t i = 0; i < D; ++i) cell[i].add_product(k, step[i]);
  if (search.from && cell == *search.from) return;
  search.earliest.offer(
      {std::move(s), std::move(d), search.velocity.v2, std::move(cell), search.lattice, search.atom}, order);
}

// For any number of obstacles that the line meets in the row.
void offer_first_of_many(const Search<2>& search, const FlightPoint& start, const FlightPoint& step) {
  const Near near = near_first(start, step, search.rho2);
  for (const std::optional<Z>& one : {near.one, near.other})
    for (int i = -1; one && i <= 2; ++i) {
      const Z k = *one + i, h = start.h + k * step.h;
      offer_entry(search, start.s + k * step.s, search.rho2 - h * h, start.n, k, step.n);
    }
}

void offer_first_of_many(const Search<3>& search, const LatticePoint<3>& start, const LatticePoint<3>& step) {
  const ExactRow<3> row(search.velocity, start, step);
  const Near near = near_first(row, search.rho2);
  for (const std::optional<Z>& one : {near.one, near.other})
    for (int i = -1; one && i <= 2; ++i) {
      const Z k = *one + i, d = search.rho2 - (row.C + k * (2 * row.B + k * row.A));
      offer_entry(search, row.s0 + k * row.sg, d, start.n, k, step.n);
    }
}

// Rows in which about this many obstacles at most are candidates are tried obstacle by obstacle, which takes
// no root.
constexpr long kFew = 5;

}  // namespace

void FlightPoint::negate() {
  s = -s;
  h = -h;
  for (Z& component : n) component = -component;
}

RowsInPlane::RowsInPlane(const Search<2>& search, const FlightPoint& step)
    : search_(search), step_(step), gap_(abs(step.h)), short_(2 * search.rho < kFew * gap_) {}

void RowsInPlane::offer_first(const FlightPoint& start) const {
  if (!short_) return offer_first_of_many(search_, start, step_);
  // |h + k h_g| <= rho
  const bool rises = step_.h > 0;
  Z k = rises ? ceil_div(-search_.rho - start.h, gap_) : ceil_div(start.h - search_.rho, gap_);
  Z h = start.h + k * step_.h, s = start.s + k * step_.s;
  while (rises ? h <= search_.rho : h >= -search_.rho) {
    offer_entry(search_, s, search_.rho2 - h * h, start.n, k, step_.n);
    ++k, h += step_.h, s += step_.s;
  }
}

// A |h|^2 = (A k + B)^2 + v^2 (h_g . start)^2, because h0 x h_g = v (h_g . start) up to the sign.
RowsInSpace::RowsInSpace(const Search<3>& search, const LatticePoint<3>& step)
    : search_(search),
      step_(step),
      sg_(dot(search.velocity.v, step.p)),
      A_(search.velocity.v2 * dot(step.p, step.p) - sg_ * sg_),
      h_g_(cross(search.velocity.v, step.p)) {
  const Z along2 = search.rho2 * A_;
  most_along_ = floor_sqrt(along2);
  most_beside_ = floor_sqrt(floor_div(along2, search.velocity.v2));
  short_ = 2 * most_along_ < kFew * A_;
}

void RowsInSpace::offer_first(const LatticePoint<3>& start) const {
  const ExactVelocity<3>& velocity = search_.velocity;
  if (!short_) return offer_first_of_many(search_, start, step_);
  if (compare_sizes(dot(h_g_, start.p), most_beside_) > 0) return;
  const Z s0 = dot(velocity.v, start.p);
  const Z B = velocity.v2 * dot(start.p, step_.p) - s0 * sg_;
  Z k = ceil_div(-most_along_ - B, A_);
  Z along = A_ * k + B;
  if (along > most_along_) return;
  const Z C = velocity.v2 * dot(start.p, start.p) - s0 * s0;
  for (; along <= most_along_; ++k, along += A_)
    offer_entry(search_, s0 + k * sg_, search_.rho2 - (C + k * (B + along)), start.n, k, step_.n);
}

}  // namespace lorentz::oracle
