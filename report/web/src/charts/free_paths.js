// The distribution of free paths: the share that is longer than t, and theory where there is some.
import * as Plot from "@observablehq/plot";
import { chart, logAxis, plot } from "../chart.js";
import { looksOf } from "../engines.js";
import { number, percent } from "../numbers.js";

const nameOf = (curve) => `${curve.scene}, r = ${number(curve.radius)}`;

export function freePaths(report) {
  const curves = (report.free_paths ?? []).filter((c) => c.points?.length);
  if (!curves.length) return null;
  const looks = looksOf(curves.map(nameOf));

  function draw(width) {
    const points = curves.flatMap((c) =>
      c.points.filter((p) => p.t > 0 && p.survival > 0).map((p) => ({ ...p, name: nameOf(c) })),
    );
    const theory = points.filter((p) => p.theory > 0);
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
          ...(p.theory > 0 ? [`theory: ${percent(p.theory)}`] : []),
        ],
      })),
      legend: curves.map((c) => ({ name: nameOf(c), look: looks.get(nameOf(c)) })),
      summary: `Share of free paths longer than t, in ${curves.map(nameOf).join("; ")}.${theory.length ? " Dashed: theory." : ""}`,
      numbers: {
        columns: ["scene", "t", "share longer", "theory"],
        rows: points.map((p) => [p.name, p.t, p.survival, p.theory]),
      },
    };
  }
  return chart({ name: "free-paths", title: "Free paths", draw }).element;
}
