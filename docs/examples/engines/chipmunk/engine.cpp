// Chipmunk: cpShapeSegmentQuery of a cpCircleShape, which cpSpaceSegmentQueryFirst calls for each shape that
// the segment may hit. Binary64, 2D.
//
// Formula: the discriminant of the textbook's quadratic, from the vectors from the centre to both ends of the
// segment: |a|^2 - 2 a.b + |b|^2 and a.b - |a|^2 cancel far from the circle.
#include <chipmunk/chipmunk.h>
#include <chipmunk/chipmunk_unsafe.h>

#include "../walk.hpp"

struct Chipmunk {
  Chipmunk() : body_(cpBodyNewStatic()), circle_(cpCircleShapeNew(body_, 1, cpvzero)) {}
  ~Chipmunk() { cpShapeFree(circle_), cpBodyFree(body_); }
  Chipmunk(const Chipmunk&) = delete;

  void place(const Vec& c, double r) {
    cpCircleShapeSetRadius(circle_, r);
    cpShapeUpdate(circle_, cpTransformTranslate(cpv(c[0], c[1])));
  }

  bool inside(const Vec& p) const {
    cpPointQueryInfo info;
    return cpShapePointQuery(circle_, cpv(p[0], p[1]), &info) < 0;
  }

  std::optional<double> enters(const Vec& p, const Vec& d) {
    cpSegmentQueryInfo info;
    if (!cpShapeSegmentQuery(circle_, cpv(p[0], p[1]), cpv(p[0] + d[0], p[1] + d[1]), 0, &info)) return {};
    return info.alpha;
  }

 private:
  cpBody* body_;
  cpShape* circle_;
};

int main(int argc, char** argv) {
  Chipmunk library;
  const char* precision = sizeof(cpFloat) == 8 ? "binary64" : "binary32";
  return walk(library, {"Chipmunk", cpVersionString, precision, {2}}, argc, argv);
}
