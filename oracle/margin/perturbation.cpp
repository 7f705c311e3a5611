#include "oracle/margin/perturbation.hpp"

#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>

namespace lorentz::oracle {

template <std::size_t D>
InputUlps<D>::InputUlps(const Scene& scene, const Query& query, const ExactQuery<D>& exact,
                        NumberFormat of_numbers)
    : precision(of_numbers) {
  double size = 0;
  const auto see = [&](const Vec& a) { size = std::max(size, largest_component(a)); };
  for (const Lattice& lattice : scene.lattices) {
    for (const Vec& u : lattice.vectors) see(u);
    if (lattice.rank >= static_cast<int>(D)) continue;
    for (const Atom& atom : lattice.atoms) {
      see(atom.position);
      for (const Vec& axis : semiaxes_of(atom, scene.dimension)) see(axis);
    }
  }
  for (std::size_t i = 0; i < D; ++i) {
    x[i] = times_power_of_two(Real(std::max(ulp(query.x[i], precision), ulp(size, precision))),
                              -exact.length_exponent);
    v[i] = query.v[i] == 0 ? Real(0)
                           : times_power_of_two(Real(ulp(query.v[i], precision)), -exact.velocity_exponent);
  }
}

template <std::size_t D>
Uncertain<D>::Uncertain(const Scene& scene, const ExactScene<D>& exact_scene, const ExactQuery<D>& exact,
                        const InputUlps<D>& ulps, int lattice, int atom)
    : ulps_(ulps),
      lattice_(lattice),
      atom_(atom),
      view_(exact.view(exact_scene, lattice, atom)),
      rho2_(view_.radius2 * view_.velocity.v2),
      speed_(sqrt(real(view_.velocity.v2))),
      rho_(sqrt(real(rho2_))) {
  const auto& frame = exact_scene.lattices[lattice].atoms[atom].frame;
  is_ball_ = !frame;
  if (frame) {
    to_ball_transposed_ = transposed(frame->to_ball);
    radius_ulp_ = times_power_of_two(real(view_.radius), 1 - bits_of(ulps.precision));
  } else {
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) to_ball_transposed_[i][k] = i == k ? 1 : 0;
    const double radius = scene.lattices[lattice].atoms[atom].radius;
    radius_ulp_ = times_power_of_two(Real(ulp(radius, ulps.precision)), -exact.length_exponent);
  }
  for (std::size_t i = 0; i < D; ++i)
    stretch_[i] = is_ball_ ? Real(1) : sqrt(real(dot(to_ball_transposed_[i], to_ball_transposed_[i])));
  Real growth;
  for (std::size_t i = 0; i < D; ++i) growth += stretch_[i] * ulps.v[i];
  about_growth_ = estimate(growth), about_change_ = estimate(largest_change(Real(0)));
  about_radius_ = estimate(view_.radius), about_speed_ = estimate(speed_),
  about_v2_ = estimate(view_.velocity.v2);
}

template <std::size_t D>
Real Uncertain<D>::weighted(const ZVec<D>& a, const std::array<Real, D>& ulp) const {
  const ZVec<D> image = is_ball_ ? a : to_ball_transposed_ * a;
  Real sum;
  for (std::size_t i = 0; i < D; ++i) sum += abs(real(image[i])) * ulp[i];
  return sum;
}

template <std::size_t D>
Real Uncertain<D>::longest_corner(const std::array<Real, D>& ulp, bool across) const {
  const ZMatrix<D> to_ball = transposed(to_ball_transposed_);
  Real longest;
  for (int signs = 0; signs < 1 << D; ++signs) {
    Real length2, along;
    for (std::size_t i = 0; i < D; ++i) {
      Real component;
      for (std::size_t k = 0; k < D; ++k)
        component += real(to_ball[i][k]) * (signs >> k & 1 ? -ulp[k] : ulp[k]);
      length2 += component * component;
      along += component * real(view_.velocity.v[i]);
    }
    if (across) length2 -= along * along / real(view_.velocity.v2);
    if (length2 > longest) longest = length2;
  }
  return sqrt(longest);
}

