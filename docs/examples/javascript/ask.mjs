// Asks lorentz for exact first hits, from JavaScript, by way of the library for C and the package koffi:
//     npm ci && node ask.mjs PREFIX/lib/liblorentz.so
// The four queries are those of README.md; <lorentz/lorentz.h> says what each column is.
import koffi from "koffi";

const OUTCOMES = ["hit", "never", "inside", "undecided", "unsupported", "later", "far", "invalid"];
const BAD_ROWS = 1;

const library = koffi.load(process.argv[2] ?? "liblorentz.so.1");
koffi.opaque("lorentz_asker");
koffi.struct("lorentz_queries", {
  count: "int64_t",
  x: koffi.array("double *", 3),
  v: koffi.array("double *", 3),
  from_lattice: "int32_t *",
  from_atom: "int32_t *",
  from_cell: koffi.array("int64_t *", 3),
});
koffi.struct("lorentz_answers", {
  outcome: "int32_t *",
  lattice: "int32_t *",
  atom: "int32_t *",
  cell: koffi.array("int64_t *", 3),
  time: "double *",
});
const open = library.func("lorentz_asker *lorentz_open(const char *scene, const char *engine)");
const firstHits = library.func(
  "int32_t lorentz_first_hits(lorentz_asker *, const lorentz_queries *, const double *max_time, const lorentz_answers *)",
);
const why = library.func("const char *lorentz_why(const lorentz_asker *)");
const close = library.func("void lorentz_close(lorentz_asker *)");

const scene = {
  dimension: 2,
  lattices: [{ vectors: [[1, 0], [0, 1]], atoms: [{ position: [0, 0], radius: 0.1 }] }], // prettier-ignore
};
const x = [Float64Array.of(0, 0, 0, 0.05), Float64Array.of(0.445, 0.445, 0.445, 0), null];
const v = [Float64Array.of(0.9998476951563913, 1, 1, 1), Float64Array.of(0.01745240643728351, 0, 1e-20, 0), null];
const count = x[0].length;
const queries = { count, x, v, from_lattice: null, from_atom: null, from_cell: [null, null, null] };
const cell = [new BigInt64Array(count), new BigInt64Array(count), null];
const answers = { outcome: new Int32Array(count), lattice: null, atom: null, cell, time: new Float64Array(count) };

const asker = open(JSON.stringify(scene), null);
const status = firstHits(asker, queries, null, answers);
if (why(asker) !== null) console.error(`ask: ${why(asker)}`);
for (let i = 0; i < count && status <= BAD_ROWS; ++i)
  console.log(
    `${OUTCOMES[answers.outcome[i]]}, cell (${cell[0][i]}, ${cell[1][i]}), time ${answers.time[i]}`,
  );
close(asker);
process.exitCode = status;
