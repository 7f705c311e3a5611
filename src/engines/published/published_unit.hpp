// The published algorithm for one ball at the origin of the unit square or cubic lattice, from a start to an
// answer, in any number type (published_search.hpp). Private to this folder and to question/precisions.
#pragma once

#include <algorithm>

#include <lorentz/engine_base.hpp>
#include "src/engines/published/published_search.hpp"

namespace lorentz::published_search {

template <class T>
ObstacleId obstacle_of(const Triple<T>& n) {
  return {0, 0, {NumberType<T>::integer(n[0]), NumberType<T>::integer(n[1]), NumberType<T>::integer(n[2])}};
}

// A ray in the number type. Digits of a binary64 that the type does not hold are rounded away.
template <class T>
struct ColumnLine {
  Triple<T> x, v;

  explicit ColumnLine(const Ray& ray) {
    for (int i = 0; i < 3; ++i) x[i] = static_cast<T>(ray.x[i]), v[i] = static_cast<T>(ray.v[i]);
  }
};

// The collision with the disc or sphere that the search proposed. If the line misses it, its closest
// approach.
template <class T>
Answer hit_on(const Triple<T>& centre, const ColumnLine<T>& line, const T& r) {
  const Triple<T> relative = minus(line.x, centre);
  const T closest = -dot(relative, line.v) / dot(line.v, line.v);
  return Answer::hit(obstacle_of(centre),
                     NumberType<T>::binary64(entry_time(relative, line.v, r).value_or(closest)));
}

template <class T>
Answer published_2d(const ColumnLine<T>& line, const T& r, const Triple<T>* from, Proposals& proposals) {
  const auto& [x, v] = line;
  const Disc<T> leaving = from ? Disc<T>{(*from)[0], (*from)[1]} : Disc<T>{}, direction{v[0], v[1]};
  long passes = Published::kMaxPasses;
  PlaneResult<T> result = first_disc<T>({x[0], x[1]}, direction, r, from ? &leaving : nullptr, passes);
  if (from && result.found == Proposed::disc && result.disc == leaving) {
    // The paper has no `from`, so its search in columns may end at that disc. It goes on where the line
    // leaves the disc.
    const T there = exit_time(minus(x, *from), v, r);
    result = first_disc<T>({x[0] + there * v[0], x[1] + there * v[1]}, direction, r, &leaving, passes);
    if (result.found == Proposed::disc && result.disc == leaving) return Answer::undecided();
  }
  if (auto answer = answer_for(result.found)) return *answer;
  ++proposals.made;
  return hit_on<T>({result.disc[0], result.disc[1], T(0)}, line, r);
}

template <class T>
Answer published_3d(const ColumnLine<T>& line, const T& r, const Triple<T>* from, Proposals& proposals) {
  const T speed = sqrt(dot(line.v, line.v));
  const Triple<T> v{line.v[0] / speed, line.v[1] / speed, line.v[2] / speed};
  const auto is_hit = [&](const Triple<T>& centre, const Triple<T>& x, const T&) {
    ++proposals.made;
    auto time = entry_time(minus(x, centre), v, r);
    if (!time) ++proposals.false_tricylinder;
    if (time && !(*time >= 0 && !(from && *from == centre))) time.reset();
    return time;
  };
  const SpaceResult<T> result =
      first_sphere<T>(line.x, v, r, {Published::kMaxPasses, false}, T(kNoLimit), is_hit);
  if (result.none) return *result.none;
  return Answer::hit(obstacle_of(result.centre), NumberType<T>::binary64(result.distance / speed));
}

template <class T>
bool lies_inside(const Triple<T>& x, const T& r, const Triple<T>* from) {
  const Triple<T> home{round(x[0]), round(x[1]), round(x[2])}, relative = minus(x, home);
  return dot(relative, relative) < r * r && !(from && *from == home);
}

template <class T>
Answer unit_flight(const Ray& ray, int dimension, double radius, Proposals& proposals) {
  for (const double component : ray.x)
    if (!(std::fabs(component) < std::min(kMaxStart, std::ldexp(1.0, NumberType<T>::kDigits - 2))))
      return Answer::unsupported_because(NumberType<T>::kDigits < 53
                                             ? "start too far from the origin for its numbers"
                                             : "start too far from the origin for binary64");
  const ColumnLine<T> line(ray);
  const T r = static_cast<T>(radius);
  Triple<T> from{};
  const Triple<T>* leaving = ray.from && cell_of(*ray.from, from) ? &from : nullptr;
  if (lies_inside(line.x, r, leaving))
    return Answer::inside(obstacle_of<T>({round(line.x[0]), round(line.x[1]), round(line.x[2])}));
  return dimension == 2 ? published_2d(line, r, leaving, proposals)
                        : published_3d(line, r, leaving, proposals);
}

}  // namespace lorentz::published_search
