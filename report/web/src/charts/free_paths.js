// The distribution of free paths: the share longer than t, with theory if there is one.
import * as Plot from "@observablehq/plot";
import { chart, logAxis, plot } from "../chart.js";
import { looksOf } from "../engines.js";
import { isNumber, number, percent } from "../numbers.js";

const nameOf = (curve) =>
  isNumber(curve.radius) ? `${curve.scene}, r = ${number(curve.radius)}` : curve.scene;

export function freePaths(report) {
  const curves = (report.free_paths ?? []).filter((c) => c.points?.length);
  if (!curves.length) return null;
  const looks = looksOf(curves.map(nameOf));
  const laws = [...new Set(curves.map((c) => c.law).filter(Boolean))];

  function draw(width) {
    const points = curves.flatMap((c) =>
      c.points.filter((p) => p.t > 0 && p.survival > 0).map((p) => ({ ...p, name: nameOf(c) })),
    );
    // Theory also exists beyond the flights, so it is cut where there are none to draw.
    const least = Math.min(...points.map((p) => p.survival)) / 1.6;
    const theory = points.filter((p) => p.theory > least),
      exact = points.filter((p) => p.exact > least);
    if (!points.length) return null;
    const svg = plot({
      width,
      height: Math.max(280, Math.min(400, 0.6 * width)),
      x: logAxis(
        "t",
        points.map((p) => p.t),
        width / 80,
      ),
      y: logAxis(
        "share of free paths longer than t",
        points.map((p) => p.survival),
        7,
      ),
      marks: [
        Plot.line(exact, { x: "t", y: "exact", z: "name", stroke: (p) => looks.get(p.name).colour }),
        Plot.line(theory, {
          x: "t",
          y: "theory",
          z: "name",
          stroke: (p) => looks.get(p.name).colour,
          strokeDasharray: "6 3",
        }),
        Plot.dot(points, {
          x: "t",
          y: "survival",
          r: 3.5,
          symbol: (p) => looks.get(p.name).symbol,
          fill: (p) => looks.get(p.name).colour,
        }),
      ],
    });
    const [sx, sy] = [svg.scale("x"), svg.scale("y")];
    return {
      svg,
      points: points.map((p) => ({
        x: sx.apply(p.t),
        y: sy.apply(p.survival),
        key: null,
        lines: [
          p.name,
          `longer than ${number(p.t)}: ${percent(p.survival)}`,
          ...(isNumber(p.exact) ? [`exact, of the same flights: ${percent(p.exact)}`] : []),
          ...(p.theory > 0 ? [`theory: ${percent(p.theory)}`] : []),
        ],
      })),
      legend: curves.map((c) => ({ name: nameOf(c), look: looks.get(nameOf(c)) })),
      summary: `Share of free paths longer than t, in ${curves.map(nameOf).join("; ")}.${said(points, exact)}${theory.length ? ` Dashed: theory${laws.length ? ` (${laws.join("; ")})` : ""}.` : ""}`,
      numbers: {
        columns: ["scene", "t", "share longer", "exact", "theory"],
        rows: points.map((p) => [p.name, p.t, p.survival, p.exact, p.theory]),
      },
    };
  }
  return chart({ name: "free-paths", title: "Free paths", draw }).element;
}

// How far the engine's shares are from the exact ones of the same flights.
function said(points, exact) {
  if (!exact.length) return "";
  const apart = (p) => Math.abs(p.survival - p.exact);
  const farthest = points.filter((p) => isNumber(p.exact)).reduce((a, b) => (apart(b) > apart(a) ? b : a));
  return apart(farthest) === 0
    ? " Line: the exact ones of the same flights, and the engine's are the same."
    : ` Line: the exact ones of the same flights; the engine's are farthest from them at t = ${number(farthest.t)} in ${farthest.name}: ${percent(farthest.survival)} instead of ${percent(farthest.exact)}.`;
}
