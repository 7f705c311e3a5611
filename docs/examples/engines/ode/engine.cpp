// ODE: dCollide of a ray geom with a sphere geom, which is how ODE casts rays. Binary64, if ODE was built for
// it (as Debian's is).
//
// Formula: B^2 - C with the unit direction and C = |q|^2 - r^2, which cancels far from the sphere. A start
// inside gets the exit. `dGeomRaySet` normalises the direction; the adapter divides the depth by the length.
#include <ode/ode.h>
#include <ode/version.h>

#include "../walk.hpp"

struct Ode {
  Ode() { dInitODE(), ray_ = dCreateRay(nullptr, 1), sphere_ = dCreateSphere(nullptr, 1); }
  ~Ode() { dGeomDestroy(ray_), dGeomDestroy(sphere_), dCloseODE(); }
  Ode(const Ode&) = delete;

  void place(const Vec& c, double r) {
    dGeomSetPosition(sphere_, dReal(c[0]), dReal(c[1]), dReal(c[2]));
    dGeomSphereSetRadius(sphere_, dReal(r));
  }

  bool inside(const Vec& p) const {
    return dGeomSpherePointDepth(sphere_, dReal(p[0]), dReal(p[1]), dReal(p[2])) > 0;
  }

  std::optional<double> enters(const Vec& p, const Vec& d) {
    const dReal length = dReal(std::sqrt(dot(d, d)));
    dGeomRaySetLength(ray_, length);
    dGeomRaySet(ray_, dReal(p[0]), dReal(p[1]), dReal(p[2]), dReal(d[0]), dReal(d[1]), dReal(d[2]));
    dContactGeom contact;
    if (!dCollide(ray_, sphere_, 1, &contact, sizeof contact)) return {};
    return contact.depth / length;
  }

 private:
  dGeomID ray_, sphere_;
};

int main(int argc, char** argv) {
  Ode library;
  const char* precision = sizeof(dReal) == 8 ? "binary64" : "binary32";
  return walk(library, {"ODE", dODE_VERSION, precision, {2, 3}}, argc, argv);
}
