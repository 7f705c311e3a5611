#include "published.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "ball.hpp"

namespace lorentz {
namespace {

// A lattice point, kept as binary64 integers as long as it is searched for.
using Disc = std::array<double, 2>;

enum class Found { disc, channel, gave_up, no_octant };

struct PlaneResult {
  Found found = Found::disc;
  Disc disc{};
};

double length(double a, double b) {
  return std::sqrt(a * a + b * b);
}

double distance_to_integers(double b) {
  return std::min(b, 1 - b);
}

// The first convergent denominator q of m with |q m - p| <= tolerance, the expansion computed from its start.
double first_denominator(double m, double tolerance) {
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

Columns columns_ahead(double m, double b, double eps) {
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
  for (long pass = 0; b > eps && 1 - b > eps; ++pass) {
    if (pass == Published::kMaxPasses || k > 0x1p52) return {Found::gave_up};
    step();
    if (b == first) return {Found::channel};
  }
  return {Found::disc, k};
}

// First octant, 0 < v2 <= v1, v of unit length.
PlaneResult first_octant(double x1, double x2, double v1, double v2, double r, const Disc* from) {
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
  const Columns columns = columns_ahead(m, b1 - std::floor(b1), eps);
  return {columns.found, {n1 + 1 + columns.k, n2 + std::round(b1 + m * columns.k)}};
}

// Any direction, by reflections and the exchange of the axes, undone at the end.
PlaneResult first_disc(Disc x, Disc v, double r, const Disc* from) {
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
                                    from ? &reflected_from : nullptr);
  Disc disc;
  disc[long_axis] = sign[long_axis] * result.disc[0];
  disc[short_axis] = sign[short_axis] * result.disc[1];
  result.disc = disc;
  return result;
}

std::optional<Answer> answer_for(Found found) {
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

Vec minus(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

ObstacleId obstacle_of(const Vec& n) {
  return {0, 0, {Integer(std::llround(n[0])), Integer(std::llround(n[1])), Integer(std::llround(n[2]))}};
}

// The collision with a disc or sphere that the search came up with; its closest approach if the line misses
// it.
Answer hit_on(const Vec& centre, const Ray& ray, double r) {
  const Vec relative = minus(ray.x, centre);
  const double closest = -dot(relative, ray.v) / dot(ray.v, ray.v);
  return Answer::hit(obstacle_of(centre), entry_time(relative, ray.v, r).value_or(closest));
}

Answer published_2d(const Ray& ray, double r, const Vec* from) {
  const Disc leaving = from ? Disc{(*from)[0], (*from)[1]} : Disc{};
  const PlaneResult result =
      first_disc({ray.x[0], ray.x[1]}, {ray.v[0], ray.v[1]}, r, from ? &leaving : nullptr);
  if (auto answer = answer_for(result.found)) return *answer;
  return hit_on({result.disc[0], result.disc[1], 0}, ray, r);
}

// The discs that the 2D algorithm finds in the coordinate planes xy, xz and yz.
constexpr int kPlanes[3][2] = {{0, 1}, {0, 2}, {1, 2}};

// How far to go for the disc that is farthest off in its own plane; short of it by a tenth of the radius.
double advance_to_farthest(const Disc (&disc)[3], const Vec& x, const Vec& v, double r) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (int plane = 0; plane < 3; ++plane) {
    const auto [i, k] = kPlanes[plane];
    const double distance = length(disc[plane][0] - x[i], disc[plane][1] - x[k]) - r;
    farthest = std::max(farthest, distance / length(v[i], v[k]));
  }
  if (farthest < 0) farthest = 0.1 * r;
  return farthest - 0.1 * r;
}

Answer published_3d(const Ray& ray, double r, const Vec* from) {
  const double speed = std::sqrt(dot(ray.v, ray.v));
  const Vec v{ray.v[0] / speed, ray.v[1] / speed, ray.v[2] / speed};
  Vec x = ray.x;
  double elapsed = 0;  // in units of length
  const auto advance = [&](double distance) {
    for (int i = 0; i < 3; ++i) x[i] += distance * v[i];
    elapsed += distance;
  };
  for (long round = 0; round < Published::kMaxRounds; ++round) {
    Disc disc[3];
    for (int plane = 0; plane < 3; ++plane) {
      const auto [i, k] = kPlanes[plane];
      if (!(std::fabs(x[i]) < kMaxStart && std::fabs(x[k]) < kMaxStart)) return Answer::undecided();
      const Disc leaving = from ? Disc{(*from)[i], (*from)[k]} : Disc{};
      const PlaneResult result =
          first_disc({x[i], x[k]}, {v[i], v[k]}, r, from && round == 0 ? &leaving : nullptr);
      if (auto answer = answer_for(result.found)) return *answer;
      disc[plane] = result.disc;
    }
    advance(advance_to_farthest(disc, x, v, r));
    const bool agree = disc[0][0] == disc[1][0] && disc[0][1] == disc[2][0] && disc[1][1] == disc[2][1];
    if (!agree) continue;
    const Vec centre{disc[0][0], disc[0][1], disc[1][1]};
    const auto time = entry_time(minus(x, centre), v, r);
    if (time && *time >= 0 && !(from && *from == centre))
      return Answer::hit(obstacle_of(centre), (elapsed + *time) / speed);
    // The fault behind the late spheres: from next to a sphere that was missed this can land inside another
    // one.
    advance(1 - 2 * r);
  }
  return Answer::undecided();
}

bool lies_inside(const Vec& x, double r, const Vec* from) {
  const Vec home{std::round(x[0]), std::round(x[1]), std::round(x[2])};
  const Vec relative = minus(x, home);
  return dot(relative, relative) < r * r && !(from && *from == home);
}

}  // namespace

Answer Published::flight_of(const Ray& ray, double) const {
  for (const double component : ray.x)
    if (!(std::fabs(component) < kMaxStart))
      return Answer::unsupported_because("start too far from the origin for binary64");
  const double r = scene().lattices[0].atoms[0].radius;
  Vec from{};
  bool has_from = ray.from != nullptr;
  for (int i = 0; has_from && i < 3; ++i) {
    has_from = ray.from->cell[i].fits_int64();  // a disc farther off than that is never met
    if (has_from) from[i] = static_cast<double>(ray.from->cell[i].int64());
  }
  const Vec* leaving = has_from ? &from : nullptr;
  if (lies_inside(ray.x, r, leaving))
    return Answer::inside(obstacle_of({std::round(ray.x[0]), std::round(ray.x[1]), std::round(ray.x[2])}));
  return scene().dimension == 2 ? published_2d(ray, r, leaving) : published_3d(ray, r, leaving);
}

}  // namespace lorentz
