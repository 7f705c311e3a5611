// Rapier in 3D (its shapes are parry's, in WebAssembly): Ball.castRay, solid, which World.castRay calls for
// each ball that the ray may hit. Binary32; 2D as the plane z = 0.
//
// Formula: the discriminant b^2 - ac, which cancels far from the ball. A start inside, also one that rounding
// puts there, is hit at 0, as `solid` asks.
import RAPIER from "@dimforge/rapier3d-compat";
import { walk } from "../walk.mjs";

await RAPIER.init();
const of = (a) => ({ x: a[0], y: a[1], z: a[2] });
const ball = new RAPIER.Ball(1);
const straight = { x: 0, y: 0, z: 0, w: 1 };
let centre;

walk({
  name: "Rapier 3D",
  package: "@dimforge/rapier3d-compat",
  precision: "binary32",
  dimensions: [2, 3],
  cells: 300,
  place(c, r) {
    ball.radius = r;
    centre = of(c);
  },
  startsInside: "zero",
  enters(p, d) {
    const t = ball.castRay(new RAPIER.Ray(of(p), of(d)), centre, straight, 1, true);
    return t >= 0 ? t : undefined;
  },
});
