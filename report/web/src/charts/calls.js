// How close the calls were: of questions alike in number from each row, what became of those whose obstacle is
// met or missed by so much. A tolerance shows as an edge, with faults on its left alone.
import * as Plot from "@observablehq/plot";
import { chart, plot } from "../chart.js";
import { count, percent, powerTick } from "../numbers.js";
import { verdictOf } from "../verdicts.js";

const PARTS = [
  ["wrong", "wrong"],
  ["ill_posed", "ill-posed"],
  ["undecided", "undecided"],
  ["right", "right"],
].map(([key, name]) => ({ key, verdict: verdictOf(name) }));
const LOWEST = -20; // what is closer is drawn together

const totalOf = (call) => PARTS.reduce((sum, { key }) => sum + call[key], 0);

function gathered(calls) {
  const decades = new Map();
  for (const call of calls) {
    const decade = Math.max(call.decade, LOWEST);
    const its = decades.get(decade) ?? { decade, right: 0, ill_posed: 0, wrong: 0, undecided: 0 };
    for (const { key } of PARTS) its[key] += call[key];
    decades.set(decade, its);
  }
  return [...decades.values()].sort((a, b) => a.decade - b.decade);
}

const rangeOf = ({ decade }) =>
  decade === LOWEST
    ? `below ${powerTick(10 ** (LOWEST + 1))}`
    : `${powerTick(10 ** decade)} to ${powerTick(10 ** (decade + 1))}`;

export function calls(report) {
  const all = gathered(report.calls ?? []);
  if (!all.length) return null;
  const parts = PARTS.filter(({ key }) => all.some((call) => call[key] > 0));

  function draw(width) {
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
        label: "radii by which it is met or missed",
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
          `${rangeOf(call)} radii`,
          `${count(totalOf(call))} answers`,
          ...parts
            .filter(({ key }) => call[key] > 0)
            .map(
              ({ key, verdict }) =>
                `${count(call[key])} ${verdict.word} (${percent(call[key] / totalOf(call))})`,
            ),
        ],
      })),
      legend: parts.map(({ verdict }) => ({
        name: verdict.word,
        look: { colour: verdict.colour, symbol: verdict.symbol ?? "circle", dash: "" },
      })),
      summary: said(all),
      numbers: {
        columns: ["radii from", "right", "ill-posed", "wrong", "undecided"],
        rows: all.map((c) => [10 ** c.decade, c.right, c.ill_posed, c.wrong, c.undecided]),
      },
    };
  }
  return chart({
    name: "calls",
    title: "How close the calls were",
    note: "Each bar holds answers whose obstacle is met or missed by so much; right answers are faint. If only the bars left of an edge are coloured, the engine decides with a tolerance of that size; if colour reaches far to the right, plain cases are wrong too.",
    draw,
  }).element;
}

function said(all) {
  const wrong = all.filter((call) => call.wrong > 0);
  const answers = all.reduce((sum, call) => sum + totalOf(call), 0);
  if (!wrong.length) return `${count(answers)} answers; none of these is wrong, however close the call.`;
  const edge = wrong.at(-1).decade + 1;
  const beyond = all.filter((call) => call.decade >= edge).reduce((sum, call) => sum + totalOf(call), 0);
  return `${count(answers)} answers; wrong ones only where the obstacle is met or missed by less than ${powerTick(10 ** edge)} radii${beyond ? `, none of the ${count(beyond)} beyond` : ""}.`;
}
