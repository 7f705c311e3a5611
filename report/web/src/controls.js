// Choices above charts and lists.
import { h, newId } from "./dom.js";

/**
 * A labelled list of [value, text] to choose from; hidden if there is no choice.
 * The result has `element`, `value` (get and set), and calls `onchange`.
 */
export function choice(label, options, onchange, initial = options[0]?.[0]) {
  const id = newId("choice");
  const list = h(
    "select",
    { id, onchange: () => onchange(list.value) },
    options.map(([value, text]) => h("option", { value, selected: value === initial }, text)),
  );
  return {
    element:
      options.length > 1 ? h("span", { class: "control" }, h("label", { for: id }, label), list) : null,
    get value() {
      return options.length ? list.value : undefined;
    },
    set value(value) {
      list.value = value;
    },
  };
}

export function searchField(label, onchange) {
  const id = newId("search");
  let timer;
  const field = h("input", {
    id,
    type: "search",
    placeholder: "text, id, number ..",
    autocomplete: "off",
    oninput: () => {
      clearTimeout(timer);
      timer = setTimeout(() => onchange(field.value), 120);
    },
  });
  return { element: h("span", { class: "control" }, h("label", { for: id }, label), field), field };
}

/** Controls for the pages of a list: `show(page)` is called with the page's number, from 0. */
export function pager(label, show) {
  const place = h("span", { class: "place", "aria-live": "polite" });
  const go = (to) => {
    if (to >= 0 && to < pages) {
      page = to;
      render();
      show(page);
    }
  };
  const button = (text, name, step) =>
    h("button", { type: "button", "aria-label": name, onclick: () => go(step()) }, text);
  const first = button("«", "first page", () => 0),
    before = button("‹", "page before", () => page - 1);
  const next = button("›", "next page", () => page + 1),
    last = button("»", "last page", () => pages - 1);
  const element = h("nav", { class: "pager", "aria-label": label }, first, before, place, next, last);
  let page = 0,
    pages = 1,
    total = 0,
    size = 1;
  function render() {
    element.hidden = pages <= 1;
    place.textContent = `${page * size + 1}–${Math.min(total, (page + 1) * size)} of ${total}`;
    first.disabled = before.disabled = page === 0;
    next.disabled = last.disabled = page === pages - 1;
  }
  return {
    element,
    get page() {
      return page;
    },
    set(newTotal, newSize, newPage = 0) {
      [total, size] = [newTotal, newSize];
      pages = Math.max(1, Math.ceil(total / size));
      page = Math.min(newPage, pages - 1);
      render();
    },
  };
}
