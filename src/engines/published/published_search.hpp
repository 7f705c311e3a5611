// The search of the published algorithm in the square and the cubic lattice, as in its authors' program,
// faults included (docs/published.md): which disc or sphere it proposes. It works in any number type T that
// has floor, round, fabs, copysign and sqrt. In binary64 the parameter T changes no operation. Private to
// this folder and to question/precisions.
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

using std::copysign, std::fabs, std::floor, std::round, std::sqrt;  // and those of other number types

template <class T>
using Triple = std::array<T, 3>;

// A lattice point, kept as integers of the number type during the search.
template <class T>
using Disc = std::array<T, 2>;

// The properties of a number type. question/precisions has those of types that are not C++'s own.
template <class T>
struct NumberType {
  static constexpr int kDigits = std::numeric_limits<T>::digits;  // integers up to 2^kDigits are exact
  static double binary64(const T& a) { return a; }
  static Integer integer(const T& a) { return std::llround(a); }
};

// 2^51 and 2^52 in binary64. Places beyond the first have no digits left within a cell; columns beyond the
// second are no longer counted.
template <class T>
T farthest_place() {
  return T(std::ldexp(1.0, NumberType<T>::kDigits - 2));
}
template <class T>
T most_columns() {
  return T(std::ldexp(1.0, NumberType<T>::kDigits - 1));
}

enum class Proposed { disc, channel, gave_up, no_octant };

template <class T>
struct PlaneResult {
  Proposed found = Proposed::disc;
  Disc<T> disc{};
};

template <class T>
T length(const T& a, const T& b) {
  return sqrt(a * a + b * b);
}

template <class T>
T distance_to_integers(const T& b) {
  return std::min<T>(b, 1 - b);
}

// The first convergent denominator q of m with |q m - p| <= tolerance. The expansion is computed from its
// start.
template <class T>
T first_denominator(const T& m, const T& tolerance) {
  T x = m, p_before = 0, p = 1, q_before = 1, q = 0;
  for (int term = 0; term < 100; ++term) {
    const T a = floor(x);
    const T p_next = a * p + p_before, q_next = a * q + q_before;
    p_before = p, p = p_next, q_before = q, q = q_next;
    if (fabs(q * m - p) <= tolerance || x == a) break;
    x = 1 / (x - a);
  }
  return q;
}

// Step 3: the number of columns from a column with height b to the one where the line comes within eps of an
// integer height.
template <class T>
struct Columns {
  Proposed found;
  T k = 0;
};

template <class T>
Columns<T> columns_ahead(const T& m, T b, const T& eps, long& passes_left) {
  T k = 0;
  const T most = most_columns<T>();
  const auto step = [&] {
    const T q = first_denominator<T>(m, 2 * distance_to_integers(b));
    b = m * q + b;
    b -= floor(b);
    k += q;
  };
  // The fault behind the skipped discs: the tolerance of this first step should be eps + min(b, 1 - b).
  const T first = b;
  if (distance_to_integers(b) < eps) step();
  while (b > eps && 1 - b > eps) {
    if (passes_left-- <= 0 || k > most) return {Proposed::gave_up};
    step();
    if (b == first) return {Proposed::channel};
  }
  return {Proposed::disc, k};
}

// The first disc for a direction in the first octant, 0 < v2 <= v1, with v of unit length.
template <class T>
PlaneResult<T> first_octant(T x1, T x2, const T& v1, const T& v2, const T& r, const Disc<T>* from,
                            long& passes_left) {
  const T n1 = floor(x1), n2 = floor(x2);
  x1 -= n1, x2 -= n2;
  const T m = v2 / v1, eps = r / v1;
  const T b1 = x2 + m * (1 - x1), b2 = x2 - m * x1;
  const auto is_next = [&](const T& c1, const T& c2, const T& miss) {
    const bool ahead = (x1 - c1) * v1 + (x2 - c2) * v2 < 0;
    const bool left = from && *from == Disc<T>{n1 + c1, n2 + c2};
    return ahead && !left && fabs(miss) < eps;
  };
  if (is_next(1, 0, b1)) return {Proposed::disc, {n1 + 1, n2}};
  if (is_next(0, 1, 1 - b2)) return {Proposed::disc, {n1, n2 + 1}};
  if (is_next(1, 1, 1 - b1)) return {Proposed::disc, {n1 + 1, n2 + 1}};
  if (is_next(1, 2, 2 - b1)) return {Proposed::disc, {n1 + 1, n2 + 2}};
  const Columns<T> columns = columns_ahead<T>(m, b1 - floor(b1), eps, passes_left);
  return {columns.found, {n1 + 1 + columns.k, n2 + round(b1 + m * columns.k)}};
}

// The first disc for any direction: by reflections and an exchange of the axes, which are undone at the end.
template <class T>
PlaneResult<T> first_disc(const Disc<T>& x, const Disc<T>& v, const T& r, const Disc<T>* from,
                          long& passes_left) {
  const Disc<T> home{round(x[0]), round(x[1])};
  const bool left = from && *from == home;
  if (!left && length<T>(x[0] - home[0], x[1] - home[1]) < r) return {Proposed::disc, home};
  if (v[0] == 0 || v[1] == 0) return {Proposed::no_octant, {}};
  const T speed = length(v[0], v[1]);
  const T sign[2] = {copysign(T(1), v[0]), copysign(T(1), v[1])};
  const int long_axis = fabs(v[0]) >= fabs(v[1]) ? 0 : 1, short_axis = 1 - long_axis;
  const auto reflected = [&](const Disc<T>& a) {
    return Disc<T>{sign[long_axis] * a[long_axis], sign[short_axis] * a[short_axis]};
  };
  const Disc<T> place = reflected(x), direction = reflected(v);
  const Disc<T> reflected_from = from ? reflected(*from) : Disc<T>{};
  PlaneResult<T> result = first_octant<T>(place[0], place[1], direction[0] / speed, direction[1] / speed, r,
                                          from ? &reflected_from : nullptr, passes_left);
  Disc<T> disc;
  disc[long_axis] = sign[long_axis] * result.disc[0];
  disc[short_axis] = sign[short_axis] * result.disc[1];
  result.disc = disc;
  return result;
}

