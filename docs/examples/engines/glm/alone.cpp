// Two faults of glm::intersectRaySphere, GLM alone: one sphere, one ray, numbers that are exact. |w|^2 -
// (w.d)^2 loses the distance from the line; and an entry nearer than epsilon is taken for the exit.
#define GLM_ENABLE_EXPERIMENTAL
#include <cstdio>
#include <glm/glm.hpp>
#include <glm/gtx/intersect.hpp>

template <class V>
void cast(const char* what, V start, V direction, V centre, typename V::value_type radius) {
  typename V::value_type t = 0;
  const bool hit = glm::intersectRaySphere(start, direction, centre, radius * radius, t);
  std::printf("%s; GLM: hit %d at %g\n", what, hit, double(t));
}

int main() {
  cast<glm::vec3>("float: radius 1/16 at (512,0,0), from (0,1/8,0) along x, exact: missed by a radius",
                  {0, 0.125f, 0}, {1, 0, 0}, {512, 0, 0}, 0.0625f);
  cast<glm::dvec3>("double: radius 2^-11 at (2^17,0,0), from (0,2^-10,0) along x, exact: missed by a radius",
                   {0, 0x1p-10, 0}, {1, 0, 0}, {0x1p17, 0, 0}, 0x1p-11);
  cast<glm::dvec3>("double: radius 1/2 at (0,1,0), from (0,1/2,0) along y, exact: hit at 0", {0, 0.5, 0},
                   {0, 1, 0}, {0, 1, 0}, 0.5);
}
