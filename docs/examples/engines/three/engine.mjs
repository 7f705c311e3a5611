// three.js: Ray.intersectSphere, binary64; 2D as the plane z = 0. (Its Raycaster continues with triangles;
// this is the call for a ball.)
//
// Formula: the square of the distance from the line as |w|^2 - (w.d)^2, which cancels far from the sphere,
// and r^2 minus that. A start inside gets the exit, as a comment in it promises. It needs a unit direction and returns a point: the
// adapter normalises by Vector3.normalize, and takes the distance of the point as Raycaster does.
import { Ray, Sphere, Vector3 } from "three";
import { walk } from "../walk.mjs";

const ray = new Ray();
const sphere = new Sphere();
const point = new Vector3();

walk({
  name: "three.js",
  package: "three",
  precision: "binary64",
  dimensions: [2, 3],
  place(c, r) {
    sphere.center.fromArray(c);
    sphere.radius = r;
  },
  startsInside: "exit",
  inside: (p) => sphere.containsPoint(point.fromArray(p)),
  enters(p, d) {
    ray.origin.fromArray(p);
    ray.direction.fromArray(d);
    const length = ray.direction.length();
    ray.direction.normalize();
    if (!ray.intersectSphere(sphere, point)) return undefined;
    return point.distanceTo(ray.origin) / length;
  },
});
