// Jolt Physics (in WebAssembly): TransformedShape.CastRay of a SphereShape, which NarrowPhaseQuery.CastRay
// calls for each body that the ray may hit. Binary32; 2D as the plane z = 0.
//
// Formula: the quadratic by q = -(b + sign(b) sqrt(b^2 - 4ac)) / 2 (Numerical Recipes), in the coordinates of
// the shape. The roots do not cancel, but the discriminant does, far from the sphere. A start inside is hit
// at 0: convex shapes are solid unless told otherwise (RayCastSettings::mTreatConvexAsSolid).
import initialize from "jolt-physics";
import { walk } from "../walk.mjs";

const Jolt = await initialize();
const shapes = new Map(); // one per radius, because a shape cannot be changed
const placed = new Jolt.TransformedShape();
const at = new Jolt.RVec3(0, 0, 0);
const straight = Jolt.Quat.prototype.sIdentity();
const scale = new Jolt.Vec3(1, 1, 1);
const point = new Jolt.RVec3(0, 0, 0);
const direction = new Jolt.Vec3(0, 0, 0);
const ray = new Jolt.RRayCast();
const hit = new Jolt.RayCastResult();

function shapeOf(r) {
  if (!shapes.has(r)) {
    const shape = new Jolt.SphereShape(r);
    shape.AddRef();
    shapes.set(r, shape);
  }
  return shapes.get(r);
}

walk({
  name: "Jolt",
  package: "jolt-physics",
  precision: "binary32",
  dimensions: [2, 3],
  cells: 300,
  place(c, r) {
    placed.mShape = shapeOf(r);
    at.Set(...c);
    placed.SetWorldTransform(at, straight, scale);
  },
  startsInside: "zero",
  enters(p, d) {
    point.Set(...p);
    direction.Set(...d);
    ray.mOrigin = point;
    ray.mDirection = direction;
    hit.Reset();
    placed.CastRay(ray, hit);
    return hit.mFraction <= 1 ? hit.mFraction : undefined;
  },
});
