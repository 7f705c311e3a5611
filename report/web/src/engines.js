// An engine has the same colour, symbol and dash wherever it is drawn, whatever else the report contains.
import { shortened, svgElement } from "./dom.js";

// The project's engines have fixed ones in every report; others take those that are left, in the order of
// names.
const KNOWN = [
  "reduction",
  "published",
  "certified",
  "classical",
  "published-float",
  "oracle",
  "published-dd",
  "published-128",
];
const SYMBOLS = ["circle", "triangle", "square", "diamond", "star", "wye", "cross", "times"];
const DASHES = ["", "7 3", "2 3", "9 3 2 3", "4 2", "12 4", "1 3", "6 2 2 2"];

/** Map of name to {colour, symbol, dash}. Beyond eight engines colours are repeated, with other symbols. */
export function looksOf(names) {
  const present = [...new Set(names)].sort();
  const own = present.filter((name) => KNOWN.includes(name));
  const left = SYMBOLS.map((_, i) => i).filter((i) => !own.includes(KNOWN[i]));
  const places = left.length ? left : SYMBOLS.map((_, i) => i);
  const look = (colour, shift) => ({
    colour: `var(--series-${colour})`,
    symbol: SYMBOLS[(colour + shift) % SYMBOLS.length],
    dash: DASHES[(colour + shift) % DASHES.length],
  });
  const others = present.filter((name) => !KNOWN.includes(name));
  return new Map([
    ...own.map((name) => [name, look(KNOWN.indexOf(name), 0)]),
    ...others.map((name, i) => [name, look(places[i % places.length], Math.floor(i / places.length))]),
  ]);
}

/** A legend as a part of an SVG, so that it is downloaded with the SVG: {group, height}. */
export function legend(items, width, { lines = false } = {}) {
  const group = svgElement("g", {
    class: "legend",
    "font-size": 12,
    "text-anchor": "start",
    "aria-hidden": "true",
  });
  let x = 4,
    y = 12;
  for (const { name, look, note } of items) {
    const text = note ? `${name}  ${note}` : name;
    const shown = shortened(text, Math.min(64, Math.floor((width - 40) / 7)));
    const wide = 36 + 7 * shown.length;
    if (x + wide > width && x > 4) [x, y] = [4, y + 19];
    const item = svgElement("g", { transform: `translate(${x},${y})` });
    if (lines)
      item.append(
        svgElement("line", {
          x1: 0,
          x2: 20,
          stroke: look.colour,
          "stroke-width": 2,
          "stroke-dasharray": look.dash,
        }),
      );
    item.append(mark(look, 10));
    item.append(svgElement("text", { x: 26, dy: "0.34em", fill: "currentColor" }, shown));
    group.append(item);
    x += wide;
  }
  return { group, height: y + 12 };
}

const SHAPES = {
  circle: "M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0Z",
  triangle: "M0,-5.5L5,3.5L-5,3.5Z",
  square: "M-4,-4H4V4H-4Z",
  diamond: "M0,-6L4,0L0,6L-4,0Z",
  star: "M0,-6L1.5,-2L5.7,-1.9L2.4,0.8L3.5,4.9L0,2.5L-3.5,4.9L-2.4,0.8L-5.7,-1.9L-1.5,-2Z",
  wye: "M-1.5,5V1L-5,-1L-3.5,-3.6L0,-1.6L3.5,-3.6L5,-1L1.5,1V5Z",
  cross: "M-5,-1.6H-1.6V-5H1.6V-1.6H5V1.6H1.6V5H-1.6V1.6H-5Z",
  times: "M-4,-4L4,4M4,-4L-4,4",
};

function mark(look, x) {
  const path = svgElement("path", {
    d: SHAPES[look.symbol],
    transform: `translate(${x},0)`,
    fill: look.colour,
  });
  if (look.symbol === "times")
    (path.setAttribute("stroke", look.colour), path.setAttribute("stroke-width", 2));
  return path;
}

/** The same mark for a line of text or a cell of a table. */
export function swatch(look) {
  const svg = svgElement("svg", {
    width: 14,
    height: 14,
    viewBox: "-7 -7 14 14",
    "aria-hidden": "true",
    class: "swatch",
  });
  svg.append(mark(look, 0));
  return svg;
}
