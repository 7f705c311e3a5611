// A fault of mju_rayGeom, MuJoCo alone: one sphere, one ray straight at its centre, numbers that are exact.
// The discriminant has the units of (length of the vector x radius)^2, but is held against mjMINVAL = 1e-15.
import initialize from "mujoco-js";

const mujoco = await initialize();
const straight = [1, 0, 0, 0, 1, 0, 0, 0, 1];
const cast = (radius, vec) =>
  mujoco.mju_rayGeom(
    [1, 0, 0],
    straight,
    [radius, 0, 0],
    [0, 0, 0],
    [vec, 0, 0],
    mujoco.mjtGeom.mjGEOM_SPHERE.value,
  );
console.log(
  "radius 1/2 at (1,0,0), from (0,0,0) along (2^-23,0,0), exact: hit at 2^22 = 4194304; MuJoCo:",
  cast(1 / 2, 2 ** -23),
);
console.log(
  "                                    along (2^-24,0,0), exact: hit at 2^23 = 8388608; MuJoCo:",
  cast(1 / 2, 2 ** -24),
);
console.log("radius 2^-26, along (1,0,0), exact: hit at 1 - 2^-26; MuJoCo:", cast(2 ** -26, 1));
