// Table of failures: engines by difficulty (from cells), or causes by place (from findings).
import { h, section } from "./dom.js";
import { swatch } from "./engines.js";
import { placeOf } from "./findings.js";
import { count, percent } from "./numbers.js";

const MOST_ROWS = 30,
  MOST_COLUMNS = 10;

// Darker for more, on a logarithmic scale; the number itself is shown as well.
const shade = (share) =>
  share > 0 ? `--share: ${Math.round(25 + 75 * Math.max(0, 1 + Math.log10(share) / 6))}%` : null;

function matrix(caption, corner, columns, rows) {
  return h(
    "div",
    { class: "scroll", role: "region", tabindex: 0, "aria-label": caption },
    h(
      "table",
      { class: "matrix stacked" },
      h("caption", { class: "unseen" }, caption),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", { scope: "col" }, corner),
          columns.map((c) => h("th", { scope: "col", class: "figure" }, c)),
        ),
      ),
      h(
        "tbody",
        {},
        rows.map(({ name, cells }) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, name),
            cells.map((c, i) =>
              h(
                "td",
                {
                  class: `figure ${c ? (c.bad ? "bad" : "good") : ""}`,
                  style: c ? shade(c.share) : null,
                  title: c?.hint ?? null,
                  "data-name": columns[i],
                },
                c ? c.text : "–",
              ),
            ),
          ),
        ),
      ),
    ),
  );
}

function ofCells(cells, looks) {
  const difficulties = [...new Set(cells.map((c) => c.difficulty))];
  const rows = [...Map.groupBy(cells, (c) => c.engine)].map(([engine, its]) => ({
    name: h("span", {}, swatch(looks.get(engine)), engine),
    cells: difficulties.map((d) => wrongIn(its.filter((c) => c.difficulty === d && c.wrong && c.queries))),
  }));
  return matrix("Share of wrong answers by engine and difficulty", "engine", difficulties, rows);
}

function wrongIn(cells) {
  if (!cells.length) return null;
  const sum = (key) => cells.reduce((s, c) => s + (c[key]?.count ?? 0), 0);
  const queries = cells.reduce((s, c) => s + c.queries, 0),
    wrong = sum("wrong");
  const undecided = sum("undecided");
  return {
    share: wrong / queries,
    bad: wrong > 0,
    text: wrong ? `✗ ${percent(wrong / queries)}` : undecided ? `✓ ? ${percent(undecided / queries)}` : "✓",
    hint: `${count(wrong)} wrong, ${count(undecided)} undecided of ${count(queries)}`,
  };
}

const causeOf = (finding) => finding.cause ?? "–";

function top(findings, of, most) {
  const counts = new Map();
  for (const f of findings) counts.set(of(f), (counts.get(of(f)) ?? 0) + 1);
  return [...counts]
    .sort((a, b) => b[1] - a[1])
    .slice(0, most)
    .map(([value]) => value);
}

// Counts cases, not how often a cause was seen: for that a report gives only the sum, and the place of its
// simplest case.
function ofFindings(findings, only) {
  const causes = top(findings, causeOf, MOST_ROWS),
    places = top(findings, placeOf, MOST_COLUMNS);
  if (places.length < 2 || new Set(findings.map((f) => causeOf(f) + f.verdict)).size === findings.length)
    return null;
  const table = new Map();
  for (const f of findings) {
    const at = JSON.stringify([causeOf(f), placeOf(f)]);
    table.set(at, (table.get(at) ?? 0) + 1);
  }
  return matrix(
    "Cases by cause and place",
    "cause",
    places.map((place) => place || "–"),
    causes.map((cause) => ({
      name: h(
        "button",
        { type: "button", class: "row", title: "show these findings only", onclick: () => only({ cause }) },
        cause,
      ),
      cells: places.map((place) => {
        const n = table.get(JSON.stringify([cause, place]));
        return n ? { text: count(n), share: n / findings.length, bad: true } : null;
      }),
    })),
  );
}

export function failuresSection(report, looks, findings) {
  const cells = (report.cells ?? []).filter((c) => !c.skipped && c.difficulty);
  const both = [
    new Set(cells.map((c) => c.engine)).size > 1 ? ofCells(cells, looks) : null,
    report.findings?.length > 1 ? ofFindings(report.findings, findings.only) : null,
  ];
  return section(
    "failures",
    "Who fails what",
    cells.length
      ? "✗: share of wrong answers; ✓ ?: nothing wrong, share of undecided answers; –: not asked."
      : "The cases above, by cause and by where they are from.",
    both,
  );
}
