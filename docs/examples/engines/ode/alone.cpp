// A fault of ODE's ray, ODE alone: one sphere, one ray, numbers that are exact. B^2 - C is 0 instead of
// negative.
#include <ode/ode.h>

#include <cstdio>

int main() {
  dInitODE();
  dGeomID sphere = dCreateSphere(nullptr, 0x1p-11), ray = dCreateRay(nullptr, 0x1p18);
  dGeomSetPosition(sphere, 0x1p17, 0, 0);
  dGeomRaySet(ray, 0, 0x1p-10, 0, 1, 0, 0);
  dContactGeom contact{};
  const int hit = dCollide(ray, sphere, 1, &contact, sizeof contact);
  std::printf(
      "radius 2^-11 at (2^17,0,0), from (0,2^-10,0) along x, exact: missed by a radius; ODE: hit %d at %g\n",
      hit, double(contact.depth));
}
