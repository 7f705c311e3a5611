// Speed against error: each cell is a point; the front has the points that no other beats in both.
import * as Plot from "@observablehq/plot";
import { chart, logAxis, plot } from "../chart.js";
import { choice } from "../controls.js";
import { followCells, groupChoices, inGroup, nameOfCell } from "../cells.js";
import { putLabels } from "../labels.js";
import { duration, isNumber, number, percent } from "../numbers.js";
import { paretoFront } from "../statistics.js";

const share = (key, word) => ({
  value: key,
  text: `share ${word}`,
  axis: `share ${word}`,
  of: (cell) =>
    cell[key] && cell.queries > 0
      ? {
          y: cell[key].count / cell.queries,
          low: cell[key].low,
          high: cell[key].high,
          text: `${percent(cell[key].count / cell.queries)} ${word} (95 %: ${percent(cell[key].low)} to ${percent(cell[key].high)}; ${cell[key].count} of ${cell.queries})`,
        }
      : null,
});

const ofTimes = (histogram, key, text, unit) => ({
  value: `${histogram}.${key}`,
  text,
  axis: `${text} [${unit}]`,
  of: (cell) =>
    isNumber(cell[histogram]?.[key])
      ? { y: cell[histogram][key], text: `${text}: ${number(cell[histogram][key])} ${unit}` }
      : null,
});

const ERRORS = [
  share("wrong", "wrong"),
  ofTimes("ulps", "p99", "99 % of the times err by less than", "ulps"),
  ofTimes("ulps", "max", "largest error of a time", "ulps"),
  ofTimes("conditions", "p99", "99 % of the times err by less than, by condition", "conditions"),
  share("undecided", "undecided"),
  share("ill_posed", "ill-posed"),
  share("wrong_time", "wrong in time"),
];

// If no fault was seen, the mark is at the upper bound of the share. An error of 0 is at the lower edge.
function pointsOf(cells, error) {
  const points = cells.flatMap((cell) => {
    const value = error.of(cell);
    return value && isNumber(cell.ns?.median)
      ? [{ cell, x: cell.ns.median, ...value, none: value.y === 0 }]
      : [];
  });
  const floor = Math.min(...points.map((p) => p.y || Infinity), 1e300) / 3;
  for (const point of points) if (point.none) point.y = point.high ?? floor;
  return points;
}

const groupOf = ({ scene, radius, difficulty }) => JSON.stringify([scene, radius, difficulty]);

function frontsOf(points) {
  const groups = Map.groupBy(points, (point) => groupOf(point.cell));
  return [...groups].flatMap(([group, members]) =>
    paretoFront(members).map((p) => ({ x: p.x, y: p.y, group, cell: p.cell })),
  );
}

export function speedError(report, looks) {
  const cells = report.cells.filter((cell) => !cell.skipped && isNumber(cell.ns?.median));
  const errors = ERRORS.filter((error) => cells.some((cell) => error.of(cell)));
  if (!cells.length || !errors.length) return null;
  const redraw = () => made.redraw();
  const groups = groupChoices(cells, redraw);
  const kind = choice(
    "Error",
    errors.map((e) => [e.value, e.text]),
    redraw,
  );

  function draw(width) {
    const error = errors.find((e) => e.value === kind.value) ?? errors[0];
    const points = pointsOf(
      cells.filter((cell) => inGroup(cell, groups)),
      error,
    );
    if (!points.length) return null;
    const front = frontsOf(points),
      single = new Set(front.map((p) => p.group)).size === 1;
    const x = logAxis(
      "time a query",
      points.map((p) => p.x),
      width / 80,
      { show: duration },
    );
    const y = logAxis(
      error.axis,
      points.flatMap((p) => [p.y, p.low || p.y, p.high || p.y]),
      7,
    );
    const look = (p) => looks.get(p.cell.engine);
    const svg = plot({
      width,
      height: Math.max(300, Math.min(430, 0.62 * width)),
      x,
      y,
      marks: [
        Plot.line(front, {
          x: "x",
          y: "y",
          z: "group",
          curve: "step-after",
          stroke: "var(--front)",
          strokeWidth: single ? 2 : 1,
          strokeOpacity: single ? 0.9 : 0.35,
        }),
        Plot.ruleX(
          points.filter((p) => p.high),
          {
            x: "x",
            y1: (p) => p.low || y.domain[0],
            y2: "high",
            stroke: (p) => look(p).colour,
            strokeOpacity: single ? 0.6 : 0.25,
          },
        ),
        Plot.dot(points, {
          x: "x",
          y: "y",
          symbol: (p) => look(p).symbol,
          r: 6,
          fill: (p) => (p.none ? "var(--surface)" : look(p).colour),
          stroke: (p) => look(p).colour,
          strokeWidth: 1.8,
        }),
      ],
    });
    const drawn = { svg, ...shown(svg, points, front, error, looks) };
    if (single)
      putLabels(
        svg,
        drawn.points.map((p) => ({ x: p.x, y: p.y, text: p.lines[0] })),
        { x: 62, y: 4, width: width - 66 },
      );
    return drawn;
  }

  const made = chart({
    name: "speed-against-error",
    title: "Speed against error",
    note: "Left is faster, low is better. The line is the Pareto front: no engine beats those on it in both. An open mark: none seen; it stands at the 95 % bound.",
    controls: [...groups.elements, kind.element],
    draw,
  });
  followCells(report, cells, groups, redraw);
  return made.element;
}

function shown(svg, points, front, error, looks) {
  const [sx, sy] = [svg.scale("x"), svg.scale("y")];
  const engines = [...new Set(points.map((p) => p.cell.engine))];
  const best = new Set(front.map((p) => p.cell));
  return {
    points: points.map((p) => ({
      x: sx.apply(p.x),
      y: sy.apply(p.y),
      key: p.cell.key,
      lines: [
        p.cell.engine,
        nameOfCell(p.cell),
        `${duration(p.x)} a query`,
        p.text,
        ...(best.has(p.cell) ? ["on the front"] : []),
      ],
    })),
    legend: engines.map((name) => ({ name, look: looks.get(name) })),
    summary: `${error.axis} against the time a query takes, of ${engines.join(", ")}. On the front: ${[...new Set(front.map((p) => p.cell.engine))].join(", ")}.`,
    numbers: {
      columns: ["engine", "scene", "radius", "difficulty", "ns", error.axis, "low", "high", "on the front"],
      rows: points.map((p) => [
        p.cell.engine,
        p.cell.scene,
        p.cell.radius,
        p.cell.difficulty,
        p.x,
        p.none ? 0 : p.y,
        p.low,
        p.high,
        best.has(p.cell) ? "yes" : "no",
      ]),
    },
  };
}
