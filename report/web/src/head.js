// The verdict first, in one line, then the figures it rests on.
import { h } from "./dom.js";
import { count, duration, isNumber, percent } from "./numbers.js";
import { FAULTS, MEANINGS, verdictOf } from "./verdicts.js";

const WORDS = {
  right: "gives right answers",
  wrong: "gives wrong answers",
  "ill-posed": "is right but where the question itself is ill-posed",
  undecided: "is right where it answers, and does not always answer",
  broken: "is broken",
};

export function head(report) {
  const engine = report.engine;
  const says =
    report.verdict === "right" && report.wrong_time > 0
      ? "names the right obstacles, some of them at wrong times"
      : (WORDS[report.verdict] ?? "");
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
      engine ? [h("code", {}, engine), ` ${says}`] : (report.title ?? "Report"),
    ),
    h("p", { class: "verdict-line" }, report.line || benchLine(report)),
    figures(report),
  );
}

// "5 engines in 40 cells. Nothing wrong was seen of a, b; the fastest of these is a (812 ns a query)."
function benchLine(report) {
  const cells = (report.cells ?? []).filter((c) => !c.skipped);
  if (!cells.length) return "";
  const engines = [...Map.groupBy(cells, (c) => c.engine)].map(([name, its]) => ({
    name,
    wrong: its.reduce((sum, c) => sum + (c.wrong?.count ?? 0), 0),
    ns: geometricMean(its.map((c) => c.ns?.median)),
  }));
  const good = engines.filter((e) => e.wrong === 0).sort((a, b) => a.ns - b.ns);
  const bad = engines.filter((e) => e.wrong > 0).map((e) => `${e.name} (${count(e.wrong)})`);
  return [
    good.length
      ? `Nothing wrong was seen of ${good.map((e) => e.name).join(", ")}`
      : "Every engine was wrong somewhere",
    good.length > 1 && isNumber(good[0].ns)
      ? `; the fastest of these is ${good[0].name}, ${duration(good[0].ns)} a query`
      : "",
    bad.length && good.length ? `. Wrong answers: ${bad.join(", ")}` : "",
    ".",
  ].join("");
}

function geometricMean(values) {
  const logs = values.filter((v) => v > 0).map(Math.log);
  return logs.length ? Math.exp(logs.reduce((a, b) => a + b, 0) / logs.length) : NaN;
}

function figures(report) {
  const tile = (value, name, hint, tone) =>
    h(
      "div",
      { class: "tile", style: tone ? `--tone: ${tone}` : null, title: hint ?? null },
      h("dt", {}, name),
      h("dd", {}, value),
    );
  const tiles = [];
  if (isNumber(report.queries)) tiles.push(tile(count(report.queries), "queries"));
  for (const [key, verdict] of FAULTS)
    if (isNumber(report[key])) {
      const share = report.queries && report[key] ? ` (${percent(report[key] / report.queries)})` : "";
      tiles.push(
        tile(
          h("span", {}, count(report[key]), h("small", {}, share)),
          verdictOf(verdict).word,
          MEANINGS[verdict],
          report[key] ? verdictOf(verdict).colour : null,
        ),
      );
    }
  for (const key of ["missing", "nonsense"])
    if (report[key] > 0)
      tiles.push(tile(count(report[key]), verdictOf(key).word, MEANINGS[key], verdictOf(key).colour));
  if (isNumber(report.ns_per_query)) tiles.push(tile(duration(report.ns_per_query), "time a query"));
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
