// A fault of Ray.intersectBody, cannon-es alone: a ray that touches a sphere (the discriminant is 0) hits it
// at the ray's own start, before everything else. All numbers are exact.
import { Body, Ray, RaycastResult, Sphere, Vec3 } from "cannon-es";

const body = new Body({ mass: 0, shape: new Sphere(1) });
body.position.set(5, 1, 0);
const ray = new Ray(new Vec3(0, 0, 0), new Vec3(10, 0, 0));
const result = new RaycastResult();
ray.mode = Ray.CLOSEST;
ray.updateDirection();
ray.intersectBody(body, result);
console.log(
  "radius 1 at (5,1,0), from (0,0,0) to (10,0,0), exact: touches at distance 5; cannon-es: hit",
  result.hasHit,
  "at distance",
  result.distance,
);
