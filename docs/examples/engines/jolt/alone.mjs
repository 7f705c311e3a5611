// A fault of the ray cast against a SphereShape, Jolt alone: one sphere, one ray, numbers that binary32 has
// exactly. The discriminant is 0 instead of negative.
import initialize from "jolt-physics";

const Jolt = await initialize();
const placed = new Jolt.TransformedShape();
placed.mShape = new Jolt.SphereShape(1 / 16);
placed.SetWorldTransform(new Jolt.RVec3(512, 0, 0), Jolt.Quat.prototype.sIdentity(), new Jolt.Vec3(1, 1, 1));
const hit = new Jolt.RayCastResult();
placed.CastRay(new Jolt.RRayCast(new Jolt.RVec3(0, 1 / 8, 0), new Jolt.Vec3(1024, 0, 0)), hit);
console.log(
  "radius 1/16 at (512,0,0), from (0,1/8,0) to (1024,1/8,0), exact: missed by a radius; Jolt: hit",
  hit.mFraction <= 1,
  "fraction",
  hit.mFraction,
);
