// A fault of Embree's sphere points, Embree alone: a ray that starts on the surface and goes away (from 3/4 along -x,
// the ball around 1) hits the ball at 0: `tnear` <= 0 is inclusive, and the sphere's far side counts. Numbers are exact.
#include <embree3/rtcore.h>

#include <cmath>
#include <cstdio>

int main() {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  RTCGeometry points = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* to = static_cast<float*>(
      rtcSetNewGeometryBuffer(points, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  to[0] = 1, to[1] = 0, to[2] = 0, to[3] = 0.25f;
  rtcCommitGeometry(points), rtcAttachGeometry(scene, points), rtcCommitScene(scene);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.org_x = 0.75f, ray.ray.dir_x = -1, ray.ray.tfar = INFINITY, ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &ray);
  std::printf("radius 1/4 at (1,0,0), from (3/4,0,0) along -x, exact: never; Embree: hit %d at %g\n",
              ray.hit.geomID != RTC_INVALID_GEOMETRY_ID, double(ray.ray.tfar));
}
