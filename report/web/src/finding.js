// One finding: the fault, drawn; given and exact answer side by side; the query in hexadecimal; how to
// reproduce it.
import { h } from "./dom.js";
import { drawing } from "./drawing.js";
import { count, fromHexadecimal, isNumber, number, ulps } from "./numbers.js";
import { select, selected } from "./selection.js";
import { verdictOf } from "./verdicts.js";

/** The title of a finding, for people. */
export const titleOf = (finding) => finding.title ?? finding.cause ?? "–";

export function findingCard(finding, i, total) {
  const verdict = verdictOf(finding.verdict);
  const title = `finding-${i}`;
  const picture = finding.drawing
    ? drawing(
        finding.drawing,
        `Drawing of finding ${i + 1}: ${titleOf(finding)}. ${finding.explanation ?? ""}`,
      )
    : null;
  return h(
    "article",
    {
      class: "finding",
      "data-key": finding.key,
      "aria-labelledby": title,
      tabindex: -1,
      style: `--tone: ${verdict.colour}`,
    },
    h(
      "div",
      { class: "finding-head" },
      h(
        "h3",
        { id: title },
        h("span", { class: "tag" }, h("span", { "aria-hidden": "true" }, `${verdict.sign} `), verdict.word),
        " ",
        titleOf(finding),
      ),
      total > 1 &&
        h(
          "button",
          {
            type: "button",
            class: "mark",
            "aria-pressed": String(selected() === finding.key),
            onclick: () => select(finding.key, "list"),
          },
          "mark in charts",
        ),
    ),
    finding.explanation && h("p", { class: "explanation" }, finding.explanation),
    finding.why && h("p", { class: "explanation" }, `Likely: ${finding.why}`),
    h("p", { class: "facts" }, facts(finding, i, total)),
    h(
      "div",
      { class: picture ? "finding-body with-picture" : "finding-body" },
      h(
        "div",
        {},
        picture && h("div", { class: "paper" }, picture),
        reason(finding.reason),
        finding.last_words &&
          h("p", { class: "last-words" }, "Its last line on stderr: ", h("code", {}, finding.last_words)),
      ),
      h("div", {}, answers(finding.given, finding.exact), query(finding.query)),
    ),
    finding.scene &&
      h(
        "details",
        {},
        h("summary", {}, "Scene"),
        h("pre", { tabindex: 0, "aria-label": "Scene as JSON" }, JSON.stringify(finding.scene)),
      ),
    primitive(finding),
    commands(finding.commands),
  );
}

function facts(finding, i, total) {
  return [
    `${i + 1} of ${total}`,
    finding.shrunk ? `shrunk from ${finding.where}` : finding.where,
    finding.count > 1 ? `${count(finding.count)} like this` : null,
    isNumber(finding.by_radii) ? `off by ${number(Math.abs(finding.by_radii))} ${radiiOf(finding)}` : null,
    isNumber(finding.by_ulps) ? `off by ${ulps(Math.abs(finding.by_ulps))}` : null,
  ]
    .filter(Boolean)
    .join(" · ");
}

/** The unit of a finding's error in radii. */
export const radiiOf = (finding) => (finding.verdict === "wrong-time" ? "radii along the ray" : "radii");

const textOf = (value) =>
  value === undefined || value === null
    ? "–"
    : Array.isArray(value)
      ? `(${value.map(textOf).join(", ")})`
      : typeof value === "object"
        ? JSON.stringify(value)
        : String(value);

function answers(given, exact) {
  const answers = [
    ["given", given],
    ["exact", exact],
  ].filter(([, answer]) => answer);
  if (!answers.length) return null;
  const keys = [...new Set(answers.flatMap(([, answer]) => Object.keys(answer)))].filter(
    (key) => key !== "id",
  );
  const row = (key) => {
    const values = answers.map(([, answer]) => textOf(answer[key]));
    const differs = values.length > 1 && values[0] !== values[1];
    return h(
      "tr",
      { class: differs ? "differs" : null },
      h("th", { scope: "row" }, key, differs && h("span", { class: "unseen" }, " (differs)")),
      values.map((value) => h("td", {}, value)),
    );
  };
  return h(
    "table",
    { class: "answers" },
    h("caption", {}, answers.length > 1 ? "The answer given, and the exact one" : "The answer"),
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        h("td", {}),
        answers.map(([name]) => h("th", { scope: "col" }, name)),
      ),
    ),
    h("tbody", {}, keys.map(row)),
  );
}

function reason(lines) {
  return lines?.length
    ? h(
        "div",
        { class: "reason" },
        h("h4", {}, "Why"),
        lines.map((line) => h("p", {}, line.trim())),
      )
    : null;
}

// The numbers of a query, at any depth: [["x[0]", "0x1p-1"], ..].
function leaves(value, path) {
  if (Array.isArray(value)) return value.flatMap((v, i) => leaves(v, `${path}[${i}]`));
  if (value && typeof value === "object")
    return Object.entries(value).flatMap(([k, v]) => leaves(v, path ? `${path}.${k}` : k));
  return [[path, value]];
}

function decimal(value) {
  const parsed = typeof value === "string" ? fromHexadecimal(value) : value;
  return isNumber(parsed) ? String(parsed) : "";
}

function query(query) {
  if (!query) return null;
  return h(
    "table",
    { class: "query" },
    h("caption", {}, "The query, bit by bit"),
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        h("td", {}),
        h("th", { scope: "col" }, "hexadecimal"),
        h("th", { scope: "col" }, "nearest decimal"),
      ),
    ),
    h(
      "tbody",
      {},
      leaves(query, "").map(([name, value]) =>
        h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, textOf(value)), h("td", {}, decimal(value))),
      ),
    ),
  );
}

// The ray and the obstacle that decides.
function primitive({ primitive: question, primitive_cpp: code }) {
  if (!question || !code) return null;
  return h(
    "div",
    { class: "commands" },
    h("h4", {}, "The one question: a ray and an obstacle"),
    copied(code.trimEnd(), "C++"),
    copied(JSON.stringify(question), "JSON"),
  );
}

function commands(lines) {
  if (!lines?.length) return null;
  return h(
    "div",
    { class: "commands" },
    h("h4", {}, "See it again"),
    lines.map((line) => command(line)),
  );
}

export const command = (line) => copied(line, "command");

const copied = (text, what) =>
  h(
    "div",
    { class: "command" },
    h("pre", { tabindex: 0, "aria-label": what }, h("code", {}, text)),
    h(
      "button",
      { type: "button", class: "copy", "data-copy": text, "aria-label": `Copy the ${what}` },
      "copy",
    ),
  );
