// Cells of a bench: their names, groups to choose from, and the table of all cells.
import { h, section } from "./dom.js";
import { choice } from "./controls.js";
import { swatch } from "./engines.js";
import { count, duration, isNumber, number, percent } from "./numbers.js";
import { indexOf, onSelect } from "./selection.js";
import { choosableTable } from "./table.js";

export const ALL = "all";
const radiusText = (radius) =>
  radius === null || radius === undefined ? "the scene's radii" : `r = ${number(radius)}`;
export const nameOfCell = (cell) => `${cell.scene}, ${radiusText(cell.radius)}, ${cell.difficulty}`;

const distinct = (values) => [...new Set(values)];
const withAll = (options) => (options.length > 1 ? [...options, [ALL, "all"]] : options);

/** Choices of scene, difficulty and (unless `radii` is false) radius; at first those most engines share. */
export function groupChoices(cells, redraw, { radii = true, all = false } = {}) {
  const first = all ? null : richest(cells);
  const make = (label, key, text) =>
    choice(
      label,
      withAll(distinct(cells.map((c) => c[key] ?? null)).map((v) => [String(v), text(v)])),
      redraw,
      all ? ALL : String(first[key] ?? null),
    );
  const choices = {
    scene: make("Scene", "scene", String),
    difficulty: make("Difficulty", "difficulty", String),
    ...(radii ? { radius: make("Radius", "radius", radiusText) } : {}),
  };
  return {
    choices,
    elements: Object.values(choices).map((c) => c.element),
    show(cell) {
      for (const [key, c] of Object.entries(choices)) c.value = String(cell[key] ?? null);
    },
  };
}

/** Shows a cell that is chosen elsewhere: the choices change if they leave it out. */
export function followCells(report, cells, groups, redraw) {
  onSelect((key) => {
    const cell = report.cells[indexOf(key, "cell")];
    if (!cell || !cells.includes(cell) || inGroup(cell, groups)) return;
    groups.show(cell);
    redraw();
  });
}

// The cell whose scene, difficulty and radius most engines share; among equals the middle one.
function richest(cells) {
  const groups = Map.groupBy(cells, (c) => JSON.stringify([c.scene, c.difficulty, c.radius]));
  const most = Math.max(...[...groups.values()].map((g) => g.length));
  const best = [...groups.values()].filter(
    (g) => g.length === most && g[0].scene === cells[0].scene && g[0].difficulty === cells[0].difficulty,
  );
  const candidates = best.length ? best : [...groups.values()].filter((g) => g.length === most);
  return candidates[Math.floor((candidates.length - 1) / 2)][0];
}

export const inGroup = (cell, { choices }) =>
  Object.entries(choices).every(([key, c]) => c.value === ALL || String(cell[key] ?? null) === c.value);

const shareColumn = (name, key) => ({
  name,
  figure: true,
  value: (c) => (c[key] && c.queries ? c[key].count / c.queries : null),
  cell: (c) => (c[key] && c.queries ? percent(c[key].count / c.queries) : "–"),
});

const figureColumn = (name, value, text = number, hint = null) => ({
  name,
  hint,
  figure: true,
  value,
  cell: (c) => text(value(c)),
});

export function cellsSection(report, looks) {
  const cells = report.cells ?? [];
  if (!cells.length) return null;
  const columns = [
    {
      name: "engine",
      value: (c) => c.engine,
      cell: (c) => h("span", {}, swatch(looks.get(c.engine)), c.engine),
    },
    { name: "scene", value: (c) => c.scene, cell: (c) => c.scene },
    figureColumn("r", (c) => c.radius, number, "radius of all obstacles; –: the scene's own"),
    {
      name: "difficulty",
      value: (c) => c.difficulty,
      cell: (c) => (c.skipped ? `${c.difficulty} (skipped)` : c.difficulty),
    },
    figureColumn("time a query", (c) => c.ns?.median, duration, "median over the rounds"),
    shareColumn("wrong", "wrong"),
    shareColumn("ill-posed", "ill_posed"),
    shareColumn("wrong time", "wrong_time"),
    shareColumn("undecided", "undecided"),
    figureColumn(
      "99 % ulps",
      (c) => c.ulps?.p99,
      number,
      "99 % of the times of right hits err by less, in ulps",
    ),
    figureColumn("max ulps", (c) => c.ulps?.max),
    { name: "worst input", value: (c) => c.worst?.ulps ?? null, cell: worst },
    figureColumn("mean path", (c) => c.mean_path),
    figureColumn("queries", (c) => c.queries, count),
  ].filter(
    (column, i) => i < 4 || cells.some((c) => column.value(c) !== null && column.value(c) !== undefined),
  );
  const table = choosableTable({ label: "Cells", columns, rows: cells });
  const filters = [];
  const keep = () =>
    table.filter((c) => filters.every(([key, f]) => f.value === ALL || String(c[key]) === f.value));
  for (const [label, key] of [
    ["Engine", "engine"],
    ["Scene", "scene"],
    ["Difficulty", "difficulty"],
  ])
    filters.push([
      key,
      choice(label, withAll(distinct(cells.map((c) => c[key])).map((v) => [String(v), v])), keep, ALL),
    ]);
  return section(
    "cells",
    "All cells",
    "One engine on one scene, radius and kind of query. A row that is chosen is marked in the charts, and a point there in this table.",
    h(
      "div",
      { class: "controls" },
      filters.map(([, f]) => f.element),
    ),
    table.element,
  );
}

function worst(cell) {
  if (!cell.worst) return "–";
  const copy = h(
    "button",
    {
      type: "button",
      class: "copy",
      "data-copy": cell.worst.command ?? "",
      "aria-label": "Copy the command that repeats the worst input",
    },
    "copy",
  );
  return h(
    "span",
    { class: "worst", title: JSON.stringify(cell.worst.query ?? {}) },
    isNumber(cell.worst.ulps) ? `${number(cell.worst.ulps)} ulps ` : "",
    cell.worst.command ? copy : "",
  );
}
