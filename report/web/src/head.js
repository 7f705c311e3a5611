// The verdict first, in three lines or in one, then the figures on which it rests.
import { h } from "./dom.js";
import { drawing } from "./drawing.js";
import { count, duration, isNumber, percent } from "./numbers.js";
import { FAULTS, MEANINGS, verdictOf } from "./verdicts.js";

export function head(report) {
  const state = report.verdict ? verdictOf(report.verdict) : null;
  return h(
    "header",
    { class: `head ${report.verdict ?? report.kind ?? ""}` },
    h(
      "p",
      { class: "eyebrow" },
      [`lorentz ${report.kind ?? "report"}`, report.manifest?.date].filter(Boolean).join(" · "),
    ),
    h(
      "h1",
      {},
      state &&
        h(
          "span",
          { class: "badge", style: `--tone: ${state.colour}` },
          h("span", { "aria-hidden": "true" }, `${state.sign} `),
          state.word,
        ),
      " ",
      report.library ?? (report.engine ? h("code", {}, report.engine) : (report.title ?? "Report")),
    ),
    report.summary ? threeLines(report) : verdictLine(report.line || benchLine(report)),
    figures(report),
    report.summary &&
      report.line &&
      h("details", { class: "in-full" }, h("summary", {}, "The verdict in full"), verdictLine(report.line)),
  );
}

const verdictLine = (line) => h("p", { class: "verdict-line" }, line);

// What was judged, how bad it is, and the worst fault, with a drawing of its simplest case.
function threeLines({ summary, findings }) {
  const worst = findings?.[summary.finding];
  const picture = worst?.drawing && drawing(worst.drawing, `The simplest case: ${summary.worst}`);
  const lines = [
    ["What", summary.what],
    ["How bad", summary.how_bad],
    ["Worst", summary.worst],
    ...(summary.next ?? []).map((step) => ["Next", step]),
  ];
  return h(
    "div",
    { class: picture ? "first with-picture" : "first" },
    h(
      "dl",
      { class: "three-lines" },
      lines.map(([name, text]) => h("div", {}, h("dt", {}, name), h("dd", {}, text))),
    ),
    picture && h("div", { class: "paper" }, picture),
  );
}

// "Nothing wrong was seen of a, b. Wrong answers: c (3)."
function benchLine(report) {
  const cells = (report.cells ?? []).filter((c) => !c.skipped);
  if (!cells.length) return "";
  const engines = [...Map.groupBy(cells, (c) => c.engine)].map(([name, its]) => ({
    name,
    wrong: its.reduce((sum, c) => sum + (c.wrong?.count ?? 0), 0),
  }));
  const good = engines.filter((e) => e.wrong === 0).map((e) => e.name);
  const bad = engines.filter((e) => e.wrong > 0).map((e) => `${e.name} (${count(e.wrong)})`);
  if (!good.length) return "Every engine was wrong somewhere.";
  return `Nothing wrong was seen of ${good.join(", ")}.${bad.length ? ` Wrong answers: ${bad.join(", ")}.` : ""}`;
}

function figures(report) {
  const tile = (value, name, hint, tone) =>
    h(
      "div",
      { class: "tile", style: tone ? `--tone: ${tone}` : null, title: hint ?? null },
      h("dt", {}, name),
      h("dd", {}, value),
    );
  const tiles = [],
    judged = report.queries - (report.unsupported ?? 0);
  if (isNumber(report.queries)) tiles.push(tile(count(report.queries), "queries"));
  for (const [key, verdict] of FAULTS)
    if (isNumber(report[key])) {
      const share = judged && report[key] ? ` (${percent(report[key] / judged)})` : "";
      tiles.push(
        tile(
          h("span", {}, count(report[key]), h("small", {}, share)),
          verdictOf(verdict).word,
          MEANINGS[verdict],
          report[key] ? verdictOf(verdict).colour : null,
        ),
      );
    }
  if (report.nonsense > 0)
    tiles.push(tile(count(report.nonsense), "nonsense", MEANINGS.nonsense, verdictOf("nonsense").colour));
  if (isNumber(report.ns_per_query)) tiles.push(tile(duration(report.ns_per_query), "time a query"));
  if (isNumber(report.processor_ns_per_query))
    tiles.push(
      tile(
        duration(report.processor_ns_per_query),
        "processor time",
        "a query, of processors; the other time is that of the wall",
      ),
    );
  if (!tiles.length && report.cells?.length) {
    tiles.push(
      tile(String(new Set(report.cells.map((c) => c.engine)).size), "engines"),
      tile(count(report.cells.length), "cells"),
      tile(count(report.cells.reduce((sum, c) => sum + (c.queries ?? 0), 0)), "queries"),
    );
    const skipped = report.cells.filter((c) => c.skipped).length;
    if (skipped) tiles.push(tile(count(skipped), "cells skipped"));
  }
  return tiles.length ? h("dl", { class: "tiles" }, tiles) : null;
}
