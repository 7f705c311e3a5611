// A chart as a file: SVG in the light theme, or its numbers.

function save(name, type, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Colours are variables of the page, so a separate file needs their values.
function withColours(text) {
  const probe = document.createElement("span");
  probe.style.colorScheme = "light";
  document.body.append(probe);
  const values = new Map();
  const plain = text.replace(/var\((--[\w-]+)\)/g, (_, name) => {
    if (!values.has(name)) {
      probe.style.color = `var(${name})`;
      values.set(name, getComputedStyle(probe).color);
    }
    return values.get(name);
  });
  probe.remove();
  return plain;
}

export function svgText(svg, title) {
  const copy = svg.cloneNode(true);
  copy.querySelectorAll(".rings").forEach((ring) => ring.remove());
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("color", "#1b1f24");
  copy.setAttribute("font-family", "system-ui, Helvetica, Arial, sans-serif");
  copy.setAttribute("style", `${copy.getAttribute("style") ?? ""};background:white`);
  const name = document.createElementNS("http://www.w3.org/2000/svg", "title");
  name.textContent = title;
  copy.prepend(name);
  return withColours(new XMLSerializer().serializeToString(copy));
}

// A text that a spreadsheet would take for a formula is marked as text, because names may come from anyone.
function csvField(value) {
  if (value === null || value === undefined) return "";
  const text = typeof value === "string" && /^[=+@\t\r-]/.test(value) ? `'${value}` : String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csvText({ columns, rows }) {
  return [columns, ...rows].map((row) => row.map(csvField).join(",")).join("\r\n") + "\r\n";
}

export const saveSvg = (name, svg, title) => save(`${name}.svg`, "image/svg+xml", svgText(svg, title));
export const saveCsv = (name, table) => save(`${name}.csv`, "text/csv", csvText(table));
