// Box2D 3 (in WebAssembly): b2Shape_RayCast of a circle on a static body, which is the ray cast of one shape.
// Binary32, 2D. Its calls go through Embind, which takes most of their time. The version is the package's.
//
// Formula: nearest point on the line, then half the chord (Haines and others, Ray Tracing Gems, 2019, chapter
// 7), from the circle's centre. It keeps the digits that ../box2d loses far from the circle. A start inside
// hits nothing.
import initialize from "box2d3-wasm";
import { walk } from "../walk.mjs";

const b2 = await initialize();
const body = b2.b2CreateBody(b2.b2CreateWorld(b2.b2DefaultWorldDef()), b2.b2DefaultBodyDef());
const circle = new b2.b2Circle();
circle.center.Set(0, 0);
circle.radius = 1;
const shape = b2.b2CreateCircleShape(body, b2.b2DefaultShapeDef(), circle);
const at = new b2.b2Vec2(0, 0);
const point = new b2.b2Vec2(0, 0);
const input = new b2.b2RayCastInput();
input.maxFraction = 1;

walk({
  name: "Box2D 3",
  package: "box2d3-wasm",
  precision: "binary32",
  dimensions: [2],
  cells: 300,
  place(c, r) {
    at.Set(c[0], c[1]);
    b2.b2Body_SetTransform(body, at, b2.b2Rot_identity);
    if (r === circle.radius) return;
    circle.radius = r;
    b2.b2Shape_SetCircle(shape, circle);
  },
  inside(p) {
    point.Set(p[0], p[1]);
    return b2.b2Shape_TestPoint(shape, point);
  },
  enters(p, d) {
    input.origin.Set(p[0], p[1]);
    input.translation.Set(d[0], d[1]);
    const output = b2.b2Shape_RayCast(shape, input);
    const fraction = output.hit ? output.fraction : undefined;
    output.delete();
    return fraction;
  },
});
