// How close the calls were that an engine got wrong. A tolerance shows as an edge beyond which there is no
// finding.
import * as Plot from "@observablehq/plot";
import { shortened } from "../dom.js";
import { chart, logAxis, plot } from "../chart.js";
import { choice } from "../controls.js";
import { radiiOf } from "../finding.js";
import { isNumber, number, ulps } from "../numbers.js";
import { verdictOf } from "../verdicts.js";

const MOST = 1500; // points; more are thinned evenly
const MEASURES = [
  ["by_radii", "radii of the obstacle in question", (f) => `${number(Math.abs(f.by_radii))} ${radiiOf(f)}`],
  ["by_ulps", "last bits of the input (ulps)", (f) => ulps(Math.abs(f.by_ulps))],
];

// A position in the band of its cause that is the same each time.
const spread = (i) => ((i * 0.618034) % 1) - 0.5;

export function closeness(report) {
  const findings = report.findings ?? [];
  const measures = MEASURES.filter(
    ([key]) => findings.filter((f) => isNumber(f[key]) && f[key] !== 0).length > 1,
  );
  if (!measures.length) return null;
  const measure = choice(
    "In",
    measures.map(([key, text]) => [key, text]),
    () => made.redraw(),
  );

  function draw(width) {
    const [key, unit, say] = measures.find(([key]) => key === measure.value) ?? measures[0];
    const all = findings.filter((f) => isNumber(f[key]) && f[key] !== 0);
    const step = Math.ceil(all.length / MOST),
      some = all.filter((_, i) => i % step === 0);
    const causes = topCauses(some),
      named = (f) => (causes.includes(f.cause) ? f.cause : "others");
    const letters = Math.floor(Math.min(170, 0.34 * width) / 6.6);
    const domain = some.every((f) => causes.includes(f.cause)) ? causes : [...causes, "others"];
    const band = some.length > 60 ? 44 : 30;
    const svg = plot({
      width,
      height: 56 + band * domain.length,
      marginLeft: 16 + 6.6 * Math.min(letters, Math.max(...domain.map((c) => c.length))),
      x: logAxis(
        unit,
        some.map((f) => Math.abs(f[key])),
        width / 110,
        { air: 3 },
      ),
      y: { type: "band", domain, label: null, tickSize: 0, tickFormat: (cause) => shortened(cause, letters) },
      marks: [
        Plot.ruleY(domain, { y: (c) => c, strokeOpacity: 0.12 }),
        Plot.dot(some, {
          x: (f) => Math.abs(f[key]),
          y: named,
          dy: 0,
          r: some.length > 200 ? 2.5 : 5.5,
          symbol: (f) => verdictOf(f.verdict).symbol,
          fill: (f) => verdictOf(f.verdict).colour,
          fillOpacity: some.length > 200 ? 0.5 : 0.95,
          render(index, scales, values, size, context, next) {
            return shifted(next(index, scales, values, size, context), index, band, some.length);
          },
        }),
      ],
    });
    return { svg, ...shown(svg, some, all, named, key, unit, say, band) };
  }
  const made = chart({
    name: "closeness",
    title: "How close the calls were",
    note: "How far the obstacle in question is met or missed, for each finding. If all lie left of an edge, the engine decides with a tolerance of that size; if they reach far to the right, plain cases are wrong too.",
    controls: [measure.element],
    draw,
  });
  return made.element;
}

function topCauses(findings) {
  const counts = new Map();
  for (const f of findings) counts.set(f.cause, (counts.get(f.cause) ?? 0) + 1);
  return [...counts]
    .sort((a, b) => b[1] - a[1])
    .slice(0, 12)
    .map(([cause]) => cause);
}

const offset = (i, band, n) => (n > 12 ? spread(i) * 0.7 * band : 0);

function shifted(group, index, band, n) {
  [...group.children].forEach((mark, j) => {
    const transform = mark.getAttribute("transform");
    if (transform)
      mark.setAttribute("transform", `translate(0,${offset(index[j], band, n).toFixed(1)}) ${transform}`);
    else mark.setAttribute("cy", Number(mark.getAttribute("cy")) + offset(index[j], band, n));
  });
  return group;
}

function shown(svg, some, all, named, key, unit, say, band) {
  const [sx, sy] = [svg.scale("x"), svg.scale("y")];
  const largest = Math.max(...all.map((f) => Math.abs(f[key])));
  const seen = [...new Set(some.map((f) => f.verdict))].map(verdictOf);
  return {
    points: some.map((f, i) => ({
      x: sx.apply(Math.abs(f[key])),
      y: sy.apply(named(f)) + sy.bandwidth / 2 + offset(i, band, some.length),
      key: f.key,
      lines: [f.cause, verdictOf(f.verdict).word, say(f), f.where ?? ""].filter(Boolean),
    })),
    legend: seen.map((v) => ({ name: v.word, look: { colour: v.colour, symbol: v.symbol, dash: "" } })),
    summary: `${all.length} findings by how far the obstacle in question is met or missed, in ${unit}; the farthest: ${number(largest)}.${some.length < all.length ? ` Drawn: every ${Math.ceil(all.length / some.length)}th.` : ""}`,
    numbers: {
      columns: ["cause", "verdict", "where", unit],
      rows: all.map((f) => [f.cause, f.verdict, f.where, f[key]]),
    },
  };
}
