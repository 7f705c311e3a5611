// The parts that the adapters in JavaScript share. Reads the query stream of docs/formats.md and walks from
// cell to cell along the ray. The walk asks the library about every ball that reaches into the cell: whether
// and when the segment in the cell enters it. The library decides about a ball; the walk (in binary64)
// decides which balls there are. A library is
//   { name, precision,            its claims
//     version, or package,        the version from the library itself, or from its package.json
//     dimensions,                 [2], or [2, 3]
//     cells,                      the most cells of the walk, if calls are too slow for the usual number
//     place(c, r),                the ball
//     inside(p),                  whether p lies in it; absent if the ray cast's own rule counts
//     startsInside,               that rule, if the library promises one: "miss", "zero" or "exit"
//     enters(p, d) }              at which fraction f of d does p + f d enter it? undefined: it does not
// In world coordinates p is the start of the flight, and d ends where the flight leaves the cell. With the
// argument `cells`, p is the point where the flight enters the cell, and all coordinates are relative to the
// cell, as with periodic boundaries. Numbers then stay small, as a library in binary32 needs.
import fs from "node:fs";
import readline from "node:readline";

const MOST_CELLS = 2000; // beyond this number: undecided
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const isSame = (a, b) => a.every((c, i) => c === b[i]);
const isBefore = (a, b) => {
  const k = a.findIndex((c, i) => c !== b[i]);
  return k >= 0 && a[k] < b[k];
};

const HEXADECIMAL = /^(-?)0x([\da-f]+)(?:\.([\da-f]*))?(?:p([-+]?\d+))?$/i;
function number(c) {
  const [all, minus, whole, fraction = "", exponent = "0"] =
    (typeof c === "string" && c.match(HEXADECIMAL)) || [];
  if (all === undefined) return c;
  const value = parseInt(whole + fraction, 16) * 2 ** (Number(exponent) - 4 * fraction.length);
  return minus ? -value : value;
}
const integer = (c) => (typeof c === "string" && /^-?\d+$/.test(c) ? Number(c) : c); // a string beyond 2^53

function vector(a, size, component = number, isOne = Number.isFinite) {
  if (!Array.isArray(a) || a.length !== size)
    throw Error(`expected ${size} components: ${JSON.stringify(a)}`);
  const v = a.map(component);
  if (!v.every(isOne)) throw Error(`not a vector of numbers: ${JSON.stringify(a)}`);
  return [...v, ...Array(3 - size).fill(0)];
}

/** A scene that no adapter supports. The scene itself is valid. */
class Unsupported extends Error {}

/** A crystal of balls, or single balls: as many vectors as the scene has dimensions, or none. */
class Lattice {
  constructor({ vectors, atoms }, dimension) {
    this.rank = vectors.length;
    if (this.rank !== 0 && this.rank !== dimension) throw new Unsupported("rows and layers are not done");
    this.u = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
    for (let k = 0; k < this.rank; ++k) this.u[k] = vector(vectors[k], dimension);
    const volume = dot(this.u[0], cross(this.u[1], this.u[2]));
    if (volume === 0) throw Error("the primitive vectors are dependent");
    this.dual = [0, 1, 2].map((k) => cross(this.u[(k + 1) % 3], this.u[(k + 2) % 3]).map((c) => c / volume));
    this.atoms = atoms.length;
    if (!(this.atoms > 0)) throw Error("a lattice without atoms");
    this.near = []; // the balls that reach into the cell 0, and their own cells
    atoms.forEach((atom, index) => this.addAtom(atom, index, dimension));
  }

  addAtom({ position, radius, semiaxes }, atom, dimension) {
    if (semiaxes) throw new Unsupported("ellipsoids are not done, only balls");
    const p = vector(position, dimension);
    const r = number(radius);
    if (!(r > 0 && r < Infinity)) throw Error("a radius must be positive");
    const spans = this.dual.map((w, k) => {
      // Slightly wider than the ball, because the walk rounds.
      const c = -dot(w, p),
        e = r * Math.hypot(...w) + 1e-9;
      return k < this.rank ? [Math.ceil(c - e), Math.floor(c + 1 + e)] : [0, 0];
    });
    if (spans.reduce((all, [low, high]) => all * (high - low + 1), 1) > 1000)
      throw new Unsupported("a ball that reaches into more than 1000 cells");
    for (let i = spans[0][0]; i <= spans[0][1]; ++i)
      for (let j = spans[1][0]; j <= spans[1][1]; ++j)
        for (let k = spans[2][0]; k <= spans[2][1]; ++k)
          this.near.push({ atom, r, n: [i, j, k], centre: add(this.at([i, j, k]), p) });
  }

