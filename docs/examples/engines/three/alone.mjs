// Two faults of Ray.intersectSphere, three.js alone: one sphere, one ray, numbers that are exact.
import { Ray, Sphere, Vector3 } from "three";

// |w|^2 - (w.d)^2 loses the distance from the line.
const along = new Ray(new Vector3(0, 2 ** -10, 0), new Vector3(1, 0, 0));
const small = new Sphere(new Vector3(2 ** 17, 0, 0), 2 ** -11);
console.log(
  "radius 2^-11 at (2^17,0,0), from (0,2^-10,0) along x, exact: missed by a radius (null); three.js:",
  along.intersectSphere(small, new Vector3()),
);

// On the surface (3-4-5), going in: rounding makes the entry negative, and the exit is given.
const start = new Ray(new Vector3(11 / 8, 1 / 2, 0), new Vector3(-4, 1, 0).normalize());
const point = start.intersectSphere(new Sphere(new Vector3(1, 0, 0), 5 / 8), new Vector3());
console.log(
  "radius 5/8 at (1,0,0), from (11/8,1/2,0) along (-4,1,0), exact: entered at distance 0; three.js: at",
  point.distanceTo(start.origin),
);
