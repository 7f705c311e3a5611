// Shows the numbers of a chart's points: under the mouse, by the arrow keys, and for screen readers. The
// chosen point has a ring.
import { h, svgElement, announce } from "./dom.js";
import { onSelect, select, selected } from "./selection.js";

const REACH = 28; // pixels from the mouse to a point

/**
 * `frame` is a positioned element with the chart in it. The result is `set(svg, points)`: points are
 * {x, y, key, lines}, in pixels of the SVG; `lines` are shown, `key` is the selection (or null).
 */
export function pointer(frame, label) {
  const tip = h("div", { class: "tip", "aria-hidden": "true", hidden: true });
  let svg = null,
    points = [],
    current = -1,
    rings = null;
  frame.append(tip);
  frame.tabIndex = 0;
  frame.setAttribute("role", "group");
  frame.setAttribute("aria-label", `${label}. Arrow keys go from point to point, Enter chooses one.`);

  const scale = () => svg.getBoundingClientRect().width / Number(svg.getAttribute("width"));

  function show(i, spoken) {
    current = i;
    tip.hidden = i < 0;
    rings?.querySelector(".hovered")?.remove();
    if (i < 0) return;
    const point = points[i];
    tip.replaceChildren(...point.lines.map((line, n) => h(n ? "div" : "strong", {}, line)));
    rings.append(svgElement("circle", { class: "hovered", cx: point.x, cy: point.y, r: 9 }));
    place(point);
    if (spoken) announce(`${i + 1} of ${points.length}: ${point.lines.join("; ")}`);
  }

  function place(point) {
    const s = scale(),
      wide = frame.clientWidth;
    const left =
      point.x * s + 14 + tip.offsetWidth > wide ? point.x * s - 14 - tip.offsetWidth : point.x * s + 14;
    tip.style.left = `${Math.max(0, Math.min(left, wide - tip.offsetWidth))}px`;
    tip.style.top = `${Math.max(0, (point.y - svg.viewBox.baseVal.y) * s - tip.offsetHeight - 8)}px`;
  }

  function nearest(event) {
    const box = svg.getBoundingClientRect(),
      s = scale();
    const x = (event.clientX - box.left) / s,
      y = (event.clientY - box.top) / s + svg.viewBox.baseVal.y;
    let best = -1,
      least = REACH ** 2;
    points.forEach((point, i) => {
      const distance = (point.x - x) ** 2 + (point.y - y) ** 2;
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  }

  function ring() {
    rings?.querySelectorAll(".chosen").forEach((old) => old.remove());
    for (const point of points)
      if (point.key && point.key === selected())
        rings.append(svgElement("circle", { class: "chosen", cx: point.x, cy: point.y, r: 8 }));
  }

  const choose = (i) => {
    if (i >= 0 && points[i].key) select(points[i].key, "chart");
  };
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

  frame.addEventListener("pointermove", (event) => {
    const i = nearest(event);
    if (i !== current) show(i, false);
  });
  frame.addEventListener("pointerleave", () => show(-1));
  frame.addEventListener("click", (event) => choose(nearest(event)));
  frame.addEventListener("blur", () => show(-1));
  frame.addEventListener("keydown", (event) => {
    if (!points.length) return;
    if (step[event.key]) show((current + step[event.key] + points.length) % points.length, true);
    else if (event.key === "Home") show(0, true);
    else if (event.key === "End") show(points.length - 1, true);
    else if (event.key === "Enter" || event.key === " ") choose(current);
    else if (event.key === "Escape") show(-1);
    else return;
    event.preventDefault();
  });
  onSelect(ring);

  return {
    set(newSvg, newPoints) {
      svg = newSvg;
      points = [...newPoints].sort((a, b) => a.x - b.x || a.y - b.y);
      rings = svgElement("g", { class: "rings" });
      svg.append(rings);
      show(-1);
      ring();
    },
  };
}
