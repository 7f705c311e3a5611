// Box2D 2: b2CircleShape::RayCast, which b2World::RayCast calls for each circle that the ray may hit.
// Binary32, 2D. (Version 3 has another formula: ../box2d3.)
//
// Formula: the discriminant (s.r)^2 - |r|^2 (|s|^2 - radius^2), which cancels far from the circle. A segment
// whose squared length is below the epsilon of float hits nothing. A start inside hits nothing,
// as its header promises.
#include <box2d/box2d.h>

#include "../walk.hpp"

struct Box2d {
  static b2Vec2 of(const Vec& a) { return b2Vec2(static_cast<float>(a[0]), static_cast<float>(a[1])); }

  void place(const Vec& c, double r) {
    circle_.m_radius = static_cast<float>(r);
    at_.Set(of(c), 0);
  }

  std::optional<double> enters(const Vec& p, const Vec& d) const {
    b2RayCastInput input;
    input.p1 = of(p), input.p2 = of(add(p, d)), input.maxFraction = 1;
    b2RayCastOutput output;
    if (!circle_.RayCast(&output, input, at_, 0)) return {};
    return output.fraction;
  }

 private:
  b2CircleShape circle_;
  b2Transform at_;
};

int main(int argc, char** argv) {
  Box2d library;
  const std::string version = std::to_string(b2_version.major) + '.' + std::to_string(b2_version.minor) +
                              '.' + std::to_string(b2_version.revision);
  return walk(library, {"Box2D", version, "binary32", {2}, "miss"}, argc, argv);
}
