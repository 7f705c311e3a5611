// The cost of a query as obstacles shrink: time against radius, with a power law through each engine's
// points.
import * as Plot from "@observablehq/plot";
import { h } from "../dom.js";
import { chart, logAxis, plot } from "../chart.js";
import { choice } from "../controls.js";
import { followCells, groupChoices, inGroup, nameOfCell } from "../cells.js";
import { swatch } from "../engines.js";
import { duration, isNumber, number } from "../numbers.js";
import { powerLaw } from "../statistics.js";

const COSTS = [
  {
    value: "ns",
    text: "time",
    axis: "time a query",
    show: duration,
    of: (c) => c.ns?.median,
    low: (c) => c.ns?.q1,
    high: (c) => c.ns?.q3,
  },
];

const signed = (value) => value.toFixed(3).replace("-", "−");
const interval = (fit) => (fit.low === null ? "" : ` (95 %: ${signed(fit.low)} to ${signed(fit.high)})`);
const fitText = (fit) => (fit ? `r^${signed(fit.exponent)}${interval(fit)}` : "no fit: one radius");

// At larger radii the obstacles, not the space between them, determine the time: they count only if fewer than three
// are small.
const SMALL = 0.01;

function fitsOf(points) {
  return [...Map.groupBy(points, (p) => p.cell.engine)].map(([engine, members]) => {
    const small = members.filter((p) => p.x <= SMALL);
    const fitted = new Set(small.map((p) => p.x)).size < 3 ? members : small;
    const radii = fitted.map((p) => p.x);
    return {
      engine,
      fit: powerLaw(fitted.map((p) => [p.x, p.y])),
      ends: [Math.min(...radii), Math.max(...radii)],
    };
  });
}

export function timeRadius(report, looks) {
  const cells = report.cells.filter((c) => !c.skipped && c.radius > 0 && c.ns?.median > 0);
  if (new Set(cells.map((c) => c.radius)).size < 2) return null;
  const redraw = () => made.redraw();
  const groups = groupChoices(cells, redraw, { radii: false });
  const kind = choice(
    "Cost",
    COSTS.filter((k) => cells.some((c) => k.of(c) > 0)).map((k) => [k.value, k.text]),
    redraw,
  );

  function draw(width) {
    const cost = COSTS.find((k) => k.value === kind.value);
    const points = cells
      .filter((c) => inGroup(c, groups) && cost.of(c) > 0)
      .map((cell) => ({
        cell,
        x: cell.radius,
        y: cost.of(cell),
        low: cost.low(cell) ?? null,
        high: cost.high(cell) ?? null,
      }));
    if (!points.length) return null;
    const fits = fitsOf(points),
      look = (p) => looks.get(p.cell.engine);
    const svg = plot({
      width,
      height: Math.max(300, Math.min(430, 0.62 * width)),
      x: {
        ...logAxis(
          "radius r",
          points.map((p) => p.x),
          width / 80,
          { air: 1.4 },
        ),
        reverse: true,
      },
      y: logAxis(
        cost.axis,
        points.flatMap((p) => [p.y, p.low || p.y, p.high || p.y]),
        7,
        { show: cost.show },
      ),
      marks: [
        fits
          .filter((f) => f.fit)
          .map((f) =>
            Plot.line(
              f.ends.map((r) => [r, f.fit.factor * r ** f.fit.exponent]),
              {
                stroke: looks.get(f.engine).colour,
                strokeDasharray: looks.get(f.engine).dash || null,
                strokeWidth: 1.6,
              },
            ),
          ),
        Plot.ruleX(
          points.filter((p) => p.low > 0 && p.high > 0),
          {
            x: "x",
            y1: "low",
            y2: "high",
            stroke: (p) => look(p).colour,
            strokeWidth: 3,
            strokeOpacity: 0.35,
          },
        ),
        Plot.dot(points, {
          x: "x",
          y: "y",
          symbol: (p) => look(p).symbol,
          r: 5,
          fill: (p) => look(p).colour,
        }),
      ],
    });
    return { svg, fits, ...shown(svg, points, fits, cost, looks) };
  }

  const made = chart({
    name: "time-against-radius",
    title: "Time against radius",
    legendLines: true,
    note: "Obstacles shrink to the right. The exponent of each engine's power law is that of the fit: 0 means that small obstacles cost no more. Bars: the quartiles.",
    controls: [...groups.elements, kind.element],
    draw,
    below: (drawn) => fitTable(drawn.fits, looks),
  });
  followCells(report, cells, groups, redraw);
  return made.element;
}

function shown(svg, points, fits, cost, looks) {
  const [sx, sy] = [svg.scale("x"), svg.scale("y")];
  const fitOf = (engine) => fits.find((f) => f.engine === engine).fit;
  return {
    points: points.map((p) => ({
      x: sx.apply(p.x),
      y: sy.apply(p.y),
      key: p.cell.key,
      lines: [
        p.cell.engine,
        nameOfCell(p.cell),
        `${cost.show(p.y)} a query`,
        ...(isNumber(p.low) ? [`quartiles ${cost.show(p.low)} and ${cost.show(p.high)}`] : []),
        `fit: ${fitText(fitOf(p.cell.engine))}`,
      ],
    })),
    legend: fits.map((f) => ({
      name: f.engine,
      look: looks.get(f.engine),
      note: f.fit ? `r^${signed(f.fit.exponent)}` : "",
    })),
    summary: `${cost.axis} against the radius. Fitted: ${fits.map((f) => `${f.engine} ${fitText(f.fit)}`).join("; ")}.`,
    numbers: {
      columns: [
        "engine",
        "scene",
        "difficulty",
        "radius",
        cost.axis,
        "lower quartile",
        "upper quartile",
        "fitted exponent",
        "exponent low",
        "exponent high",
      ],
      rows: points.map((p) => [
        p.cell.engine,
        p.cell.scene,
        p.cell.difficulty,
        p.x,
        p.y,
        p.low,
        p.high,
        fitOf(p.cell.engine)?.exponent,
        fitOf(p.cell.engine)?.low,
        fitOf(p.cell.engine)?.high,
      ]),
    },
  };
}

function fitTable(fits, looks) {
  return h(
    "div",
    { class: "scroll", role: "region", tabindex: 0, "aria-label": "Fitted exponents" },
    h(
      "table",
      { class: "fits" },
      h("caption", { class: "unseen" }, "Fitted exponents of the time in r"),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ["engine", "exponent", "95 % interval", "of radii"].map((name, i) =>
            h("th", { scope: "col", class: i ? "figure" : null }, name),
          ),
        ),
      ),
      h(
        "tbody",
        {},
        fits.map(({ engine, fit, ends }) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, swatch(looks.get(engine)), engine),
            h("td", { class: "figure" }, fit ? signed(fit.exponent) : "–"),
            h(
              "td",
              { class: "figure" },
              fit && fit.low !== null ? `${signed(fit.low)} … ${signed(fit.high)}` : "–",
            ),
            h("td", { class: "figure" }, fit ? ends.map((r) => number(r)).join(" … ") : "–"),
          ),
        ),
      ),
    ),
  );
}
