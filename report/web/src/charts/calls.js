// Where the engine begins to fail: the verdicts by decade of a measure (how closely the obstacle is met or
// missed, a distance, or a radius), with about the same number of questions from each row. A tolerance shows
// as an edge.
import * as Plot from "@observablehq/plot";
import { chart, plot } from "../chart.js";
import { choice } from "../controls.js";
import { count, number, percent, powerTick } from "../numbers.js";
import { verdictOf } from "../verdicts.js";

const PARTS = [
  ["wrong", "wrong"],
  ["ill_posed", "ill-posed"],
  ["undecided", "undecided"],
  ["agree", "right"],
].map(([key, name]) => ({ key, verdict: verdictOf(name) }));
const LOWEST = -20; // closer ones are drawn together

const totalOf = (call) => PARTS.reduce((sum, { key }) => sum + call[key], 0);

function gathered(calls) {
  const decades = new Map();
  for (const call of calls) {
    const decade = Math.max(call.decade, LOWEST);
    const its = decades.get(decade) ?? { decade, agree: 0, ill_posed: 0, wrong: 0, undecided: 0, off: 0 };
    for (const { key } of PARTS) its[key] += call[key];
    its.off = Math.max(its.off, call.radii_off ?? 0);
    decades.set(decade, its);
  }
  return [...decades.values()].sort((a, b) => a.decade - b.decade);
}

const rangeOf = ({ decade }) =>
  decade === LOWEST
    ? `below ${powerTick(10 ** (LOWEST + 1))}`
    : `${powerTick(10 ** decade)} to ${powerTick(10 ** (decade + 1))}`;

const CLOSE = "radii by which the line enters or misses the obstacle in question";

/** The charts of a judged engine, by measures of difficulty. */
export function calls(report) {
  const measures = [{ by: CLOSE, decades: report.calls ?? [] }, ...(report.curves ?? [])];
  return chartOf(
    "By",
    measures.map(({ by, decades }) => ({ name: by, by, decades })),
  );
}

/** The charts of a bench's engines, by closeness. */
export function callsOfCells({ cells }) {
  const engines = [...new Set(cells.map((cell) => cell.engine))];
  const decadesOf = (engine) => cells.filter((c) => c.engine === engine).flatMap((c) => c.calls ?? []);
  return chartOf(
    "Engine",
    engines.map((name) => ({ name, by: CLOSE, decades: decadesOf(name) })),
  );
}

function chartOf(label, curves) {
  const filled = curves
    .map(({ name, by, decades }) => ({ name, by, all: gathered(decades) }))
    .filter(({ all }) => all.length > 0);
  if (!filled.length) return null;
  const chosen = choice(
    label,
    filled.map(({ name }) => [name, name]),
    () => made.redraw(),
  );

  function draw(width) {
    const { all, by } = filled.find(({ name }) => name === chosen.value) ?? filled[0];
    const parts = PARTS.filter(({ key }) => all.some((call) => call[key] > 0));
    const first = all[0].decade,
      last = all.at(-1).decade;
    const domain = Array.from({ length: last - first + 1 }, (_, i) => first + i);
    const bars = all.flatMap((call) => {
      let below = 0;
      return parts.map(({ key, verdict }) => {
        const share = call[key] / totalOf(call);
        return { decade: call.decade, verdict, from: below, to: (below += share) };
      });
    });
    const step = Math.ceil((44 * domain.length) / Math.max(width - 80, 44));
    const svg = plot({
      width,
      height: Math.max(240, Math.min(320, 0.5 * width)),
      x: {
        type: "band",
        domain,
        label: by,
        labelAnchor: "center",
        tickSize: 0,
        padding: 0.12,
        tickFormat: (d) =>
          (d - first) % step === 0
            ? `${d === LOWEST ? "<" : ""}${powerTick(10 ** (d + (d === LOWEST ? 1 : 0)))}`
            : "",
      },
      y: { domain: [0, 1], label: "share of the answers", tickFormat: "%", labelAnchor: "center" },
      marks: [
        Plot.rectY(
          bars.filter((b) => b.to > b.from),
          {
            x: "decade",
            y1: "from",
            y2: "to",
            fill: (b) => b.verdict.colour,
            fillOpacity: (b) => (b.verdict.word === "right" ? 0.35 : 0.95),
            inset: 0.4,
          },
        ),
      ],
    });
    const [sx, sy] = [svg.scale("x"), svg.scale("y")];
    return {
      svg,
      points: all.map((call) => ({
        x: sx.apply(call.decade) + sx.bandwidth / 2,
        y: sy.apply(0.5),
        key: null,
        lines: [
          rangeOf(call),
          `${count(totalOf(call))} answers`,
          ...parts
            .filter(({ key }) => call[key] > 0)
            .map(
              ({ key, verdict }) =>
                `${count(call[key])} ${verdict.word} (${percent(call[key] / totalOf(call))})`,
            ),
          ...(call.off > 0 ? [`times off by up to ${number(call.off)} radii`] : []),
        ],
      })),
      legend: parts.map(({ verdict }) => ({
        name: verdict.word,
        look: { colour: verdict.colour, symbol: verdict.symbol ?? "circle", dash: "" },
      })),
      summary: said(all, by),
      numbers: {
        columns: ["from", "right", "ill-posed", "wrong", "undecided", "times off by, radii"],
        rows: all.map((c) => [10 ** c.decade, c.agree, c.ill_posed, c.wrong, c.undecided, c.off]),
      },
    };
  }
  const made = chart({
    name: "calls",
    title: "Where it begins to fail",
    note: "Each bar holds the answers of one power of ten; right ones are faint. By closeness: if only the bars left of an edge are coloured, the engine decides with a tolerance of that size; if colour reaches far to the right, plain cases are wrong too. By distances: colour on the right is what large numbers cost.",
    controls: [chosen.element],
    draw,
  });
  return made.element;
}

function said(all, by) {
  const wrong = all.filter((call) => call.wrong > 0);
  const answers = all.reduce((sum, call) => sum + totalOf(call), 0);
  if (!wrong.length) return `${count(answers)} answers; none of these is wrong.`;
  const tick = (decade) => powerTick(10 ** decade);
  if (by !== CLOSE)
    return `${count(answers)} answers; wrong ones from ${tick(wrong[0].decade)} to ${tick(wrong.at(-1).decade + 1)}.`;
  const edge = wrong.at(-1).decade + 1;
  const beyond = all.filter((call) => call.decade >= edge).reduce((sum, call) => sum + totalOf(call), 0);
  return `${count(answers)} answers; wrong ones only where the obstacle is met or missed by less than ${edge === 0 ? "a radius" : `${tick(edge)} radii`}${beyond ? `, none of the ${count(beyond)} beyond` : ""}.`;
}