template <std::size_t D>
std::array<Real, D> Uncertain<D>::ulps_at(const Real& time) const {
  std::array<Real, D> sum;
  for (std::size_t i = 0; i < D; ++i) sum[i] = ulps_.x[i] + abs(time) * ulps_.v[i];
  return sum;
}

template <std::size_t D>
Real Uncertain<D>::change_along(const ZVec<D>& direction) const {
  return weighted(direction, ulps_.x) / sqrt(real(dot(direction, direction))) + radius_ulp_;
}

template <std::size_t D>
Real Uncertain<D>::margin_of_containing(const Centre<D>& centre) const {
  const Real change =
      centre.c2 == 0 ? longest_corner(ulps_.x, false) + radius_ulp_ : change_along(centre.point.p);
  const Real sum = sqrt(real(centre.c2)) + real(view_.radius);
  return real(Z(abs(centre.c2 - view_.radius2))) / sum / change;
}

template <std::size_t D>
Real Uncertain<D>::margin_of_meeting(const Centre<D>& centre) const {
  const ExactVelocity<D>& velocity = view_.velocity;
  const std::array<Real, D> ulp = ulps_at(real(centre.s) / real(velocity.v2));
  // From the centre to the nearest point of the line: (s v - v^2 c) / v^2, of length |h| / |v|.
  ZVec<D> nearest;
  for (std::size_t i = 0; i < D; ++i) nearest[i] = centre.s * velocity.v[i] - velocity.v2 * centre.point.p[i];
  const Real h = sqrt(real(centre.h2));
  const Real change = centre.h2 == 0 ? longest_corner(ulp, true) : weighted(nearest, ulp) / (speed_ * h);
  return real(Z(abs(centre.h2 - rho2_))) / ((h + rho_) * speed_) / (change + radius_ulp_);
}

namespace {

// A lower bound of |a - b|, whose parts are known to about 50 bits.
Estimate least_difference(Estimate a, Estimate b) {
  return std::fabs(a - b) - 0x1p-45L * (std::fabs(a) + std::fabs(b));
}

}  // namespace

template <std::size_t D>
Estimate Uncertain<D>::least_of_containing(const Centre<D>& centre) const {
  return least_difference(std::sqrt(estimate(centre.c2)), about_radius_) / about_change_;
}

template <std::size_t D>
Estimate Uncertain<D>::least_of_meeting(const Centre<D>& centre) const {
  const Estimate time = std::fabs(estimate(centre.s)) / about_v2_;
  return least_difference(std::sqrt(estimate(centre.h2)) / about_speed_, about_radius_) /
         (about_change_ + time * about_growth_);
}

// |by_x| = by_radius = r / sqrt(d), with d as in time_of.
template <std::size_t D>
std::pair<Estimate, Estimate> Uncertain<D>::about_arrival(const Centre<D>& centre) const {
  const Estimate root = std::sqrt(estimate(Z(rho2_ - centre.h2)));
  const Estimate t = estimate(Z(centre.c2 - view_.radius2)) / (estimate(centre.s) + root);
  return {t, about_radius_ / root * (about_change_ + std::fabs(t) * about_growth_)};
}

template <std::size_t D>
Estimate Uncertain<D>::least_of_order(const Centre<D>& centre, const Uncertain& other,
                                      const Centre<D>& its) const {
  const auto [t1, change1] = about_arrival(centre);
  const auto [t2, change2] = other.about_arrival(its);
  return least_difference(t1, t2) / (change1 + change2);
}

template <std::size_t D>
Real Uncertain<D>::margin_of_ahead(const Centre<D>& centre) const {
  return real(Z(abs(centre.s))) / (weighted(view_.velocity.v, ulps_.x) + weighted(centre.point.p, ulps_.v));
}