  at(n) {
    return add(
      add(
        this.u[0].map((c) => c * n[0]),
        this.u[1],
        n[1],
      ),
      this.u[2],
      n[2],
    );
  }
}

/**
 * The time of the library's own ray casts. They are recorded and repeated, a thousand or more in a row,
 * between two readings of the clock, whose cost is then negligible. The time for placing the balls is
 * measured in the same way and subtracted, because the balls of a real program are already placed. The tests
 * whether the start is in a ball are not included.
 */
class Stopwatch {
  constructor(library) {
    this.library = library;
    this.casts = [];
    this.seconds = 0;
    this.sum = 0; // of the results, so that no compiler removes the casts
  }

  note(p, d, c, r) {
    this.casts.push({ p, d, c, r });
  }

  measure(atLeast = 1024) {
    if (this.casts.length === 0 || this.casts.length < atLeast) return;
    const start = process.hrtime.bigint();
    for (const { p, d, c, r } of this.casts) {
      this.library.place(c, r);
      this.sum += this.library.enters(p, d) ?? 0;
    }
    const between = process.hrtime.bigint();
    for (const { c, r } of this.casts) this.library.place(c, r);
    const end = process.hrtime.bigint();
    this.seconds += Math.max(0, Number(between - start - (end - between)) * 1e-9);
    this.casts = [];
  }
}

/** The result: the ball that contains the start, or the ball that is entered first, or left by the rule "exit". */
class Found {
  inside = undefined;
  left = false;
  hit = undefined;
  time = Infinity;
  undecided = false;

  addInside(name) {
    if (!this.inside || isBefore(name, this.inside)) this.inside = name;
  }

  addExit(time, name) {
    if (!this.left) ((this.hit = undefined), (this.left = true));
    this.addHit(time, name, true);
  }

  addHit(time, name, isExit = false) {
    if (Number.isNaN(time)) throw Error("the library says: not a number");
    if (this.left && !isExit) return;
    if (this.hit && !(time < this.time || (time === this.time && isBefore(name, this.hit)))) return;
    this.time = time;
    this.hit = name;
  }
}

class Walk {
  constructor(library, inCells) {
    this.library = library;
    this.inCells = inCells;
    this.cells = library.cells ?? MOST_CELLS;
    this.stopwatch = new Stopwatch(library);
  }

  first(lattices, query) {
    const found = new Found();
    lattices.forEach((lattice, index) => {
      if (lattice.rank === 0) this.single(lattice, index, query, found);
      else this.crystal(lattice, index, query, found);
    });
    return found;
  }

  crystal(lattice, index, { x, v, from, maxTime }, found) {
    const y = lattice.dual.map((w) => dot(w, x));
    const s = lattice.dual.map((w) => dot(w, v));
    const cell = y.map((c, k) => (k < lattice.rank ? Math.floor(c) : 0));
    for (let step = 0, enter = 0; step < this.cells; ++step) {
      let axis = 0;
      let leave = Infinity;
      for (let k = 0; k < lattice.rank; ++k) {
        const t = (cell[k] + (s[k] > 0) - y[k]) / s[k];
        if (s[k] !== 0 && t < leave) ((leave = t), (axis = k));
      }
      const corner = lattice.at(cell);
      const begin = this.inCells ? enter : 0;
      const p = this.inCells ? add(add(x, v, begin), corner, -1) : x;
      for (const { atom, r, n, centre } of lattice.near) {
        const name = [index, atom, ...add(cell, n)];
        const c = this.inCells ? centre : add(corner, centre);
        if (!from || !isSame(name, from)) this.ball(p, v, begin, leave, c, r, step === 0, name, found);
      }
      if (found.inside || (found.hit && found.time <= leave) || leave >= maxTime) return;
      enter = leave;
      cell[axis] += s[axis] > 0 ? 1 : -1;
    }
    found.undecided = true;
  }

  // The library alone, without a walk. The segment ends behind the ball, at a power of 2, so nothing is
  // rounded.
  single(lattice, index, { x, v, from }, found) {
    for (const { atom, r, centre } of lattice.near) {
      const name = [index, atom, 0, 0, 0];
      const enough = (2 * (Math.hypot(...add(centre, x, -1)) + r)) / Math.hypot(...v);
      const end = 2 ** Math.ceil(Math.log2(enough));
      if (!from || !isSame(name, from)) this.ball(x, v, 0, end, centre, r, true, name, found);
    }
  }

