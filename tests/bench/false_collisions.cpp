// How often the published 3D algorithm predicts a false collision: its three planes agree on a sphere (the
// line meets three cylinders around it), but the line misses the sphere.
//   false_collisions [FLIGHTS]         what the algorithm does, in numbers of flights, too, because one may meet many such
//                                      spheres; and the first sphere of the straight line, as below
//   false_collisions sections [LINES]  of straight lines, the first sphere whose three cylinders they meet
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "question/cases/random.hpp"
#include "question/starts/free_starts.hpp"
#include "src/engines/published/published.hpp"

using namespace lorentz;

namespace {

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Whether a line along v (of length 1), at this offset from a point, meets the three cylinders around it.
bool meets_cylinders(const Vec& v, const Vec& offset, double r) {
  const Vec across = cross(offset, v);
  for (int k = 0; k < 3; ++k)
    if (std::fabs(across[k]) > r * std::sqrt(1 - v[k] * v[k])) return false;
  return true;
}

bool in_a_sphere(const Vec& x, double r) {
  Vec offset;
  for (int k = 0; k < 3; ++k) offset[k] = x[k] - std::round(x[k]);
  return length(offset) < r;
}

// Whether a line misses the sphere around the first point whose three cylinders it meets, of those ahead of x
// by at least a layer of points along the line's main axis, or (`anywhere`) of all that lie ahead.
bool misses_first(const Vec& x, const Vec& v, double r, bool anywhere = true) {
  int main = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(v[k]) > std::fabs(v[main])) main = k;
  const double sign = std::copysign(1.0, v[main]);
  for (double layer = anywhere ? std::floor(x[main] * sign) - 1 : 1;; ++layer) {
    const double t = (layer * sign - x[main]) / v[main];
    double first = HUGE_VAL;
    bool misses = false;
    for (int i = 0; i < 9; ++i) {
      Vec offset;
      for (int k = 0, step = i; k < 3; ++k) {
        if (k == main) {
          offset[k] = x[k] - layer * sign;
        } else {
          offset[k] = x[k] - std::floor(x[k] + t * v[k] + 0.5) - (step % 3 - 1);
          step /= 3;
        }
      }
      const double nearest = -dot(offset, v);
      if (nearest <= 0 || nearest >= first || !meets_cylinders(v, offset, r)) continue;
      first = nearest;
      misses = length(cross(offset, v)) > r;
    }
    if (first < HUGE_VAL) return misses;
  }
}

void fly(std::size_t flights) {
  fmt::print(
      "radius,flights,predicted,false,false_in_flights,most_in_a_flight,lines_that_miss,passed_over\n");
  for (const double r : {0.3, 0.1, 0.03, 0.01}) {
    const Scene scene = unit_scene(3, r);
    const Published published(scene);
    long long made = 0, wrong = 0, with_wrong = 0, most = 0, lines = 0, passed_over = 0;
    for (const Query& query :
         starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed, flights)) {
      Proposals proposals;
      published.first_hit_counted(query, HUGE_VAL, proposals);
      made += proposals.made, wrong += proposals.false_tricylinder;
      with_wrong += proposals.false_tricylinder > 0;
      most = std::max(most, proposals.false_tricylinder);
      const bool misses = misses_first(query.x, query.v, r);
      lines += misses, passed_over += misses && proposals.false_tricylinder == 0;
    }
    fmt::print("{},{},{},{},{},{},{},{}\n", r, flights, made, wrong, with_wrong, most, lines, passed_over);
    std::fflush(stdout);
  }
}

// Lines from anywhere outside the spheres; and lines that leave a sphere's three cylinders, as one of these follows another: uniform
// in the section that the cylinders share, and in directions with the weight of its area.
void follow(std::size_t lines) {
  fmt::print("start,radius,lines,missed\n");
  for (const double r : {0.3, 0.1, 0.03})
    for (const bool anywhere : {true, false}) {
      std::size_t missed = 0;
      for (std::size_t i = 0; i < lines; ++i) {
        cases::Random random(starts::kDefaultSeed, cases::Series("lines"), i);
        Vec x, v;
        do {
          v = random.direction(3);
          if (anywhere) {
            x = {random.uniform(), random.uniform(), random.uniform()};
          } else {
            const Vec side = cross(v, random.direction(3));
            x = scaled(side, 1.5 * r * std::sqrt(random.uniform()) / length(side));
          }
        } while (anywhere ? in_a_sphere(x, r) : !meets_cylinders(v, x, r));
        missed += misses_first(x, v, r, anywhere);
      }
      fmt::print("{},{},{},{}\n", anywhere ? "anywhere" : "a section", r, lines, missed);
    }
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoul(argv[i], nullptr, 10) : otherwise;
  };
  if (argc > 1 && std::strcmp(argv[1], "sections") == 0)
    follow(number(2, 1'000'000));
  else
    fly(number(1, 100'000));
}
