// A fault of Ball.castRay, Rapier alone: one ball, one ray, numbers that binary32 has exactly. The
// discriminant is 0 instead of negative.
import RAPIER from "@dimforge/rapier2d-compat";

await RAPIER.init();
const ray = new RAPIER.Ray({ x: 0, y: 1 / 8 }, { x: 1, y: 0 });
const t = new RAPIER.Ball(1 / 16).castRay(ray, { x: 512, y: 0 }, 0, 1000, true);
console.log(
  "radius 1/16 at (512,0), from (0,1/8) along x, exact: missed by a radius (-1); Rapier 2D: hit at",
  t,
);
