// GLM: glm::intersectRaySphere (glm/gtx/intersect.hpp), its only function for a ray and a sphere. In binary64
// with glm::dvec3; with the argument `float`, in binary32 with glm::vec3.
//
// Formula: the square of the distance from the line as |w|^2 - (w.d)^2, which cancels far from the sphere,
// and r^2 minus that. Entries nearer than epsilon are taken for exits. The direction must be normalised: the
// adapter does so, and divides the distance by the length.
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/glm.hpp>
#include <glm/gtx/intersect.hpp>

#include "../walk.hpp"

template <class Real>
struct Glm {
  using V = glm::vec<3, Real>;
  V centre;
  Real r;

  static V of(const Vec& a) { return V(a[0], a[1], a[2]); }

  void place(const Vec& c, double radius) { centre = of(c), r = static_cast<Real>(radius); }

  bool inside(const Vec& p) const {  // GLM has no such test
    const V w = centre - of(p);
    return glm::dot(w, w) < r * r;
  }

  std::optional<double> enters(const Vec& p, const Vec& d) const {
    const V direction = of(d);
    Real distance;
    if (!glm::intersectRaySphere(of(p), glm::normalize(direction), centre, r * r, distance)) return {};
    return distance / glm::length(direction);
  }
};

template <class Real>
int run(const char* precision, int argc, char** argv) {
  const std::string version = std::to_string(GLM_VERSION_MAJOR) + '.' + std::to_string(GLM_VERSION_MINOR) +
                              '.' + std::to_string(GLM_VERSION_PATCH) + '.' +
                              std::to_string(GLM_VERSION_REVISION);
  Glm<Real> library;
  return walk(library, {"GLM", version, precision, {2, 3}}, argc, argv);
}

int main(int argc, char** argv) {
  return has_argument(argc, argv, "float") ? run<float>("binary32", argc, argv)
                                           : run<double>("binary64", argc, argv);
}
