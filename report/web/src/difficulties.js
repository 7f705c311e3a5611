// A judged engine's table by kind of difficulty, and its chart.
import { h, section } from "./dom.js";
import { difficultiesChart } from "./charts/difficulties.js";
import { count, duration, isNumber, number } from "./numbers.js";
import { choosableTable } from "./table.js";

const COUNTS = [
  ["wrong", "wrong"],
  ["ill_posed", "ill-posed"],
  ["wrong_time", "wrong time"],
  ["undecided", "undecided"],
  ["unsupported", "unsupported"],
  ["error", "errors"],
  ["missing", "missing"],
  ["nonsense", "nonsense"],
  ["agree", "agree"],
  ["queries", "queries"],
];

// The rows that were not asked, or not to the end, and why; three different states.
function leftOut(rows) {
  const told = (row) => (row.scenes_given_up ? `${row.name} (${row.scenes_given_up})` : row.name);
  const named = (state, say) =>
    [
      ...Map.groupBy(
        rows.filter((r) => r.state === state),
        (r) => r.why ?? "",
      ),
    ].map(([why, its]) => h("li", {}, h("b", {}, `${say}: `), its.map(told).join(", "), why && `; ${why}`));
  const items = [
    ...named("unsupported", "Unsupported"),
    ...named("no time", "Not asked, no time"),
    ...named("too slow", "Too slow to ask"),
    ...named("other numbers", "Not asked, numbers of another precision"),
    ...named("given up", "Given up in scenes of"),
  ];
  return items.length ? h("ul", { class: "left-out" }, items) : null;
}

// How much of a golden set was asked.
const askedOf = (row) =>
  row.records > row.queries ? ` ${count(row.queries)} of its ${count(row.records)} records were asked.` : "";

export function difficultiesSection(report) {
  const all = report.difficulties ?? [];
  if (!all.length) return null;
  const rows = all.filter((r) => !["unsupported", "no time", "other numbers"].includes(r.state) && r.queries > 0);
  const always = new Set(["queries", "agree", "wrong"]);
  const columns = [
    {
      name: "kind of query",
      value: (r) => r.name,
      cell: (r) => r.name,
      below: (r) => r.explanation && h("small", {}, r.explanation, askedOf(r)),
    },
    ...COUNTS.filter(([key]) => always.has(key) || rows.some((r) => r[key] > 0)).map(([key, name]) => ({
      name,
      figure: true,
      value: (r) => r[key],
      cell: (r) => h("span", { class: key === "wrong" && r[key] > 0 ? "alarm" : null }, count(r[key])),
    })),
    {
      name: "off, radii",
      figure: true,
      hint: "largest error of the time of a right obstacle: how far along the ray, in its radii",
      value: (r) => r.max_radii,
      cell: (r) => number(r.max_radii),
    },
    {
      name: "off, ulps",
      figure: true,
      hint: "the same in ulps of the time; beyond 2^20 they tell nothing, as of times near 0",
      value: (r) => r.max_ulp,
      cell: (r) => (r.max_ulp < 2 ** 20 ? number(r.max_ulp) : isNumber(r.max_ulp) ? "> 2²⁰" : "–"),
    },
    {
      name: "time a query",
      figure: true,
      value: (r) => r.ns_per_query,
      cell: (r) => (isNumber(r.ns_per_query) ? duration(r.ns_per_query) : "–"),
    },
  ];
  return section(
    "difficulties",
    "By kind of difficulty",
    "A row that is chosen is marked in the chart, and a mark there in the table.",
    difficultiesChart(report),
    choosableTable({ label: "Kinds of difficulty", columns, rows, size: 50 }).element,
    leftOut(all),
  );
}
