// cannon-es: Ray.intersectBody with a body that is a Sphere, which World.raycastClosest calls for each body
// that the ray may hit. Binary64; 2D as the plane z = 0.
//
// Formula: the textbook's quadratic, b^2 - 4ac, with the segment from end to end. It cancels far from the
// sphere. If the discriminant is 0, the hit is placed at the segment's start. A start inside gets the exit.
import { Body, Ray, RaycastResult, Sphere, Vec3 } from "cannon-es";
import { walk } from "../walk.mjs";

const shape = new Sphere(1);
const body = new Body({ mass: 0, shape });
const ray = new Ray();
ray.mode = Ray.CLOSEST;

walk({
  name: "cannon-es",
  package: "cannon-es",
  precision: "binary64",
  dimensions: [2, 3],
  place(c, r) {
    shape.radius = r;
    shape.updateBoundingSphereRadius();
    body.updateBoundingRadius();
    body.position.set(...c);
  },
  inside: (p) => new Vec3(...p).distanceTo(body.position) < shape.radius, // it has no such test
  enters(p, d) {
    const result = new RaycastResult();
    ray.from.set(...p);
    ray.to.set(p[0] + d[0], p[1] + d[1], p[2] + d[2]);
    ray.updateDirection();
    ray.intersectBody(body, result);
    return result.hasHit ? result.distance / Math.hypot(...d) : undefined;
  },
});
