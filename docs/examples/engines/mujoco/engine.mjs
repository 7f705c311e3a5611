// MuJoCo (in WebAssembly): mju_rayGeom with a sphere, which mj_ray calls for each geom. Binary64; 2D as the
// plane z = 0. The version is the one that the library reports.
//
// Formula: the discriminant b^2 - ac, which cancels far from the sphere. A discriminant below mjMINVAL =
// 1e-15, whatever the units, is a miss. A start inside gets the exit, as the manual says.
import initialize from "mujoco-js";
import { walk } from "../walk.mjs";

const mujoco = await initialize();
const sphere = mujoco.mjtGeom.mjGEOM_SPHERE.value;
const straight = [1, 0, 0, 0, 1, 0, 0, 0, 1];
let centre, size;

walk({
  name: "MuJoCo",
  version: mujoco.mj_versionString(),
  precision: "binary64",
  dimensions: [2, 3],
  cells: 300,
  place(c, r) {
    centre = c;
    size = [r, 0, 0];
  },
  startsInside: "exit",
  // MuJoCo has no such test.
  inside: (p) => Math.hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]) < size[0],
  enters(p, d) {
    const f = mujoco.mju_rayGeom(centre, straight, size, p, d, sphere);
    return f >= 0 ? f : undefined;
  },
});
