// The search of the published algorithm in the square and the cubic lattice, as its authors' program has it,
// faults included (docs/published.md): which disc, which sphere it comes up with. Private to published*.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <lorentz/engine.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/published/published.hpp"

namespace lorentz::published_search {

// A lattice point, kept as binary64 integers as long as it is searched for.
using Disc = std::array<double, 2>;

enum class Found { disc, channel, gave_up, no_octant };

struct PlaneResult {
  Found found = Found::disc;
  Disc disc{};
};

inline double length(double a, double b) {
  return std::sqrt(a * a + b * b);
}

inline double distance_to_integers(double b) {
  return std::min(b, 1 - b);
}

// The first convergent denominator q of m with |q m - p| <= tolerance, the expansion computed from its start.
inline double first_denominator(double m, double tolerance) {
  double x = m, p_before = 0, p = 1, q_before = 1, q = 0;
  for (int term = 0; term < 100; ++term) {
    const double a = std::floor(x);
    const double p_next = a * p + p_before, q_next = a * q + q_before;
    p_before = p, p = p_next, q_before = q, q = q_next;
    if (std::fabs(q * m - p) <= tolerance || x == a) break;
    x = 1 / (x - a);
  }
  return q;
}

// Step 3: from height b at a column, how many columns on the line comes within eps of an integer height.
struct Columns {
  Found found;
  double k = 0;
};

inline Columns columns_ahead(double m, double b, double eps, long& passes_left) {
  double k = 0;
  const auto step = [&] {
    const double q = first_denominator(m, 2 * distance_to_integers(b));
    b = m * q + b;
    b -= std::floor(b);
    k += q;
  };
  // The fault behind the skipped discs: the tolerance of this first step should be eps + min(b, 1 - b).
  const double first = b;
  if (distance_to_integers(b) < eps) step();
  while (b > eps && 1 - b > eps) {
    if (passes_left-- <= 0 || k > 0x1p52) return {Found::gave_up};
    step();
    if (b == first) return {Found::channel};
  }
  return {Found::disc, k};
}

// First octant, 0 < v2 <= v1, v of unit length.
inline PlaneResult first_octant(double x1, double x2, double v1, double v2, double r, const Disc* from,
                                long& passes_left) {
  const double n1 = std::floor(x1), n2 = std::floor(x2);
  x1 -= n1, x2 -= n2;
  const double m = v2 / v1, eps = r / v1;
  const double b1 = x2 + m * (1 - x1), b2 = x2 - m * x1;
  const auto is_next = [&](double c1, double c2, double miss) {
    const bool ahead = (x1 - c1) * v1 + (x2 - c2) * v2 < 0;
    const bool left = from && *from == Disc{n1 + c1, n2 + c2};
    return ahead && !left && std::fabs(miss) < eps;
  };
  if (is_next(1, 0, b1)) return {Found::disc, {n1 + 1, n2}};
  if (is_next(0, 1, 1 - b2)) return {Found::disc, {n1, n2 + 1}};
  if (is_next(1, 1, 1 - b1)) return {Found::disc, {n1 + 1, n2 + 1}};
  if (is_next(1, 2, 2 - b1)) return {Found::disc, {n1 + 1, n2 + 2}};
  const Columns columns = columns_ahead(m, b1 - std::floor(b1), eps, passes_left);
  return {columns.found, {n1 + 1 + columns.k, n2 + std::round(b1 + m * columns.k)}};
}

// Any direction, by reflections and the exchange of the axes, undone at the end.
inline PlaneResult first_disc(Disc x, Disc v, double r, const Disc* from, long& passes_left) {
  const Disc home{std::round(x[0]), std::round(x[1])};
  const bool left = from && *from == home;
  if (!left && length(x[0] - home[0], x[1] - home[1]) < r) return {Found::disc, home};
  if (v[0] == 0 || v[1] == 0) return {Found::no_octant};
  const double speed = length(v[0], v[1]);
  const double sign[2] = {std::copysign(1, v[0]), std::copysign(1, v[1])};
  const int long_axis = std::fabs(v[0]) >= std::fabs(v[1]) ? 0 : 1, short_axis = 1 - long_axis;
  const auto reflected = [&](const Disc& a) {
    return Disc{sign[long_axis] * a[long_axis], sign[short_axis] * a[short_axis]};
  };
  const Disc place = reflected(x), direction = reflected(v);
  const Disc reflected_from = from ? reflected(*from) : Disc{};
  PlaneResult result = first_octant(place[0], place[1], direction[0] / speed, direction[1] / speed, r,
                                    from ? &reflected_from : nullptr, passes_left);
  Disc disc;
  disc[long_axis] = sign[long_axis] * result.disc[0];
  disc[short_axis] = sign[short_axis] * result.disc[1];
  result.disc = disc;
  return result;
}

inline bool cell_of(const ObstacleId& id, Vec& n) {
  for (int i = 0; i < 3; ++i) {
    if (!id.cell[i].fits_int64()) return false;  // a disc farther off than that is never met
    n[i] = static_cast<double>(id.cell[i].int64());
  }
  return true;
}

inline Vec minus(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The time at which the line leaves the disc of radius r around the origin, or is closest to it if it misses
// it.
inline double exit_time(const Vec& x, const Vec& v, double r) {
  const double v2 = dot(v, v), B = dot(x, v) / v2, C = (dot(x, x) - r * r) / v2;
  return -B + std::sqrt(std::max(B * B - C, 0.0));
}

// Why a search found no disc, as the answer that this makes; nothing if it found one.
inline std::optional<Answer> answer_for(Found found) {
  switch (found) {
    case Found::channel:
      return Answer::never();
    case Found::gave_up:
      return Answer::undecided();
    case Found::no_octant:
      return Answer::unsupported_because("published has no octant for directions along an axis");
    case Found::disc:
      break;
  }
  return std::nullopt;
}

// The discs that the 2D algorithm finds in the coordinate planes xy, xz and yz.
inline constexpr int kPlanes[3][2] = {{0, 1}, {0, 2}, {1, 2}};

// How far to go for the disc that is farthest off in its own plane; short of it by a tenth of the radius.
inline double advance_to_farthest(const Disc (&disc)[3], const Vec& x, const Vec& v, double r) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (int plane = 0; plane < 3; ++plane) {
    const auto [i, k] = kPlanes[plane];
    const double distance = length(disc[plane][0] - x[i], disc[plane][1] - x[k]) - r;
    farthest = std::max(farthest, distance / length(v[i], v[k]));
  }
  if (farthest < 0) farthest = 0.1 * r;
  return farthest - 0.1 * r;
}

// How many passes each search in a plane may take, or all of them together; and a count of those taken.
struct Passes {
  long most;
  bool is_total;
  long long& taken;
};

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The 3D procedure from x along the unit vector v, to the distance `limit`. `is_hit(centre, x, elapsed)`,
// asked of each sphere that the planes agree on, gives the distance from x to the hit, or nothing. The answer
// has no obstacle, that is `centre`, and its time is a distance.
template <class IsHit>
Answer first_sphere(Vec x, const Vec& v, double r, const Vec* from, Passes passes, double limit,
                    const IsHit& is_hit, Vec& centre) {
  double elapsed = 0;  // in units of length
  const auto advance = [&](double distance) {
    for (int i = 0; i < 3; ++i) x[i] += distance * v[i];
    elapsed += distance;
  };
  long passes_left = passes.most;
  for (long round = 0; round < Published::kMaxRounds; ++round) {
    if (elapsed > limit) return Answer::never();
    Disc disc[3];
    for (int plane = 0; plane < 3; ++plane) {
      const auto [i, k] = kPlanes[plane];
      if (!(std::fabs(x[i]) < kMaxStart && std::fabs(x[k]) < kMaxStart)) return Answer::undecided();
      const Disc leaving = from ? Disc{(*from)[i], (*from)[k]} : Disc{};
      if (!passes.is_total) passes_left = passes.most;
      const long before = passes_left;
      const PlaneResult result =
          first_disc({x[i], x[k]}, {v[i], v[k]}, r, from && round == 0 ? &leaving : nullptr, passes_left);
      passes.taken += before - passes_left + 1;
      if (auto answer = answer_for(result.found)) return *answer;
      disc[plane] = result.disc;
    }
    advance(advance_to_farthest(disc, x, v, r));
    const bool agree = disc[0][0] == disc[1][0] && disc[0][1] == disc[2][0] && disc[1][1] == disc[2][1];
    if (!agree) continue;
    centre = {disc[0][0], disc[0][1], disc[1][1]};
    if (const auto time = is_hit(centre, x, elapsed)) return Answer::hit({}, elapsed + *time);
    // The fault behind the late spheres: from next to a sphere that was missed this can land inside another
    // one.
    advance(1 - 2 * r);
  }
  return Answer::undecided();
}

}  // namespace lorentz::published_search
