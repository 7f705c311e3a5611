// Errors of the times of right hits: one histogram per engine, over bins of powers of two.
import * as Plot from "@observablehq/plot";
import { shortened } from "../dom.js";
import { chart, logAxis, plot } from "../chart.js";
import { choice } from "../controls.js";
import { groupChoices, inGroup } from "../cells.js";
import { count, number, percent, superscript } from "../numbers.js";
import { pooled } from "../statistics.js";

const UNITS = [
  ["ulps", "ulps"],
  ["conditions", "units of the condition"],
];
const power = (exponent) =>
  exponent >= -3 && exponent <= 10 ? number(2 ** exponent) : `2${superscript(exponent)}`;

function barsOf(engine, sum, leftmost) {
  const bar = (at, count, text) => ({ engine, at, count, share: count / sum.total, text });
  return [
    ...(sum.exact ? [bar(leftmost - 2, sum.exact, "no error")] : []),
    ...[...sum.bins]
      .filter(([, n]) => n > 0)
      .map(([exponent, n]) => bar(exponent, n, `${power(exponent)} to ${power(exponent + 1)}`)),
  ];
}

export function histograms(report, looks) {
  const units = UNITS.filter(([unit]) => report.cells.some((c) => c[unit] && !c.skipped));
  if (!units.length) return null;
  const redraw = () => made.redraw();
  const groups = groupChoices(report.cells, redraw, { all: true });
  const unit = choice("Error in", units, redraw);

  function draw(width) {
    const cells = report.cells.filter((c) => !c.skipped && c[unit.value] && inGroup(c, groups));
    const sums = [...Map.groupBy(cells, (c) => c.engine)]
      .map(([engine, its]) => ({ engine, sum: pooled(its.map((c) => c[unit.value])) }))
      .filter(({ sum }) => sum.total > 0);
    if (!sums.length) return null;
    const exponents = sums.flatMap(({ sum }) => [...sum.bins].filter(([, n]) => n).map(([e]) => e));
    const leftmost = exponents.length ? Math.min(...exponents) : 0;
    const bars = sums.flatMap(({ engine, sum }) => barsOf(engine, sum, leftmost));
    const floor = Math.min(...bars.map((b) => b.share)) / 3;
    const unitText = units.find(([value]) => value === unit.value)[1];
    const ticks = ticksOf(
      leftmost,
      exponents.length ? Math.max(...exponents) + 1 : 1,
      bars.some((b) => b.at < leftmost),
      width,
    );
    const svg = plot({
      width,
      height: 60 + 92 * sums.length,
      x: {
        type: "linear",
        domain: [leftmost - 2.2, Math.max(leftmost, ...exponents) + 1.2],
        ticks,
        tickFormat: (t) => (t < leftmost ? "0" : power(t)),
        label: `error of the time [${unitText}]`,
        labelAnchor: "center",
      },
      y: logAxis("share of right hits", [floor, 1], 3, { air: 1 }),
      fy: { domain: sums.map((s) => s.engine), axis: null, padding: 0.12 },
      marks: [
        Plot.frame({ strokeOpacity: 0.2 }),
        Plot.rect(bars, {
          fy: "engine",
          x1: "at",
          x2: (b) => b.at + 1,
          y1: floor,
          y2: "share",
          fill: (b) => looks.get(b.engine).colour,
          fillOpacity: (b) => (b.at < leftmost ? 0.55 : 0.9),
          insetLeft: 0.5,
          insetRight: 0.5,
        }),
        Plot.text(sums, {
          fy: "engine",
          text: (s) =>
            shortened(s.engine, 24) +
            (width < 480 ? "" : ` · 99 %: ${number(s.sum.p99)} · max: ${number(s.sum.max)}`),
          frameAnchor: "top-right",
          dx: -6,
          dy: 5,
          fontWeight: 600,
          stroke: "var(--surface)",
          strokeWidth: 4,
          fill: "currentColor",
        }),
      ],
    });
    return { svg, ...shown(svg, bars, sums, unitText, leftmost) };
  }

  const made = chart({
    name: "error-histograms",
    title: "How well the times are known",
    note: "Errors of the times of right hits, in steps of a factor of two; the bar at 0 are times without any error. The last bars are what to look at: a good engine has no tail to the right.",
    controls: [...groups.elements, unit.element],
    draw,
  });
  return made.element;
}

// Powers of two at a distance at which labels have room.
function ticksOf(from, to, withZero, width) {
  const step = Math.max(1, Math.ceil((to - from) / (width / 60)));
  const ticks = withZero ? [from - 1.5] : [];
  for (let t = Math.ceil(from / step) * step; t <= to; t += step) ticks.push(t);
  return ticks;
}

function shown(svg, bars, sums, unitText, leftmost) {
  const [sx, sy, sf] = [svg.scale("x"), svg.scale("y"), svg.scale("fy")];
  const top = sf.apply(sums[0].engine);
  return {
    points: bars.map((b) => ({
      x: sx.apply(b.at + 0.5),
      y: sy.apply(b.share) + sf.apply(b.engine) - top,
      key: null,
      lines: [
        b.engine,
        b.at < leftmost ? b.text : `error ${b.text} ${unitText}`,
        `${percent(b.share)} of right hits`,
        count(b.count),
      ],
    })),
    legend: [],
    summary: `Errors of the time in ${unitText}. ${sums.map((s) => `${s.engine}: 99 % below ${number(s.sum.p99)}, at most ${number(s.sum.max)}`).join("; ")}.`,
    numbers: {
      columns: ["engine", `error [${unitText}]`, "hits", "share"],
      rows: bars.map((b) => [b.engine, b.text, b.count, b.share]),
    },
  };
}
