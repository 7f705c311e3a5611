// A fault of Chipmunk's segment query, Chipmunk alone: one circle, one segment, numbers that are exact.
#include <chipmunk/chipmunk.h>

#include <cstdio>

int main() {
  cpBody* body = cpBodyNewStatic();
  cpShape* circle = cpCircleShapeNew(body, 0x1p-11, cpvzero);
  cpShapeUpdate(circle, cpTransformTranslate(cpv(0x1p17, 0)));
  cpSegmentQueryInfo info;
  const bool hit = cpShapeSegmentQuery(circle, cpv(0, 0x1p-10), cpv(0x1p18, 0x1p-10), 0, &info);
  std::printf(
      "radius 2^-11 at (2^17,0), from (0,2^-10) to (2^18,2^-10), exact: missed by a radius; Chipmunk: hit "
      "%d, "
      "alpha %g\n",
      hit, info.alpha);
}
