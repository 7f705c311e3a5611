// The program and machine that made the report, so that others can reproduce it.
import { h, section } from "./dom.js";
import { command } from "./finding.js";

export function manifestSection(report) {
  const { command: line, ...rest } = report.manifest ?? {};
  const entries = Object.entries(rest).filter(([, value]) => value !== null && value !== "");
  if (!entries.length && !line) return null;
  return section(
    "manifest",
    "How this was made",
    null,
    line && command(line),
    h(
      "dl",
      { class: "manifest" },
      entries.map(([name, value]) =>
        h(
          "div",
          {},
          h("dt", {}, name),
          h("dd", {}, typeof value === "object" ? JSON.stringify(value) : String(value)),
        ),
      ),
    ),
  );
}