  ball(p, v, begin, end, c, r, atStart, name, found) {
    this.library.place(c, r);
    const { inside, startsInside } = this.library;
    const within = atStart && inside !== undefined && inside(p);
    if (within && !startsInside) found.addInside(name);
    if (end <= begin) return; // no segment in this cell: the ray only touches its corner
    const d = v.map((q) => q * (end - begin));
    const f = this.library.enters(p, d);
    const time = begin + f * (end - begin);
    if (f !== undefined && within) found.addExit(time, name);
    else if (f !== undefined) found.addHit(time, name);
    this.stopwatch.note(p, d, c, r);
    this.stopwatch.measure();
  }
}

function latticesOf(scene, library) {
  if (scene.dimension !== 2 && scene.dimension !== 3) throw Error("dimension must be 2 or 3");
  if (!library.dimensions.includes(scene.dimension))
    throw new Unsupported("the library does not do this dimension");
  if (!scene.lattices.length) throw Error("a scene without lattices");
  return scene.lattices.map((lattice) => new Lattice(lattice, scene.dimension));
}

function queryOf(item, { dimension, lattices }) {
  const query = { x: vector(item.x, dimension), v: vector(item.v, dimension), from: undefined, maxTime: Infinity };
  if (query.v.every((c) => c === 0)) throw Error("v is zero");
  if (item.max_time !== undefined && item.max_time !== "inf") query.maxTime = number(item.max_time);
  if (item.from === undefined) return query;
  const { lattice, atom, cell } = item.from;
  const its = lattices[lattice];
  if (!its || !(Number.isInteger(atom) && atom >= 0 && atom < its.atoms))
    throw Error("from: the scene has no such obstacle");
  const n = vector(cell, its.rank, integer, Number.isInteger);
  query.from = [lattice, atom, ...n];
  return query;
}

function answerOf(found, lattices, { maxTime }) {
  const inTime = found.hit && found.time < maxTime;
  if (!found.inside && !inTime && !found.undecided && Number.isFinite(maxTime)) return { outcome: "later" };
  if (!found.inside && found.undecided) return { outcome: "undecided" };
  if (!found.inside && !found.hit) return { outcome: "never" };
  const [lattice, atom, ...n] = found.inside ?? found.hit;
  const cell = n.slice(0, lattices[lattice].rank);
  const where = { lattice, atom, cell: cell.map((c) => (Math.abs(c) < 9e15 ? c : String(BigInt(c)))) };
  if (found.inside) return { outcome: "inside", ...where };
  return { outcome: "hit", ...where, time: Number.isFinite(found.time) ? found.time : "inf" };
}

const errorOf = (error) => ({
  outcome: "error",
  message: String(error.message),
  ...(error instanceof Unsupported ? { reason: "unsupported" } : {}),
});

/** The version in a package's package.json, not read by `require`, since many packages do not export it. */
const versionOf = (name) =>
  JSON.parse(fs.readFileSync(new URL(`./node_modules/${name}/package.json`, import.meta.url))).version;

/** Answers the stream on standard input. */
export async function walk(library) {
  const engine = new Walk(library, process.argv.includes("cells"));
  const say = (object) => process.stdout.write(JSON.stringify(object) + "\n");
  let scene;
  let trouble = { outcome: "error", message: "no scene yet" };
  let queries = 0;
  let empty = true;

  const takeScene = (item) => {
    scene = undefined;
    try {
      scene = { dimension: item.dimension, lattices: latticesOf(item, library) };
    } catch (error) {
      trouble = errorOf(error);
      if (!(error instanceof Unsupported)) say({ id: null, ...trouble });
    }
  };
  const take = (line) => {
    let id = null;
    let answer;
    try {
      const item = JSON.parse(line);
      if (item.golden) return;
      if (item.scene) return takeScene(item.scene);
      id = item.id ?? null;
      const query = scene && queryOf(item, scene);
      answer = scene ? answerOf(engine.first(scene.lattices, query), scene.lattices, query) : trouble;
    } catch (error) {
      answer = errorOf(error); // an invalid line does not end the stream
    }
    ++queries;
    say({ id, ...answer });
  };

  for await (const line of readline.createInterface({ input: process.stdin })) {
    empty = false;
    if (line.trim()) take(line);
  }
  if (empty) {
    const { name, version, precision, dimensions, startsInside: inside } = library;
    say({ engine: { name, version: version ?? versionOf(library.package), precision, dimensions, inside } });
  } else {
    engine.stopwatch.measure(0);
    say({ engine_time: { seconds: engine.stopwatch.seconds, queries } });
  }
}