// (s - sqrt(d)) / v^2 = (c^2 - r^2) / (s + sqrt(d)): if s > 0, nothing cancels in the second form; for an exit, with the
// other sign of the root, if s < 0.
template <std::size_t D>
Real Uncertain<D>::time_of(const Centre<D>& centre, ChordEnd end) const {
  const Z d = rho2_ - centre.h2;
  if (d <= 0) return real(centre.s) / real(view_.velocity.v2);
  const Real root = end == ChordEnd::entry ? -sqrt(real(d)) : sqrt(real(d));
  const bool cancels = end == ChordEnd::entry ? centre.s > 0 : centre.s < 0;
  if (cancels) return real(Z(centre.c2 - view_.radius2)) / (real(centre.s) - root);
  return (real(centre.s) + root) / real(view_.velocity.v2);
}

// t v - c = (s v - v^2 c) / v^2 -+ sqrt(d) v / v^2: two vectors at right angles; the first has integer
// components.
template <std::size_t D>
PerturbedArrival<D> Uncertain<D>::arrival(const Centre<D>& centre, ChordEnd end) const {
  if (centre.h2 >= rho2_) throw InputError("answer: the line does not meet the obstacle that it names");
  const ExactVelocity<D>& velocity = view_.velocity;
  PerturbedArrival<D> arrival;
  arrival.t = time_of(centre, end);
  const Real root = sqrt(real(Z(rho2_ - centre.h2)));
  const Real chord = end == ChordEnd::entry ? root : -root, v2 = real(velocity.v2);
  ZVec<D> nearest;
  for (std::size_t i = 0; i < D; ++i) nearest[i] = centre.s * velocity.v[i] - velocity.v2 * centre.point.p[i];
  const ZVec<D> v = to_ball_transposed_ * velocity.v, n = to_ball_transposed_ * nearest;
  for (std::size_t i = 0; i < D; ++i) arrival.by_x[i] = (real(n[i]) / chord - real(v[i])) / v2;
  arrival.by_radius = real(view_.radius) / chord;
  return arrival;
}

template <std::size_t D>
Real Uncertain<D>::largest_change(const Real& latest) const {
  const std::array<Real, D> ulp = ulps_at(latest);
  Real sum = radius_ulp_;
  for (std::size_t i = 0; i < D; ++i) sum += stretch_[i] * ulp[i];
  return sum;
}

template <std::size_t D>
Real Uncertain<D>::largest_change_across(const Real& latest) const {
  return longest_corner(ulps_at(latest), true) + radius_ulp_;
}

template <std::size_t D>
Real Uncertain<D>::change_of_time(const Centre<D>& centre, ChordEnd end) const {
  const PerturbedArrival<D> its = arrival(centre, end);
  Real change = abs(its.by_radius) * radius_ulp_;
  for (std::size_t i = 0; i < D; ++i) change += abs(its.by_x[i]) * (ulps_.x[i] + abs(its.t) * ulps_.v[i]);
  return change;
}

template <std::size_t D>
Real Uncertain<D>::margin_of_order(const Centre<D>& centre, const Uncertain& other,
                                   const Centre<D>& its) const {
  const int order = compare_entries(centre.s, rho2_ - centre.h2, view_.velocity.v2, its.s,
                                    other.rho2_ - its.h2, other.view_.velocity.v2);
  if (order == 0) return Real(0);
  const PerturbedArrival<D> one = arrival(centre), two = other.arrival(its);
  const bool same_radius = lattice_ == other.lattice_ && atom_ == other.atom_;
  Real change = same_radius ? abs(two.by_radius - one.by_radius) * radius_ulp_
                            : two.by_radius * other.radius_ulp_ + one.by_radius * radius_ulp_;
  for (std::size_t i = 0; i < D; ++i) {
    change += abs(two.by_x[i] - one.by_x[i]) * ulps_.x[i];
    change += abs(two.t * two.by_x[i] - one.t * one.by_x[i]) * ulps_.v[i];
  }
  // The obstacles are so far away that all digits carried are the same: they are translates along the flight,
  // which any error moves alike.
  if (change == 0) return Real(kLargestMargin);
  return abs(two.t - one.t) / change;
}

template struct InputUlps<2>;
template struct InputUlps<3>;
template class Uncertain<2>;
template class Uncertain<3>;

}  // namespace lorentz::oracle
