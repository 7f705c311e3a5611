// The findings, filtered and in pages, so that ten thousand open as fast as ten.
import { h, section } from "./dom.js";
import { choice, pager, searchField } from "./controls.js";
import { calls } from "./charts/calls.js";
import { closeness } from "./charts/closeness.js";
import { findingCard, titleOf } from "./finding.js";
import { count } from "./numbers.js";
import { indexOf, onSelect, selected } from "./selection.js";
import { verdictOf } from "./verdicts.js";

const ANY = "any";
const SORTS = {
  causes: ["one of each cause first", null],
  closest: ["closest call first", (f) => Math.abs(f.by_radii ?? Infinity)],
  farthest: ["farthest off first", (f) => -Math.abs(f.by_radii ?? 0)],
  frequent: ["most frequent first", (f) => -(f.count ?? 1)],
};

// The text that is searched; made once, at the first search.
const texts = new WeakMap();
function textOf(finding) {
  if (!texts.has(finding)) {
    const { drawing, key, ...rest } = finding;
    texts.set(finding, JSON.stringify(rest).toLowerCase());
  }
  return texts.get(finding);
}

// The rank of each finding within its cause; reports name the simplest first.
function ranks(findings) {
  const seen = new Map();
  return new Map(
    findings.map((f) => {
      seen.set(f.cause, (seen.get(f.cause) ?? -1) + 1);
      return [f, seen.get(f.cause)];
    }),
  );
}

/** The place of a finding: "golden grazing, 3500ee96" is from golden grazing. */
export const placeOf = (finding) => String(finding.where ?? "").split(", ")[0];

const valueOf = (finding, key) => (key === "where" ? placeOf(finding) : String(finding[key] ?? ""));

function valuesOf(findings, key) {
  const counts = new Map();
  for (const f of findings) counts.set(valueOf(f, key), (counts.get(valueOf(f, key)) ?? 0) + 1);
  return [...counts]
    .sort((a, b) => b[1] - a[1])
    .map(([value, n]) => [value, `${value || "–"} (${count(n)})`]);
}

const MOST_KINDS = 12;

/** Each cause in a line: says what is wrong before any case is shown; in groups, if findings have them. */
function kindsOfFault(findings, only) {
  const kinds = [...Map.groupBy(findings, (f) => JSON.stringify([f.cause, f.verdict])).values()];
  const groups = [...Map.groupBy(kinds.slice(0, MOST_KINDS), ([first]) => first.group ?? "")];
  return h(
    "div",
    { class: "groups" },
    groups
      .map(([group, its]) => [
        group && h("h3", {}, group),
        h(
          "ol",
          { class: "kinds", "aria-label": group || "Kinds of fault" },
          its.map((kind) => kindOfFault(kind, only)),
        ),
      ])
      .flat(),
    kinds.length > MOST_KINDS && h("p", { class: "note" }, `and ${count(kinds.length - MOST_KINDS)} more`),
  );
}

function kindOfFault(its, only) {
  const { cause, verdict: name, explanation, often } = its[0],
    verdict = verdictOf(name);
  const times = its.reduce((sum, f) => sum + (f.count ?? 1), 0);
  return h(
    "li",
    { style: `--tone: ${verdict.colour}` },
    h("span", { class: "tag" }, h("span", { "aria-hidden": "true" }, `${verdict.sign} `), verdict.word),
    h(
      "button",
      {
        type: "button",
        class: "row",
        title: "show these findings only",
        onclick: () => only({ cause, verdict: name }),
      },
      titleOf(its[0]),
    ),
    h("span", { class: "times" }, `${count(times)} ×`),
    explanation &&
      h(
        "span",
        { class: "says" },
        explanation,
        its.length === 1 && often && h("span", { class: "often" }, ` – ${often}`),
      ),
  );
}

