#include "src/engines/reduction/obstacle_unrounded.hpp"

#include <cmath>
#include <utility>

namespace lorentz {
namespace {

using Expansions = Expansion[3];

Expansion product(const Expansion& a, const Expansion& b) {
  Expansion product;
  product.add_product(a, b);
  return product;
}

Expansion dot(const Expansions& a, const Expansions& b) {
  Expansion sum;
  for (int k = 0; k < 3; ++k) sum.add_product(a[k], b[k]);
  return sum;
}

Expansion cross(const Expansions& a, const Expansions& b, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  Expansion difference;
  difference.add_product(a[i], b[j]);
  difference.add_product(a[j], b[i], -1);
  return difference;
}

// Component k of the cross product of the semiaxes other than i.
Expansion minor_of(const Vec (&axes)[3], int i, int k) {
  const Vec &c = axes[(i + 1) % 3], &d = axes[(i + 2) % 3];
  const int l = (k + 1) % 3, m = (k + 2) % 3;
  Expansion minor;
  minor.add_product(Expansion(c[l]), Expansion(d[m]));
  minor.add_product(Expansion(c[m]), Expansion(d[l]), -1);
  return minor;
}

std::optional<std::strong_ordering> sign_of(const Expansion& a) {
  const double value = a.value();
  if (!a.is_exact() || !std::isfinite(value)) return std::nullopt;
  return value > 0   ? std::strong_ordering::greater
         : value < 0 ? std::strong_ordering::less
                     : std::strong_ordering::equal;
}

// Coordinate i of a along the semiaxes, times their volume.
Expansion coordinate_in(const Vec (&axes)[3], int i, const Expansions& a) {
  Expansion coordinate;
  for (int k = 0; k < 3; ++k) coordinate.add_product(minor_of(axes, i, k), a[k]);
  return coordinate;
}

Expansion volume_of(const Vec (&axes)[3]) {
  const Expansions first = {Expansion(axes[0][0]), Expansion(axes[0][1]), Expansion(axes[0][2])};
  return coordinate_in(axes, 0, first);
}

// The sign of a + sqrt(b) - sqrt(c), where b, c > 0.
std::optional<std::strong_ordering> sign_with_roots(const Expansion& a, const Expansion& b,
                                                    const Expansion& c) {
  const auto sign = sign_of(a);
  if (!sign) return std::nullopt;
  if (*sign < 0) {
    Expansion opposite;
    opposite.add_product(a, Expansion(-1));
    const auto turned = sign_with_roots(opposite, c, b);
    if (!turned) return std::nullopt;
    return 0 <=> *turned;
  }
  // (a + sqrt(b))^2 - c = e + 2 a sqrt(b).
  Expansion e = product(a, a);
  e.add_product(b, Expansion(1));
  e.add_product(c, Expansion(-1));
  const auto sign_of_e = sign_of(e);
  if (!sign_of_e || *sign == 0) return sign_of_e;
  if (*sign_of_e >= 0) return std::strong_ordering::greater;
  Expansion difference;
  difference.add_product(product(a, a), b, 4);
  difference.add_product(e, e, -1);
  return sign_of(difference);
}

}  // namespace

std::optional<UnroundedObstacle> UnroundedObstacle::of(const Task& task, const Bravais& lattice,
                                                       const std::array<std::int64_t, 3>& cell) {
  if (!task.is_whole() || !lattice.whole) return std::nullopt;
  UnroundedObstacle obstacle;
  for (int k = 0; k < 3; ++k) {
    obstacle.v_[k] = Expansion(task.ray.v[k]);
    Expansion& d = obstacle.d_[k];
    d = Expansion(lattice.position[k]);
    d.add(-task.x[k]);
    for (int j = 0; j < 3; ++j) {
      const auto high = static_cast<double>(cell[j]);
      Expansion n(high);
      n.add(static_cast<double>(cell[j] - static_cast<WideInteger>(high)));
      d.add_product(n, Expansion(lattice.primitive[j][k]));
    }
  }
  obstacle.radius_ = Expansion(lattice.radius);
  obstacle.is_ball_ = lattice.is_ball;
  if (lattice.is_ball) return obstacle;
  const auto& axes = lattice.shape.semiaxes;
  Expansions v, d;
  std::swap(v, obstacle.v_), std::swap(d, obstacle.d_);
  for (int i = 0; i < 3; ++i) {
    obstacle.v_[i] = coordinate_in(axes, i, v);
    obstacle.d_[i] = coordinate_in(axes, i, d);
  }
  obstacle.radius_ = volume_of(axes);
  const double scale = lattice.radius / obstacle.radius_.value();
  obstacle.slack_scale_ = scale * scale * (scale * scale);
  return obstacle;
}

// The centres are at most as far apart as two radii.
std::optional<bool> overlaps_translate(const Vec (&semiaxes)[3], const Vec (&u)[3], const Vec& t) {
  Expansions apart, seen;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) apart[k].add_product(Expansion(t[j]), Expansion(u[j][k]));
  for (int i = 0; i < 3; ++i) seen[i] = coordinate_in(semiaxes, i, apart);
  const Expansion volume = volume_of(semiaxes);
  Expansion gap = dot(seen, seen);
  gap.add_product(volume, volume, -4);
  const auto sign = sign_of(gap);
  if (!sign) return std::nullopt;
  return *sign < 0;
}

