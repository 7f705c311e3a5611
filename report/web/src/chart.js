// The frame that every chart has: a heading, its controls, the drawing, the numbers as a table, downloads.
import { h, newId } from "./dom.js";
import { legend } from "./engines.js";
import { saveCsv, saveSvg } from "./download.js";
import { pointer } from "./pointer.js";
import { plainTable } from "./table.js";
import * as Plot from "@observablehq/plot";

/**
 * `draw(width)` gives {svg, points, legend: items of the legend, summary: the chart in a sentence or two,
 * numbers: {columns, rows}}, or null where there is nothing to draw. `controls` are elements; `redraw` of the
 * result is called when they change. `below(drawn)`, if any, makes what is written below.
 */
export function chart({ name, title, note, controls = [], draw, below = null, legendLines = false }) {
  const heading = newId("chart"), description = newId("description");
  const frame = h("div", { class: "plot", "aria-describedby": description });
  const summary = h("p", { class: "summary", id: description });
  const under = h("div", {});
  const numbers = h("details", { class: "numbers", ontoggle: () => fillNumbers() }, h("summary", {}, "Numbers as a table"));
  const over = pointer(frame, title);
  let drawn = null, svg = null, width = 0;

  function fillNumbers() {
    numbers.querySelector(".scroll")?.remove();
    if (numbers.open && drawn) numbers.append(plainTable(`${title}: numbers`, drawn.numbers));
  }

  function redraw() {
    width = frame.clientWidth;
    if (!width) return;
    drawn = draw(width);
    svg?.remove();
    svg = drawn ? withLegend(drawn, width, title, legendLines) : null;
    figure.classList.toggle("empty", !svg);
    summary.textContent = drawn ? drawn.summary : "Nothing to draw for this choice.";
    under.replaceChildren(...(drawn && below ? [below(drawn)].filter(Boolean) : []));
    fillNumbers();
    if (!svg) return;
    frame.prepend(svg);
    over.set(svg, drawn.points);
  }

  const button = (text, what, action) =>
    h("button", { type: "button", class: "download", "aria-label": `Download ${what} of: ${title}`, onclick: () => svg && action() }, text);
  const figure = h("figure", { class: "chart", "data-chart": name, "aria-labelledby": heading },
    h("div", { class: "chart-head" },
      h("h3", { id: heading }, title),
      h("div", { class: "downloads" },
        button("SVG", "the picture", () => saveSvg(name, svg, title)),
        button("CSV", "the numbers", () => saveCsv(name, drawn.numbers)))),
    note && h("p", { class: "note" }, note),
    controls.filter(Boolean).length ? h("div", { class: "controls" }, controls) : null,
    frame, h("figcaption", {}, summary), under, numbers);

  new ResizeObserver(() => { if (Math.abs(frame.clientWidth - width) > 1) redraw(); }).observe(frame);
  return { element: figure, redraw };
}

// Plot's drawing, the legend above it (where y is negative), in one SVG.
function withLegend(drawn, width, title, lines) {
  const { svg } = drawn;
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `${title}. ${drawn.summary}`);
  if (!drawn.legend?.length) return svg;
  const { group, height } = legend(drawn.legend, width, { lines });
  const tall = Number(svg.getAttribute("height"));
  svg.setAttribute("height", tall + height);
  svg.setAttribute("viewBox", `0 ${-height} ${width} ${tall + height}`);
  group.setAttribute("transform", `translate(0,${-height})`);
  svg.append(group);
  return svg;
}

/** Plot.plot with what all charts share. */
export function plot(options) {
  return Plot.plot({
    style: "background: transparent; overflow: visible; font-family: inherit; font-size: 12px; color: inherit",
    marginLeft: 62, marginRight: 16, marginBottom: 44, marginTop: 16,
    color: { type: "identity" },
    symbol: { type: "identity" },
    ...options,
  });
}

/** A domain for positive values on a logarithmic axis, with some air. */
export function logDomain(values, air = 1.6) {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  return positive.length ? [Math.min(...positive) / air, Math.max(...positive) * air] : [0.1, 10];
}
