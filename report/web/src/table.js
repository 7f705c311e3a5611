// Tables: a click on a column's name sorts them. Rows can be chosen, and are marked when their point in a
// chart is.
import { h, newId } from "./dom.js";
import { pager } from "./controls.js";
import { number } from "./numbers.js";
import { onSelect, select, selected } from "./selection.js";

const scrolling = (label, table) =>
  h("div", { class: "scroll", role: "region", "aria-label": label, tabindex: 0 }, table);

/** Numbers behind a chart: {columns, rows}; only the first 200 rows, because the CSV has all. */
export function plainTable(label, { columns, rows }) {
  const shown = rows.slice(0, 200);
  const more =
    rows.length > shown.length ? `; the first ${shown.length} of ${rows.length} rows, the CSV has all` : "";
  return scrolling(
    label,
    h(
      "table",
      {},
      h("caption", {}, label + more),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          columns.map((name) => h("th", { scope: "col" }, name)),
        ),
      ),
      h(
        "tbody",
        {},
        shown.map((row) =>
          h(
            "tr",
            {},
            row.map((value, i) =>
              h(
                i ? "td" : "th",
                i ? { class: typeof value === "number" ? "figure" : null } : { scope: "row" },
                typeof value === "number" ? number(value, 4) : (value ?? "–"),
              ),
            ),
          ),
        ),
      ),
    ),
  );
}

/**
 * `columns`: {name, hint, value(row) to sort by, cell(row): text or element,
 * below(row): the text below it (first column only), figure: true for numbers}; `rows`
 * have a `key` for the selection. The first column names the row. `size`: rows per page.
 */
export function choosableTable({ label, columns, rows, size = 25 }) {
  let sorting = { column: null, down: false };
  let shown = rows,
    filtered = rows;
  const body = h("tbody", {});
  const heads = columns.map((column) => {
    const th = h(
      "th",
      { scope: "col", class: column.figure ? "figure" : null, "aria-sort": "none" },
      h(
        "button",
        { type: "button", class: "sort", title: column.hint ?? null, onclick: () => sort(column) },
        column.name,
      ),
    );
    return th;
  });
  const pages = pager(`Pages: ${label}`, () => fill());
  const caption = newId("caption");
  const table = h(
    "table",
    { class: "choosable stacked", "aria-labelledby": caption },
    h(
      "caption",
      { id: caption, class: "unseen" },
      `${label}. A row can be chosen: its points are marked in the charts.`,
    ),
    h("thead", {}, h("tr", {}, heads)),
    body,
  );

  function sort(column) {
    sorting = { column, down: sorting.column === column ? !sorting.down : Boolean(column.figure) };
    heads.forEach((th, i) =>
      th.setAttribute(
        "aria-sort",
        columns[i] !== column ? "none" : sorting.down ? "descending" : "ascending",
      ),
    );
    arrange(0);
  }

  function arrange(page) {
    const { column, down } = sorting;
    const compare = (a, b) => {
      const [x, y] = [column.value(a), column.value(b)];
      if (x === null || x === undefined) return 1;
      if (y === null || y === undefined) return -1;
      return (x < y ? -1 : x > y ? 1 : 0) * (down ? -1 : 1);
    };
    shown = column ? [...filtered].sort(compare) : filtered;
    pages.set(shown.length, size, page);
    fill();
  }

  const choose = (row) => select(row.key, "table");

  function rowOf(row) {
    const name = ({ cell, below }) =>
      h(
        "th",
        { scope: "row" },
        h(
          "button",
          { type: "button", class: "row", "aria-pressed": "false", onclick: () => choose(row) },
          cell(row),
        ),
        below?.(row),
      );
    return h(
      "tr",
      {
        "data-key": row.key,
        onclick: (event) => {
          if (!event.target.closest("button, a")) choose(row);
        },
      },
      columns.map((column, i) =>
        i
          ? h("td", { class: column.figure ? "figure" : null, "data-name": column.name }, column.cell(row))
          : name(column),
      ),
    );
  }

  function fill() {
    body.replaceChildren(...shown.slice(pages.page * size, (pages.page + 1) * size).map(rowOf));
    mark();
  }

  function mark() {
    for (const tr of body.children) {
      const chosen = tr.dataset.key === selected();
      tr.classList.toggle("chosen", chosen);
      tr.querySelector("button.row").setAttribute("aria-pressed", String(chosen));
    }
  }

  onSelect((key) => {
    const at = shown.findIndex((row) => row.key === key);
    if (at >= 0 && Math.floor(at / size) !== pages.page) {
      pages.set(shown.length, size, Math.floor(at / size));
      fill();
    } else {
      mark();
    }
  });
  arrange(0);
  return {
    element: h("div", { class: "table-block" }, scrolling(label, table), pages.element),
    filter(keep) {
      filtered = rows.filter(keep);
      arrange(0);
    },
  };
}
