// The page: reads the embedded report, and shows its parts.
import { h, section } from "./dom.js";
import { cellsSection } from "./cells.js";
import { watchCopyButtons } from "./copy.js";
import { difficultiesSection } from "./difficulties.js";
import { looksOf } from "./engines.js";
import { failuresSection } from "./failures.js";
import { findingsSection } from "./findings.js";
import { head } from "./head.js";
import { manifestSection } from "./manifest.js";
import { themeSwitch } from "./theme.js";
import { callsOfCells } from "./charts/calls.js";
import { freePaths } from "./charts/free_paths.js";
import { histograms } from "./charts/histograms.js";
import { speedError } from "./charts/speed_error.js";
import { timeRadius } from "./charts/time_radius.js";

const KEYED = { cells: "cell", difficulties: "difficulty", findings: "finding" };

function readReport() {
  const report = JSON.parse(document.getElementById("report").textContent);
  for (const [list, kind] of Object.entries(KEYED))
    report[list]?.forEach((row, i) => {
      row.key = `${kind}:${i}`;
    });
  return report;
}

function enginesOf(report) {
  return (report.cells ?? []).map((row) => row.engine).concat(report.engine ?? []);
}

const grid = (...charts) => (charts.some(Boolean) ? h("div", { class: "grid" }, charts) : null);

function sections(report) {
  const looks = looksOf(enginesOf(report));
  const findings = findingsSection(report);
  const cells = report.cells?.length ? report : { ...report, cells: [] };
  const speed = section(
    "speed",
    "Speed and error",
    null,
    grid(speedError(cells, looks), timeRadius(cells, looks), histograms(cells, looks), callsOfCells(cells)),
  );
  const flights = section(
    "flights",
    "Free paths",
    null,
    grid(freePaths(report)),
  );
  const failures = failuresSection(report, looks, findings);
  const difficulties = difficultiesSection(report);
  const rest = [cellsSection(report, looks), manifestSection(report)];
  return report.kind === "bench"
    ? [speed, failures, findings?.element, findings?.cases, difficulties, flights, ...rest]
    : [findings?.element, flights, difficulties, findings?.cases, failures, speed, ...rest];
}

function contents(all) {
  return h(
    "nav",
    { class: "contents", "aria-label": "Sections" },
    all.map((s) => h("a", { href: `#${s.id}` }, s.querySelector("h2").textContent)),
  );
}

function show(report) {
  document.title = `${report.title ?? `lorentz ${report.kind}`}${report.verdict ? `: ${report.verdict}` : ""}`;
  const all = sections(report).filter(Boolean);
  document.querySelector("main").replaceChildren(head(report), all.length > 1 ? contents(all) : "", ...all);
}

document.getElementById("tools").append(themeSwitch());
watchCopyButtons();
try {
  show(readReport());
} catch (error) {
  console.error(error);
  document
    .querySelector("main")
    .replaceChildren(h("p", { role: "alert" }, `This report cannot be shown: ${error.message}`));
}
document.documentElement.dataset.ready = "yes"; // for the test