Expansion UnroundedObstacle::slack() const {
  Expansion slack = product(product(radius_, radius_), dot(v_, v_));
  for (int k = 0; k < 3; ++k) {
    const Expansion across = cross(v_, d_, k);
    slack.add_product(across, across, -1);
  }
  return slack;
}

Expansion UnroundedObstacle::along() const {
  return dot(v_, d_);
}

Expansion UnroundedObstacle::gap() const {
  Expansion gap = dot(d_, d_);
  gap.add_product(radius_, radius_, -1);
  return gap;
}

// It is entered at (s - sqrt(slack)) / v^2.
Decision is_entered_before(const UnroundedObstacle& obstacle, double time) {
  Expansion late = obstacle.along(), difference;
  late.add_product(dot(obstacle.v_, obstacle.v_), Expansion(time), -1);
  const auto sign = sign_of(late), outside = sign_of(obstacle.gap());
  if ((sign && *sign < 0) || (outside && *outside == 0)) return Decision::yes;  // at once, if x is on it
  difference.add_product(late, late);
  difference.add_product(obstacle.slack(), Expansion(-1));
  const auto order = sign_of(difference);
  return !sign || !order ? Decision::doubtful : *order < 0 ? Decision::yes : Decision::no;
}

std::optional<std::strong_ordering> order_of_entry(const UnroundedObstacle& one,
                                                   const UnroundedObstacle& other) {
  Expansion a, slack = one.slack(), other_slack = other.slack();
  if (one.is_ball_ && other.is_ball_) {
    a = one.along();
    a.add_product(other.along(), Expansion(-1));
  } else {
    const Expansion v2 = dot(one.v_, one.v_), other_v2 = dot(other.v_, other.v_);
    a.add_product(one.along(), other_v2);
    a.add_product(other.along(), v2, -1);
    slack = product(slack, product(other_v2, other_v2));
    other_slack = product(other_slack, product(v2, v2));
  }
  return sign_with_roots(a, other_slack, slack);
}

void look_unrounded(const UnroundedObstacle& obstacle, CloseLook<SplitProduct>& close) {
  const Expansion slack = obstacle.slack();
  const auto met = sign_of(slack), ahead = sign_of(obstacle.along());
  if (!met || !ahead) return;
  close.slack = slack.value() * obstacle.slack_scale();
  close.slack_error = kUnroundedSlack * kRoundoff * std::fabs(close.slack);
  close.is_met = *met > 0, close.is_missed = !close.is_met;
  close.is_ahead = *ahead > 0, close.is_behind = !close.is_ahead;
}

Decision is_inside_unrounded(const UnroundedObstacle& obstacle) {
  const auto outside = sign_of(obstacle.gap());
  return !outside ? Decision::doubtful : *outside < 0 ? Decision::yes : Decision::no;
}

}  // namespace lorentz
