// How long trajectories stay right: the share that agrees with the certified ones, by collision.
import * as Plot from "@observablehq/plot";
import { chart, plot } from "../chart.js";
import { choice } from "../controls.js";
import { isNumber, number, percent } from "../numbers.js";

const nameOf = (curve) =>
  isNumber(curve.radius) ? `${curve.scene}, r = ${number(curve.radius)}` : curve.scene;

export function survival(report, looks) {
  const curves = (report.survival ?? []).filter((c) => c.points?.length);
  if (!curves.length) return null;
  const places = [...new Set(curves.map(nameOf))];
  const place = choice(
    "Scene",
    places.map((p) => [p, p]),
    () => made.redraw(),
  );

  function draw(width) {
    const chosen = curves.filter((c) => nameOf(c) === place.value);
    const points = chosen.flatMap((curve) => curve.points.map((p) => ({ ...p, engine: curve.engine })));
    const colour = (p) => looks.get(p.engine).colour;
    const svg = plot({
      width,
      height: Math.max(280, Math.min(400, 0.6 * width)),
      x: { grid: true, label: "collisions", labelAnchor: "center" },
      y: {
        grid: true,
        domain: [0, 1],
        label: "share of trajectories that are still right",
        tickFormat: "%",
        labelAnchor: "center",
      },
      marks: [
        Plot.areaY(
          points.filter((p) => p.low !== undefined && p.high !== undefined),
          { x: "collisions", y1: "low", y2: "high", z: "engine", fill: colour, fillOpacity: 0.15 },
        ),
        chosen.map((curve) =>
          Plot.line(curve.points, {
            x: "collisions",
            y: "share",
            stroke: looks.get(curve.engine).colour,
            strokeDasharray: looks.get(curve.engine).dash || null,
          }),
        ),
        Plot.dot(points, {
          x: "collisions",
          y: "share",
          r: 3,
          symbol: (p) => looks.get(p.engine).symbol,
          fill: colour,
        }),
      ],
    });
    const [sx, sy] = [svg.scale("x"), svg.scale("y")];
    return {
      svg,
      points: points.map((p) => ({
        x: sx.apply(p.collisions),
        y: sy.apply(p.share),
        key: null,
        lines: [
          p.engine,
          `after ${p.collisions} collisions`,
          `${percent(p.share)} still right`,
          `95 %: ${percent(p.low)} to ${percent(p.high)}`,
        ],
      })),
      legend: [...new Set(chosen.map((c) => c.engine))].map((name) => ({ name, look: looks.get(name) })),
      summary: `Share of trajectories that still follow the certified one, in ${place.value}. ${chosen
        .map((c) => {
          const half = c.points.find((p) => p.share < 0.5);
          return `${c.engine}: ${half ? `below a half from collision ${half.collisions} on` : "above a half throughout"}`;
        })
        .join("; ")}.`,
      numbers: {
        columns: ["engine", "collisions", "share", "low", "high"],
        rows: points.map((p) => [p.engine, p.collisions, p.share, p.low, p.high]),
      },
    };
  }
  const made = chart({
    name: "survival",
    title: "How long trajectories stay right",
    controls: [place.element],
    draw,
    legendLines: true,
  });
  return made.element;
}
