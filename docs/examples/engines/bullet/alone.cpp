// Two faults of Bullet's ray test, Bullet alone: one sphere, one ray, numbers that binary32 has exactly. The
// cast ends when the point is within 0.01 of the sphere (the square is below MAX_CONVEX_CAST_EPSILON),
// whatever the radius.
#include <btBulletCollisionCommon.h>

#include <cstdio>

static void cast(const char* what, btVector3 from, btVector3 to, btVector3 centre, btScalar radius) {
  btSphereShape shape(radius);
  btCollisionObject object;
  object.setCollisionShape(&shape);
  const auto at = [](const btVector3& p) { return btTransform(btMatrix3x3::getIdentity(), p); };
  object.setWorldTransform(at(centre));
  btCollisionWorld::ClosestRayResultCallback result(from, to);
  btCollisionWorld::rayTestSingle(at(from), at(to), &object, &shape, at(centre), result);
  std::printf("%s; Bullet: hit %d, fraction %.7g\n", what, result.hasHit(),
              double(result.m_closestHitFraction));
}

int main() {
  cast("radius 1/128 at (0,0,0), from (0,1/64,0) to (1,1/64,0), exact: missed by a radius", {0, 1 / 64.f, 0},
       {1, 1 / 64.f, 0}, {0, 0, 0}, 1 / 128.f);
  cast("radius 1/2 at (1,0,0), from (1/2,1/4,0) to (1,1/4,0), exact: hit 1, fraction 0.1339746",
       {0.5f, 0.25f, 0}, {1, 0.25f, 0}, {1, 0, 0}, 0.5f);
}
