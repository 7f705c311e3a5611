// planck: Box2D 2 in JavaScript. CircleShape.rayCast, which World.rayCast calls for each circle that the ray
// may hit. Binary64, 2D.
//
// Formula: the discriminant (s.r)^2 - |r|^2 (|s|^2 - radius^2), which cancels far from the circle. A segment
// whose squared length is below the epsilon of binary64 hits nothing. A start inside hits nothing, as in Box2D.
import { CircleShape, Transform, Vec2 } from "planck";
import { walk } from "../walk.mjs";

const circle = new CircleShape(1);
const at = new Transform(new Vec2(0, 0), 0);

walk({
  name: "planck",
  package: "planck",
  precision: "binary64",
  dimensions: [2],
  place(c, r) {
    circle.m_radius = r;
    at.p.set(c[0], c[1]);
  },
  startsInside: "miss",
  enters(p, d) {
    const output = {};
    const input = { p1: new Vec2(p[0], p[1]), p2: new Vec2(p[0] + d[0], p[1] + d[1]), maxFraction: 1 };
    return circle.rayCast(output, input, at, 0) ? output.fraction : undefined;
  },
});