template <class T>
bool cell_of(const ObstacleId& id, Triple<T>& n) {
  for (int i = 0; i < 3; ++i) {
    if (!id.cell[i].fits_int64()) return false;  // no start is beside a disc that is farther away
    n[i] = static_cast<T>(id.cell[i].int64());
  }
  return true;
}

template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Triple<T> minus(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The textbook quadratic, as lorentz::entry_time has it.
template <class T>
std::optional<T> entry_time(const Triple<T>& x, const Triple<T>& v, const T& r) {
  const T v2 = dot(v, v), B = dot(x, v) / v2, C = (dot(x, x) - r * r) / v2;
  const T discriminant = B * B - C;
  if (discriminant < 0) return std::nullopt;
  return -B - sqrt(discriminant);
}

// The time at which the line leaves the disc of radius r around the origin. If the line misses the disc, the
// time at which it is closest to it.
template <class T>
T exit_time(const Triple<T>& x, const Triple<T>& v, const T& r) {
  const T v2 = dot(v, v), B = dot(x, v) / v2, C = (dot(x, x) - r * r) / v2;
  return -B + sqrt(std::max<T>(B * B - C, T(0)));
}

// The answer for a search that found no disc; nothing if it found one.
inline std::optional<Answer> answer_for(Proposed found) {
  switch (found) {
    case Proposed::channel:
      return Answer::never();
    case Proposed::gave_up:
      return Answer::undecided();
    case Proposed::no_octant:
      return Answer::unsupported_because("published has no octant for directions along an axis");
    case Proposed::disc:
      break;
  }
  return std::nullopt;
}

// The coordinate planes xy, xz and yz, in which the 2D algorithm finds discs.
inline constexpr int kPlanes[3][2] = {{0, 1}, {0, 2}, {1, 2}};

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The distance to the disc that is farthest away in its own plane, less a tenth of the radius.
template <class T>
T advance_to_farthest(const Disc<T> (&disc)[3], const Triple<T>& x, const Triple<T>& v, const T& r) {
  T farthest(-kNoLimit);
  for (int plane = 0; plane < 3; ++plane) {
    const auto [i, k] = kPlanes[plane];
    const T distance = length<T>(disc[plane][0] - x[i], disc[plane][1] - x[k]) - r;
    farthest = std::max<T>(farthest, distance / length(v[i], v[k]));
  }
  if (farthest < 0) farthest = T(0.1) * r;
  return farthest - T(0.1) * r;
}

// The largest number of passes, for each search in a plane or for all of them together.
struct Passes {
  long most;
  bool is_total;
};

// The sphere that a 3D search ends with, and the distance to the hit; or the answer if there is no hit.
template <class T>
struct SpaceResult {
  std::optional<Answer> none;
  Triple<T> centre{};
  T distance = 0;
};

// The 3D procedure from x along the unit vector v, up to the distance `limit`. It calls
// `is_hit(centre, x, elapsed)` for each sphere on which the planes agree; this returns the distance from x to
// the hit, or nothing. The planes are not told which sphere is left, as in the authors' program: all spheres in
// its columns have the same projection.
template <class T, class IsHit>
SpaceResult<T> first_sphere(Triple<T> x, const Triple<T>& v, const T& r, Passes passes, const T& limit,
                            const IsHit& is_hit) {
  T elapsed = 0;  // in units of length
  const T farthest = farthest_place<T>();
  const auto advance = [&](const T& distance) {
    for (int i = 0; i < 3; ++i) x[i] += distance * v[i];
    elapsed += distance;
  };
  long passes_left = passes.most;
  for (long round = 0; round < Published::kMaxRounds; ++round) {
    if (elapsed > limit) return {Answer::never()};
    Disc<T> disc[3];
    for (int plane = 0; plane < 3; ++plane) {
      const auto [i, k] = kPlanes[plane];
      if (!(fabs(x[i]) < farthest && fabs(x[k]) < farthest)) return {Answer::undecided()};
      if (!passes.is_total) passes_left = passes.most;
      const PlaneResult<T> result = first_disc<T>({x[i], x[k]}, {v[i], v[k]}, r, nullptr, passes_left);
      if (auto answer = answer_for(result.found)) return {answer};
      disc[plane] = result.disc;
    }
    advance(advance_to_farthest<T>(disc, x, v, r));
    const bool agree = disc[0][0] == disc[1][0] && disc[0][1] == disc[2][0] && disc[1][1] == disc[2][1];
    if (!agree) continue;
    const Triple<T> centre{disc[0][0], disc[0][1], disc[1][1]};
    if (const auto time = is_hit(centre, x, elapsed)) return {std::nullopt, centre, elapsed + *time};
    // The fault behind the late spheres: from next to a sphere that was missed, this step can land inside
    // another one.
    advance(1 - 2 * r);
  }
  return {Answer::undecided()};
}

}  // namespace lorentz::published_search
