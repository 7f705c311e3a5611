// Makes all elements. Texts of a report may come from anyone, so they are set as text, never as HTML.

/** h("div", {class: "x", onclick: f}, child, ..): children are nodes or texts, without null and false. */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(
    ...children.flat().filter((child) => child !== null && child !== undefined && child !== false),
  );
  return element;
}

export const SVG_NAMESPACE = "http://www.w3.org/2000/svg";

export function svgElement(tag, attributes = {}, text = null) {
  const element = document.createElementNS(SVG_NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== null) element.textContent = text;
  return element;
}

let last = 0;
export const newId = (prefix) => `${prefix}-${++last}`;

/** A text for places with little room. */
export const shortened = (text, letters) => (text.length > letters ? `${text.slice(0, letters - 1)}…` : text);

/** A section with a heading; nothing if there is nothing to show in it. */
export function section(id, title, lead, ...children) {
  const shown = children.flat().filter(Boolean);
  if (!shown.length) return null;
  return h(
    "section",
    { id, "aria-labelledby": `${id}-title` },
    h("h2", { id: `${id}-title` }, title),
    lead && h("p", { class: "lead" }, lead),
    shown,
  );
}

/** Says something to a screen reader. */
export function announce(text) {
  document.getElementById("live").textContent = text;
}
