// The frame of every chart: a heading, its controls, the drawing, the numbers as a table, downloads.
import { h, newId } from "./dom.js";
import { legend } from "./engines.js";
import { saveCsv, saveSvg } from "./download.js";
import { pointer } from "./pointer.js";
import { powerTick } from "./numbers.js";
import { plainTable } from "./table.js";
import * as Plot from "@observablehq/plot";

/**
 * `draw(width)` gives {svg, points, legend: items of the legend, summary: the chart in a sentence or two,
 * numbers: {columns, rows}}, or null if there is nothing to draw. `controls` are elements; `redraw` of the
 * result is called when they change. `below(drawn)`, if given, makes the text below the chart.
 */
export function chart({ name, title, note, controls = [], draw, below = null, legendLines = false }) {
  const heading = newId("chart"),
    description = newId("description");
  const frame = h("div", { class: "plot", "aria-describedby": description });
  const summary = h("p", { class: "summary", id: description });
  const under = h("div", {});
  const numbers = h(
    "details",
    { class: "numbers", ontoggle: () => fillNumbers() },
    h("summary", {}, "Numbers as a table"),
  );
  const over = pointer(frame, title);
  let drawn = null,
    svg = null,
    width = 0;

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
    summary.textContent = drawn
      ? drawn.summary[0].toUpperCase() + drawn.summary.slice(1)
      : "Nothing to draw for this choice.";
    under.replaceChildren(...(drawn && below ? [below(drawn)].filter(Boolean) : []));
    fillNumbers();
    if (!svg) return;
    frame.prepend(svg);
    over.set(svg, drawn.points);
  }

  const button = (text, what, action) =>
    h(
      "button",
      {
        type: "button",
        class: "download",
        "aria-label": `Download ${what} of: ${title}`,
        onclick: () => svg && action(),
      },
      text,
    );
  const figure = h(
    "figure",
    { class: "chart", "data-chart": name, "aria-labelledby": heading },
    h(
      "div",
      { class: "chart-head" },
      h("h3", { id: heading }, title),
      h(
        "div",
        { class: "downloads" },
        button("SVG", "the picture", () => saveSvg(name, svg, title)),
        button("CSV", "the numbers", () => saveCsv(name, drawn.numbers)),
      ),
    ),
    note && h("p", { class: "note" }, note),
    controls.filter(Boolean).length ? h("div", { class: "controls" }, controls) : null,
    frame,
    h("figcaption", {}, summary),
    under,
    numbers,
  );

  new ResizeObserver(() => {
    if (Math.abs(frame.clientWidth - width) > 1) redraw();
  }).observe(frame);
  return { element: figure, redraw };
}

// Plot's drawing with the legend above it (where y is negative), in one SVG.
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
    ...options,
    x: withoutOwn(options.x),
    y: withoutOwn(options.y),
    marks: [
      logMarks(Plot.axisX, Plot.gridX, options.x),
      logMarks(Plot.axisY, Plot.gridY, options.y),
      ...options.marks,
    ],
    style:
      "background: transparent; overflow: visible; font-family: inherit; font-size: 12px; color: inherit",
    marginLeft: options.marginLeft ?? 72,
    marginRight: 16,
    marginBottom: 44,
    marginTop: 16,
    color: { type: "identity" },
    symbol: { type: "identity" },
  });
}

// Plot leaves out labels of logarithmic ticks if it considers them too many. Here their number is chosen
// already.
const withoutOwn = (scale) => (scale?.show ? { ...scale, axis: null } : scale);
const logMarks = (axis, grid, scale) =>
  scale?.show
    ? [
        grid(scale.ticks, {}),
        axis(scale.ticks, { text: (t) => scale.show(t), label: scale.label, labelAnchor: "center" }),
      ]
    : null;

/** A logarithmic axis for these values (those not above 0 are ignored), with about `ticks` ticks. */
export function logAxis(label, values, ticks, { air = 1.6, show = powerTick } = {}) {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  const domain = positive.length ? [Math.min(...positive) / air, Math.max(...positive) * air] : [0.1, 10];
  return { type: "log", label, domain, ticks: logTicks(domain, Math.max(3, Math.floor(ticks))), show };
}

// Powers of ten, or every n-th if there are too many; 1, 2 and 5 (or 1 and 3) times them if there are too
// few.
function logTicks([low, high], most) {
  const exponents = [];
  for (let e = Math.ceil(Math.log10(low) - 1e-9); e <= Math.log10(high) + 1e-9; ++e) exponents.push(e);
  const step = Math.ceil(exponents.length / most);
  if (exponents.length > 2) return exponents.filter((e) => e % step === 0).map((e) => Number(`1e${e}`));
  const from = Math.floor(Math.log10(low));
  return [from, from + 1, from + 2]
    .flatMap((e) => (most > 4 ? [1, 2, 5] : [1, 3]).map((m) => Number(`${m}e${e}`)))
    .filter((t) => t >= low && t <= high);
}