export function findingsSection(report) {
  const findings = report.findings ?? [];
  if (!findings.length) return null;
  const rank = ranks(findings);
  let shown = findings,
    words = "";
  const list = h("div", { class: "finding-list" });
  const status = h("p", { class: "status", role: "status" });
  const filter = () => arrange(0);
  const choices = {
    cause: choice("Cause", [[ANY, "any"], ...valuesOf(findings, "cause").slice(0, 200)], filter),
    verdict: choice(
      "Verdict",
      [[ANY, "any"], ...valuesOf(findings, "verdict").map(([v, t]) => [v, t.replace(v, verdictOf(v).word)])],
      filter,
    ),
    where: choice("Where", [[ANY, "any"], ...valuesOf(findings, "where").slice(0, 200)], filter),
  };
  const sort = choice(
    "Order",
    Object.entries(SORTS).map(([value, [text]]) => [value, text]),
    filter,
  );
  const size = choice(
    "A page",
    [
      ["5", "5"],
      ["20", "20"],
      ["100", "100"],
    ],
    filter,
  );
  const search = searchField("Search", (value) => {
    words = value.toLowerCase();
    filter();
  });
  const pages = pager("Pages of findings", () => {
    fill();
    list.firstElementChild?.focus({ preventScroll: true });
    list.scrollIntoView({ block: "start" });
  });

  const keeps = (finding) =>
    Object.entries(choices).every(([key, c]) => c.value === ANY || valueOf(finding, key) === c.value) &&
    words.split(/\s+/).every((word) => textOf(finding).includes(word));

  function arrange(page) {
    const all = Object.values(choices).every((c) => c.value === ANY) && !words;
    const by = SORTS[sort.value][1] ?? ((f) => rank.get(f));
    shown = (all ? [...findings] : findings.filter(keeps)).sort((a, b) => by(a) - by(b));
    pages.set(shown.length, Number(size.value), page);
    fill();
  }

  function fill() {
    const from = pages.page * Number(size.value);
    const page = shown.slice(from, from + Number(size.value));
    list.replaceChildren(...page.map((f) => findingCard(f, indexOf(f.key, "finding"), findings.length)));
    status.textContent =
      shown.length === findings.length
        ? `${count(findings.length)} findings`
        : `${count(shown.length)} of ${count(findings.length)} findings`;
    mark();
  }

  function mark() {
    for (const card of list.children) {
      const chosen = card.dataset.key === selected();
      card.classList.toggle("chosen", chosen);
      card.querySelector("button.mark")?.setAttribute("aria-pressed", String(chosen));
    }
  }

  onSelect((key, source) => {
    const i = indexOf(key, "finding");
    if (i !== null && source === "chart") showFinding(findings[i]);
    mark();
  });

  function showFinding(finding) {
    if (!shown.includes(finding)) resetFilters();
    arrange(Math.floor(shown.indexOf(finding) / Number(size.value)));
    list.querySelector(`[data-key="${finding.key}"]`)?.scrollIntoView({ block: "nearest" });
  }

  function resetFilters() {
    for (const c of Object.values(choices)) c.value = ANY;
    search.field.value = words = "";
    arrange(0);
  }

  function only(values) {
    resetFilters();
    for (const [key, value] of Object.entries(values)) choices[key].value = String(value ?? "");
    arrange(0);
    status.scrollIntoView({ block: "start" });
  }

  arrange(0);
  const few = findings.length < 2;
  const cases = [
    few
      ? null
      : h(
          "div",
          { class: "controls", role: "search", "aria-label": "Filter findings" },
          Object.values(choices).map((c) => c.element),
          sort.element,
          findings.length > 5 ? size.element : null,
          search.element,
        ),
    few ? null : status,
    list,
    pages.element,
  ];
  return {
    element: section(
      "findings",
      few ? "What was found" : "What is wrong",
      null,
      few ? null : kindsOfFault(findings, only),
      calls(report) ?? closeness(report),
      few ? cases : null,
    ),
    cases: few
      ? null
      : section(
          "cases",
          "Case by case",
          "The flight, the obstacle that is in question, and what decides it.",
          ...cases,
        ),
    /** Shows only the findings with these values: {cause: ..}. */
    only,
  };
}
