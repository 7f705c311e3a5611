// A fault of b2CircleShape::RayCast, Box2D alone: one circle, one ray, numbers that binary32 has exactly. The
// discriminant is 0 instead of negative.
#include <box2d/box2d.h>

#include <cstdio>

int main() {
  b2CircleShape circle;
  circle.m_radius = 1 / 16.f;
  b2Transform at;
  at.Set(b2Vec2(512, 0), 0);
  b2RayCastInput input{b2Vec2(0, 1 / 8.f), b2Vec2(1024, 1 / 8.f), 1};
  b2RayCastOutput output{};
  const bool hit = circle.RayCast(&output, input, at, 0);
  std::printf(
      "radius 1/16 at (512,0), from (0,1/8) to (1024,1/8), exact: missed by a radius; Box2D: hit %d, "
      "fraction %g\n",
      hit, double(output.fraction));
}
