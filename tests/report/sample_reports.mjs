// Reports with everything that the page can show, made up; the same each time.
//   node sample_reports.mjs FOLDER   writes judge.json, bench.json, timed.json, hostile.json, big.json, small.json there
import { mkdirSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

// Numbers from 0 to 1 that look drawn (mulberry32), from a seed.
function drawn(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const MANIFEST = {
  version: "0.1.0",
  commit: "0123456789ab",
  compiler: "GNU 12.2.0",
  flags: "-O3 -DNDEBUG -ffp-contract=off",
  machine: "made up, 2 cores",
  instructions: "AVX2",
  system: "Linux 6.1 x86_64",
  date: "2026-11-22",
  seed: 20161115,
  command: "lorentz judge --engine ./tolerant_engine --html report.html",
};

const SCENE = {
  dimension: 2,
  lattices: [
    {
      vectors: [
        ["0x1p+0", "0x0p+0"],
        ["0x0p+0", "0x1p+0"],
      ],
      atoms: [{ position: ["0x0p+0", "0x0p+0"], radius: "0x1.999999999999ap-4" }],
    },
  ],
};

// A flight past a disc to the next, and an inset.
function picture(i, words = "named by the engine") {
  const y = 150 + (i % 7);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 300" width="640" height="300" font-family="Helvetica, Arial, sans-serif" font-size="13"><title>flight</title><defs><clipPath id="frame"><rect x="0" y="0" width="640" height="300"/></clipPath></defs><rect width="640" height="300" fill="white"/><g clip-path="url(#frame)"><circle cx="300" cy="${y - 41}" r="40" fill="#f6d5c2" stroke="#c24400"/><circle cx="560" cy="150" r="40" fill="#cfe6f5" stroke="#0072b2"/><line x1="30" y1="150" x2="520" y2="150" stroke="#222" stroke-width="2"/><circle cx="30" cy="150" r="4"/></g><text x="245" y="60" fill="#c24400">${words}</text><text x="505" y="210" fill="#0072b2">hit in truth</text></svg>`;
}

function finding(i, cause, explanation, radii, more = {}) {
  return {
    cause,
    explanation,
    count: 1,
    where: "drawn square r=0.1",
    verdict: "wrong",
    scene: SCENE,
    query: {
      id: `q${i}`,
      x: ["0x1.8p-2", "0x1.c7ae147ae147bp-2"],
      v: ["0x1.ffb0p-1", "0x1.1df0b2b89dd1ep-6"],
    },
    given: { outcome: "hit", lattice: 0, atom: 0, cell: [3 + (i % 5), 1], time: "0x1.cp+1" },
    exact: { outcome: "hit", lattice: 0, atom: 0, cell: [9, 1], time: "0x1.1ap+3" },
    by_radii: radii,
    by_ulps: Math.abs(radii) * 3e9,
    reason: [
      `the line misses the obstacle of lattice 0, atom 0, cell (${3 + (i % 5)}, 1) by ${radii.toExponential(2)} of its radii`,
      "decided by the sign of a distance that needs 61 bits",
    ],
    commands: [
      `echo '{"scene":{"dimension":2}}' > q${i}.ndjson`,
      `lorentz first-hit --engine oracle --detail q${i}.ndjson`,
    ],
    drawing: picture(i),
    primitive: {
      origin: ["0x1.8p-2", "0x1.c7ae147ae147bp-2"],
      direction: ["0x1.ffb0p-1", "0x1.1df0b2b89dd1ep-6"],
      centre: ["0x3p+0", "0x1p+0"],
      radius: "0x1.999999999999ap-4",
      discriminant: -1,
      entry_time: null,
    },
    primitive_cpp:
      "const double x[] = {0x1.8p-2, 0x1.c7ae147ae147bp-2};\n// The exact discriminant is negative.\n",
    ...more,
  };
}

const OWN = "the engine's own faults",
  ROUNDING = "of floating point, no blame (ill-posed)";

const TOLERANCE = [
  "grazing-counted-as-hit",
  "It counts a flight as a hit that passes the obstacle by less than about 1e-9 of its radius.",
];

function judge() {
  const draw = drawn(1);
  const near = Array.from({ length: 9 }, (_, i) =>
    finding(i, ...TOLERANCE, 10 ** (-9.1 - 5 * draw()), {
      title: "hits what it misses by a hair",
      group: OWN,
      last_words: "warning: 3 rays were clamped",
      why: "b^2 - a c cancels at the edge (docs/ray_and_ball.md#what-to-do)",
      where: i % 3 ? "golden grazing" : "campaign",
      count: 1 + Math.floor(40 * draw()),
    }),
  );
  return {
    format: 1,
    kind: "judge",
    title: "lorentz judge: tolerant_engine",
    manifest: MANIFEST,
    engine: "cmd:./tolerant_engine",
    verdict: "wrong",
    summary: {
      what: "cmd:./tolerant_engine; judged in binary64, times to 4 ulps of the inputs",
      how_bad: "none wrong of 20 000 drawn; hard cases: 0.5 % wrong (of 28 211)",
      worst: "hits obstacles that the line misses by less than 1e-09 of their radii",
      next: ["mend the first, and judge again"],
      finding: 0,
    },
    queries: 48211,
    wrong: 143,
    ill_posed: 12,
    wrong_time: 7,
    undecided: 96,
    ns_per_query: 1832.5,
    line: "wrong: 3 kinds of fault, the simplest counts as a hit what passes by less than 1e-9 of a radius; undecided 0.2 %; times within 4 ulps but grazing hits; 1 833 ns a query, 2.3 times lorentz's own engine",
    difficulties: [
      ["drawn", "starts drawn uniformly, directions isotropic", 20000, 0, 0, 0, 0, 3.8, 1200],
      ["near-rational", "directions close to a lattice line", 8211, 3, 2, 0, 31, 5.1, 2400],
      ["grazing", "lines that touch an obstacle but for the last bits", 10000, 137, 10, 7, 65, 2.1e6, 1900],
      [
        "golden deep corridor",
        "flights along a corridor that is free for 10^6 cells",
        4000,
        0,
        0,
        0,
        0,
        12,
        5600,
      ],
      [
        "campaign",
        "cases that a campaign constructed and made harder, with a name that is long",
        6000,
        3,
        0,
        0,
        0,
        3.2,
        2000,
      ],
    ]
      .map(
        ([name, explanation, queries, wrong, ill_posed, wrong_time, undecided, max_ulp, ns_per_query]) => ({
          name,
          explanation,
          queries,
          agree: queries - wrong - ill_posed - wrong_time - undecided,
          ill_posed,
          wrong,
          wrong_time,
          undecided,
          unsupported: 0,
          error: 0,
          missing: 0,
          nonsense: 0,
          max_ulp,
          max_radii: max_ulp * 1e-16,
          records: name.startsWith("golden") ? 640000 : null,
          ns_per_query,
          state: "asked",
          scenes_given_up: 0,
          why: null,
        }),
      )
      .concat(
        [
          ["golden ellipsoids", "unsupported", null, 40],
          ["golden ties", "no time", null, 0],
          ["golden far starts", "given up", "cmd died (exit 3) on this query", 9],
        ].map(([name, state, why, queries]) => ({
          name,
          explanation: "a committed set of hard cases",
          state,
          scenes_given_up: why ? 2 : 0,
          why,
          queries,
          agree: state === "given up" ? 4 : 0,
          ill_posed: 0,
          wrong: 0,
          wrong_time: 0,
          undecided: 0,
          unsupported: state === "unsupported" ? queries : 0,
          error: 0,
          missing: state === "given up" ? 5 : 0,
          nonsense: 0,
          max_ulp: null,
          ns_per_query: null,
        })),
      ),
    missing: 5,
    nonsense: 115,
    findings: [
      ...near.sort((a, b) => b.count - a.count),
      finding(
        20,
        "time-of-grazing-hit",
        "The time of a grazing hit loses half of its digits: the square root of a difference that cancels.",
        -3e-7,
        { verdict: "wrong-time", by_ulps: 1e132, group: OWN, where: "golden grazing", count: 7 },
      ),
      finding(21, "sign-of-zero", "A component of the velocity that is -0 turns the search around.", 0.8, {
        where: "campaign",
        count: 3,
        group: OWN,
      }),
      finding(22, "last-bits", "The question is decided by the last bits of x.", 2e-16, {
        verdict: "ill-posed",
        group: ROUNDING,
        by_ulps: 0.8,
        where: "golden grazing",
        drawing: null,
      }),
    ],
  };
}

const ENGINES = [
  ["reduction", 800, 0, -0.02, 2],
  ["published", 420, 2e-3, -0.08, 5],
  ["classical", 300, 2e-4, -0.9, 9],
  ["binary128", 21000, 0, -0.03, 0.5],
  ["float", 260, 0.04, -0.05, 5e8],
];
const RADII = [0.1, 0.01, 1e-3, 1e-4, 1e-5];

function histogram(draw, n, scale) {
  const counts = Array.from({ length: 8 }, (_, i) =>
    Math.floor(n * 0.6 * Math.exp(-0.9 * Math.abs(i - 3)) * (0.8 + 0.4 * draw())),
  );
  const first = Math.round(Math.log2(scale)) - 4;
  return {
    exact: Math.floor(n * 0.2),
    first,
    counts,
    mean: scale / 2,
    p99: scale * 1.7,
    max: 2 ** (first + 8) * 0.9,
  };
}

// 95 % bounds as they would be, roughly: what is shown is what the report says.
const share = (count, n) => ({
  count,
  low: count ? (count / n) * 0.7 : 0,
  high: count ? (count / n) * 1.35 : 3.7 / n,
});

function cell(draw, scene, radius, difficulty, [engine, ns, wrong, slope, ulps]) {
  const queries = 20000,
    median = ns * (radius / 0.1) ** slope * (0.95 + 0.1 * draw()) * (difficulty === "drawn" ? 1 : 2.2);
  const faults = Math.round(queries * wrong * (difficulty === "drawn" ? 1 : 6) * (0.7 + 0.6 * draw()));
  return {
    scene,
    radius,
    dimension: scene === "square" ? 2 : 3,
    difficulty,
    engine,
    queries,
    skipped: false,
    ns: { median, q1: median * 0.93, q3: median * 1.12, mean: median * 1.04 },
    mean_path: 1 / (2 * radius),
    undecided: share(engine === "reduction" ? 4 : 0, queries),
    ill_posed: share(0, queries),
    wrong: share(Math.min(faults, queries), queries),
    wrong_time: share(Math.round(faults / 9), queries),
    ulps: histogram(draw, queries, ulps),
    conditions: histogram(draw, queries, ulps / 3),
    calls: [
      { decade: -10, agree: 0, ill_posed: 0, wrong: Math.min(faults, queries), undecided: 0, radii_off: 0 },
      { decade: -1, agree: 2 * queries, ill_posed: 0, wrong: 0, undecided: 4, radii_off: 1e-9 },
    ].filter((call) => call.wrong + call.agree > 0),
    worst: {
      ulps: ulps * 7,
      query: { x: ["0x1p-1", "0x1p-3"], v: ["0x1p+0", "0x1.8p-4"] },
      command: `lorentz first-hit --engine ${engine} worst.ndjson`,
    },
  };
}

function bench() {
  const draw = drawn(2),
    cells = [];
  for (const scene of ["square", "cubic"])
    for (const difficulty of ["drawn", "near-rational"])
      for (const radius of RADII)
        for (const engine of ENGINES) cells.push(cell(draw, scene, radius, difficulty, engine));
  cells.push({
    ...cells[0],
    radius: 1e-6,
    engine: "classical",
    skipped: true,
    ns: null,
    ulps: null,
    conditions: null,
    calls: null,
    worst: null,
    wrong: null,
  });
  return {
    format: 1,
    kind: "bench",
    title: "lorentz bench: five engines",
    manifest: { ...MANIFEST, command: "lorentz bench --html bench.html" },
    cells,
    findings: [
      finding(
        1,
        "float-misses-small-obstacles",
        "At small radii single precision steps over the obstacle.",
        0.4,
        { where: "square r=1e-05" },
      ),
    ],
    free_paths: [0.1, 0.01].map((radius) => ({
      scene: "square",
      radius,
      points: Array.from({ length: 24 }, (_, i) => {
        const t = (0.1 * 1.6 ** i) / radius;
        const s = 1 / (1 + (2 * radius * t) ** 2);
        return { t, survival: s * (1 + 0.03 * draw()), theory: s };
      }),
    })),
  };
}

// What an engine may have said to break the page, in every text.
export const HOSTILE =
  '<script>window.broken=1</script></script><img src=x onerror="window.broken=1">\'"`${1}\u2028\u2029\u202e\u202a\u2066\u2069\u200f\u061c<!--';

// A text as the page shows it: no character turns it round or ends a line.
export const shown = (text) =>
  text.replace(
    /[\u2028-\u202e\u2066-\u2069\u200e\u200f\u061c]/g,
    (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`,
  );
export const SHOWN = shown(HOSTILE);

function hostile() {
  const report = judge();
  const scrub = (value) =>
    Array.isArray(value)
      ? value.map(scrub)
      : value && typeof value === "object"
        ? Object.fromEntries(
            Object.entries(value).map(([k, v]) => [k, ["kind", "verdict"].includes(k) ? v : scrub(v)]),
          )
        : typeof value === "string"
          ? `${value} ${HOSTILE}`
          : value;
  const drawing = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100" height="50" onload="window.broken=1"><script>window.broken=1</script><a href="javascript:window.broken=1"><text y="20">x</text></a><foreignObject width="9" height="9"><iframe xmlns="http://www.w3.org/1999/xhtml" src="http://127.0.0.1:9/frame"/></foreignObject><image href="http://127.0.0.1:9/image.png" width="9" height="9"/><style>@import url(http://127.0.0.1:9/style.css); rect { fill: url(http://127.0.0.1:9/fill.svg#a) }</style><rect class="kept" width="50" height="50" fill="url(http://127.0.0.1:9/fill.svg#a)" onclick="window.broken=1"/></svg>`;
  const made = scrub(report);
  made.findings.forEach((f, i) => {
    f.drawing = i % 2 ? drawing : "<svg><not closed";
  });
  return { ...made, "unknown key": HOSTILE, cells: scrub(bench().cells.slice(0, 20)) };
}

function big() {
  const draw = drawn(3),
    causes = [
      TOLERANCE,
      ["steps-over-small-obstacle", "It steps over obstacles that are smaller than its step."],
      ["never-for-far-hits", "It gives up after a million cells and says never."],
    ];
  const findings = Array.from({ length: 10000 }, (_, i) => {
    const [cause, explanation] = causes[i % 3];
    return finding(i, cause, explanation, 10 ** (-2 - 12 * draw()), {
      where: ["campaign", "golden grazing", "drawn square r=0.1"][(i % 7) % 3],
      query: { id: `needle-${i}`, x: ["0x1.8p-2", "0x1p-3"], v: ["0x1p+0", "0x1p-6"] },
    });
  });
  return { ...judge(), title: "10 000 findings", findings };
}

// Right but for its times and its free paths; one row is beyond it.
function timed() {
  const report = judge();
  const [plain, , grazing, , campaign] = report.difficulties;
  const beyond = { ...campaign, name: "drawn ellipses", agree: 0, wrong: 0, unsupported: campaign.queries };
  const late = {
    ...grazing,
    agree: grazing.queries - 70,
    wrong: 0,
    ill_posed: 0,
    undecided: 0,
    wrong_time: 70,
  };
  return {
    ...report,
    title: "late_engine, judged",
    engine: "cmd:./late_engine",
    verdict: "right",
    line: "right: no wrong answer in 36000; wrong times 0.19 %, by up to 3e-07 radii along the ray",
    summary: {
      what: "cmd:./late_engine; judged in binary64, times to 4 ulps of the inputs",
      how_bad: "none wrong of 20 000 drawn; hard cases: none wrong (of 16 000); 0.19 % with a wrong time",
      worst: "gives times of the right obstacle that are off, by up to 3e-07 radii along the ray",
      finding: 0,
    },
    wrong: 0,
    ill_posed: 0,
    undecided: 0,
    wrong_time: 70,
    error: 30,
    difficulties: [plain, late, beyond, { ...plain, name: "failing", agree: plain.agree - 30, error: 30 }],
    findings: [report.findings[9], { ...report.findings[9], where: "campaign" }],
    calls: Array.from({ length: 12 }, (_, i) => ({
      decade: i - 11,
      agree: 40 * (i + 1),
      ill_posed: 0,
      wrong: i < 2 ? 10 : 0,
      undecided: 0,
    })),
    curves: [
      {
        by: "radii from the start to the obstacle in question",
        decades: [0, 5, 9].map((decade) => ({
          decade,
          agree: 100,
          ill_posed: 0,
          wrong: decade === 9 ? 25 : 0,
          undecided: 0,
          radii_off: decade / 100,
        })),
      },
    ],
    free_paths: [
      {
        scene: "cubic",
        radius: 0.1,
        engine: "cmd:./late_engine",
        from: "surface",
        law: "",
        points: Array.from({ length: 9 }, (_, i) => {
          const exact = 0.8 * 0.6 ** i;
          return { t: 2 ** i, survival: i === 3 ? exact + 0.02 : exact, exact, theory: null };
        }),
      },
    ],
  };
}

// The least that the contract allows.
const small = () => ({
  format: 1,
  kind: "case",
  title: "one case",
  findings: [finding(0, ...TOLERANCE, 1e-10)],
});

export const SAMPLES = { judge, bench, timed, hostile, big, small };

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href) {
  mkdirSync(process.argv[2], { recursive: true });
  for (const [name, make] of Object.entries(SAMPLES))
    writeFileSync(`${process.argv[2]}/${name}.json`, JSON.stringify(make()));
}
