// Puts names beside points where there is room: names never overlap or leave the frame.
import { shortened, svgElement } from "./dom.js";

const LETTERS = 24,
  WIDTH = 7.3,
  HEIGHT = 14; // of a letter at 12 pixels, and of a line
const PLACES = [
  ["start", 10, -9],
  ["end", -10, -9],
  ["start", 10, 18],
  ["end", -10, 18],
  ["middle", 0, -14],
  ["middle", 0, 24],
];

const overlap = (a, b) =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

function boxOf({ x, y }, text, [anchor, dx, dy]) {
  const width = WIDTH * text.length;
  return {
    x: x + dx - (anchor === "start" ? 0 : anchor === "end" ? width : width / 2),
    y: y + dy - HEIGHT + 3,
    width,
    height: HEIGHT,
  };
}

/** `points` are {x, y, text} in pixels of the SVG, `frame` is {x, y, width, height}. A name without room is left out. */
export function putLabels(svg, points, frame) {
  const taken = points.map(({ x, y }) => ({ x: x - 6, y: y - 6, width: 12, height: 12 }));
  const inside = (box) => box.x >= frame.x && box.x + box.width <= frame.x + frame.width && box.y >= frame.y;
  const group = svgElement("g", {
    class: "labels",
    "font-size": 12,
    "font-weight": 600,
    fill: "currentColor",
    stroke: "var(--surface)",
    "stroke-width": 4,
    "paint-order": "stroke",
  });
  for (const point of points) {
    const text = shortened(point.text, LETTERS);
    const place = PLACES.find((p) => {
      const box = boxOf(point, text, p);
      return inside(box) && !taken.some((other) => overlap(box, other));
    });
    if (!place) continue;
    taken.push(boxOf(point, text, place));
    group.append(
      svgElement("text", { x: point.x + place[1], y: point.y + place[2], "text-anchor": place[0] }, text),
    );
  }
  svg.append(group);
}
