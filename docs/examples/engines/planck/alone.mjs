// A fault of CircleShape.rayCast, planck alone: one circle, one ray, numbers that are exact. The discriminant
// is 0 instead of negative.
import { CircleShape, Transform, Vec2 } from "planck";

const circle = new CircleShape(2 ** -11);
const output = {};
const input = { p1: new Vec2(0, 2 ** -10), p2: new Vec2(2 ** 18, 2 ** -10), maxFraction: 1 };
const hit = circle.rayCast(output, input, new Transform(new Vec2(2 ** 17, 0), 0), 0);
console.log(
  "radius 2^-11 at (2^17,0), from (0,2^-10) to (2^18,2^-10), exact: missed by a radius; planck: hit",
  hit,
  "fraction",
  output.fraction,
);
