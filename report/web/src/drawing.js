// The drawing of a finding: SVG text from the report, brought into the page without anything that acts or loads.

const FORBIDDEN = new Set(["script", "foreignobject", "iframe", "image", "animate", "set", "animatetransform", "animatemotion", "a", "audio", "video"]);
let drawings = 0;

function isHarmless(attribute) {
  const name = attribute.name.toLowerCase(), value = attribute.value;
  if (name.startsWith("on")) return false;
  if (name === "href" || name.endsWith(":href")) return value.startsWith("#");
  return !/url\(\s*['"]?(?!#)|javascript:|@import/i.test(value);
}

function clean(element) {
  for (const child of [...element.children]) {
    const name = child.localName.toLowerCase();
    const loads = name === "style" && /url\(\s*['"]?(?!#)|@import/i.test(child.textContent);
    if (FORBIDDEN.has(name) || loads) child.remove();
    else clean(child);
  }
  for (const attribute of [...element.attributes]) if (!isHarmless(attribute)) element.removeAttribute(attribute.name);
}

// Two drawings of a page may use the same ids.
function ownIds(svg) {
  const prefix = `d${++drawings}-`;
  const ids = new Set([...svg.querySelectorAll("[id]")].map((e) => e.id));
  if (svg.id) ids.add(svg.id);
  for (const element of [svg, ...svg.querySelectorAll("*")]) {
    for (const attribute of [...element.attributes]) {
      let value = attribute.value;
      if (attribute.name === "id") value = prefix + value;
      else if (/^(xlink:)?href$/.test(attribute.name) && ids.has(value.slice(1))) value = `#${prefix}${value.slice(1)}`;
      else if (attribute.name.startsWith("aria-")) value = value.split(" ").map((id) => (ids.has(id) ? prefix + id : id)).join(" ");
      else value = value.replace(/url\((['"]?)#([^)'"]+)\1\)/g, (whole, _, id) => (ids.has(id) ? `url(#${prefix}${id})` : whole));
      if (value !== attribute.value) attribute.value = value;
    }
  }
}

/** An <svg> element, or null if the text is none. */
export function drawing(text, label) {
  const document_ = new DOMParser().parseFromString(text, "image/svg+xml");
  const root = document_.documentElement;
  if (root.localName !== "svg" || document_.querySelector("parsererror")) return null;
  clean(root);  // in a document of its own, where nothing acts or loads yet
  const svg = document.importNode(root, true);
  ownIds(svg);
  const [width, height] = [parseFloat(svg.getAttribute("width")), parseFloat(svg.getAttribute("height"))];
  if (!svg.hasAttribute("viewBox") && width > 0 && height > 0) svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.removeAttribute("height");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", label);
  return svg;
}
