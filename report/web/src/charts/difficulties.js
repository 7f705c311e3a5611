// Where an engine fails: for each kind of query, the shares of answers that are not right.
import * as Plot from "@observablehq/plot";
import { shortened } from "../dom.js";
import { chart, logAxis, plot } from "../chart.js";
import { count, percent } from "../numbers.js";
import { FAULTS, verdictOf } from "../verdicts.js";

export function difficultiesChart(report) {
  const rows = (report.difficulties ?? []).filter((row) => row.queries > (row.unsupported ?? 0));
  const points = rows.flatMap((row) =>
    FAULTS.filter(([key]) => row[key] > 0 && row.queries > 0).map(([key, verdict]) => ({
      row,
      verdict: verdictOf(verdict),
      count: row[key],
      share: row[key] / row.queries,
    })),
  );
  if (!points.length) return null;

  function draw(width) {
    const names = rows.map((row) => row.name);
    const letters = Math.floor(Math.min(190, 0.36 * width) / 6.6);
    const svg = plot({
      width,
      height: 56 + 26 * names.length,
      marginLeft: 14 + 6.6 * Math.min(letters, Math.max(...names.map((n) => n.length))),
      x: logAxis(
        "share of the queries",
        points.map((p) => p.share),
        width / 110,
        { air: 2 },
      ),
      y: {
        type: "band",
        domain: names,
        label: null,
        tickFormat: (name) => shortened(name, letters),
        tickSize: 0,
      },
      marks: [
        Plot.ruleY(names, { y: (n) => n, strokeOpacity: 0.12 }),
        Plot.dot(points, {
          x: "share",
          y: (p) => p.row.name,
          r: 6,
          symbol: (p) => p.verdict.symbol,
          fill: (p) => p.verdict.colour,
        }),
      ],
    });
    const [sx, sy] = [svg.scale("x"), svg.scale("y")];
    const seen = [...new Set(points.map((p) => p.verdict))];
    return {
      svg,
      points: points.map((p) => ({
        x: sx.apply(p.share),
        y: sy.apply(p.row.name) + sy.bandwidth / 2,
        key: p.row.key,
        lines: [
          p.row.name,
          `${percent(p.share)} ${p.verdict.word}`,
          `${count(p.count)} of ${count(p.row.queries)} queries`,
        ],
      })),
      legend: seen.map((v) => ({ name: v.word, look: { colour: v.colour, symbol: v.symbol, dash: "" } })),
      summary: `Answered without a fault: ${rows.filter((r) => FAULTS.every(([key]) => !r[key])).length} of ${names.length} kinds of query that it was asked. The most that is wrong: ${worst(rows)}.`,
      numbers: {
        columns: ["difficulty", "verdict", "count", "queries", "share"],
        rows: points.map((p) => [p.row.name, p.verdict.word, p.count, p.row.queries, p.share]),
      },
    };
  }
  return chart({
    name: "difficulties",
    title: "Where it fails",
    note: "Each line is a kind of query; further right is worse. No mark: there was none.",
    draw,
  }).element;
}

function worst(rows) {
  const wrong = rows.filter((r) => r.wrong > 0).sort((a, b) => b.wrong / b.queries - a.wrong / a.queries)[0];
  return wrong ? `${wrong.name}, ${percent(wrong.wrong / wrong.queries)}` : "nothing";
}
