// Bullet: btCollisionWorld::rayTestSingle on a btSphereShape, which btCollisionWorld::rayTest calls for each
// body that the ray may hit. In binary32; as `engine64`, with BT_USE_DOUBLE_PRECISION, in binary64.
//
// Formula: none for spheres. The ray is cast as a point by btSubsimplexConvexCast, which advances until the
// square of the distance is below MAX_CONVEX_CAST_EPSILON (1e-4; in binary64 10 ulps of 1). With the argument
// `gjk` (btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest), btGjkConvexCast casts it until the distance
// is below 0.001 (in both precisions).
#include <btBulletCollisionCommon.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "../walk.hpp"

struct Bullet {
  explicit Bullet(unsigned flags) : flags_(flags) { object_.setCollisionShape(&shape_); }

  static btVector3 of(const Vec& a) { return btVector3(btScalar(a[0]), btScalar(a[1]), btScalar(a[2])); }
  static btTransform at(const btVector3& a) { return btTransform(btMatrix3x3::getIdentity(), a); }

  void place(const Vec& c, double r) {
    shape_.setUnscaledRadius(btScalar(r));
    object_.setWorldTransform(at(of(c)));
  }

  bool inside(const Vec& p) const {  // Bullet has only a search for contacts for this test
    const btScalar r = shape_.getRadius();
    return of(p).distance2(object_.getWorldTransform().getOrigin()) < r * r;
  }

  std::optional<double> enters(const Vec& p, const Vec& d) {
    const btVector3 from = of(p), to = of(add(p, d));
    btCollisionWorld::ClosestRayResultCallback result(from, to);
    result.m_flags = flags_;
    btCollisionWorld::rayTestSingle(at(from), at(to), &object_, &shape_, object_.getWorldTransform(), result);
    if (!result.hasHit()) return {};
    return result.m_closestHitFraction;
  }

 private:
  btSphereShape shape_{1};
  btCollisionObject object_;
  unsigned flags_;
};

int main(int argc, char** argv) {
  const bool gjk = has_argument(argc, argv, "gjk");
  Bullet library(gjk ? btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest
                     : btTriangleRaycastCallback::kF_None);
  const int version = btGetVersion();
  const std::string text = std::to_string(version / 100) + '.' + std::to_string(version % 100);
  const char* precision = sizeof(btScalar) == 8 ? "binary64" : "binary32";
  return walk(library, {gjk ? "Bullet (GJK)" : "Bullet", text, precision, {2, 3}}, argc, argv);
}
