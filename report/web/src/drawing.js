// The drawing of a finding: SVG text from the report, rebuilt in the page without anything that acts or
// loads.
import { svgElement } from "./dom.js";

const ALLOWED = new Set([
  "svg",
  "g",
  "defs",
  "symbol",
  "use",
  "title",
  "desc",
  "style",
  "path",
  "line",
  "polyline",
  "polygon",
  "rect",
  "circle",
  "ellipse",
  "text",
  "tspan",
  "textPath",
  "marker",
  "clipPath",
  "mask",
  "pattern",
  "linearGradient",
  "radialGradient",
  "stop",
]);
const SVG = "http://www.w3.org/2000/svg",
  XHTML = "http://www.w3.org/1999/xhtml";
let drawings = 0;

const loads = (css) => /url\(\s*['"]?(?!#)|@import|javascript:|\\/i.test(css);

function isHarmless({ name, value }) {
  if (/^on|^xmlns|^xml:base/i.test(name)) return false;
  if (/(^|:)href$/i.test(name)) return value.startsWith("#");
  return !loads(value);
}

/** The same element in SVG, without parts that are not allowed; null if the element itself is not allowed. */
function rebuilt(element) {
  if (!ALLOWED.has(element.localName) || (element.localName === "style" && loads(element.textContent)))
    return null;
  const copy = svgElement(element.localName);
  for (const attribute of element.attributes)
    if (isHarmless(attribute)) copy.setAttribute(attribute.localName, attribute.value);
  for (const child of element.childNodes) {
    if (child.nodeType === Node.TEXT_NODE || child.nodeType === Node.CDATA_SECTION_NODE)
      copy.append(child.textContent);
    else if (child.nodeType === Node.ELEMENT_NODE) copy.append(rebuilt(child) ?? "");
  }
  return copy;
}

// Makes ids unique, because two drawings of a page may use the same ones.
function ownIds(svg) {
  const prefix = `d${++drawings}-`;
  const ids = new Set([...svg.querySelectorAll("[id]")].map((e) => e.id));
  if (svg.id) ids.add(svg.id);
  for (const element of [svg, ...svg.querySelectorAll("*")]) {
    for (const attribute of [...element.attributes]) {
      let value = attribute.value;
      if (attribute.name === "id") value = prefix + value;
      else if (attribute.name === "href" && ids.has(value.slice(1))) value = `#${prefix}${value.slice(1)}`;
      else if (attribute.name.startsWith("aria-"))
        value = value
          .split(" ")
          .map((id) => (ids.has(id) ? prefix + id : id))
          .join(" ");
      else
        value = value.replace(/url\((['"]?)#([^)'"]+)\1\)/g, (whole, _, id) =>
          ids.has(id) ? `url(#${prefix}${id})` : whole,
        );
      if (value !== attribute.value) attribute.value = value;
    }
  }
}

/** An <svg> element, or null if the text is not SVG. */
export function drawing(text, label) {
  // Parsed under names that mean nothing to a browser, so that nothing in it acts before it is checked.
  const inert = text.replaceAll(SVG, "inert:svg").replaceAll(XHTML, "inert:html");
  const parsed = new DOMParser().parseFromString(inert, "application/xml");
  if (parsed.documentElement.localName !== "svg" || parsed.querySelector("parsererror")) return null;
  const svg = rebuilt(parsed.documentElement);
  ownIds(svg);
  const [width, height] = [parseFloat(svg.getAttribute("width")), parseFloat(svg.getAttribute("height"))];
  if (!svg.hasAttribute("viewBox") && width > 0 && height > 0)
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.removeAttribute("height");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", label);
  return svg;
}
