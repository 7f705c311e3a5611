// The page as one text: template, style and script, and between them %REPORT% where the report goes.
//   node build.mjs page_text.cpp   writes it as C++ source that defines lorentz::report::page_text
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const here = new URL(".", import.meta.url);
const text = (name) => readFileSync(new URL(name, here), "utf8");

async function bundled(entry) {
  const result = await build({
    absWorkingDir: here.pathname,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    logLevel: "warning",
    metafile: true,
  });
  return { text: result.outputFiles[0].text.trim(), inputs: Object.keys(result.metafile.inputs) };
}

// The licences of the bundled packages, as a comment, so that they stay with every copy of the page. Each
// text once.
function licences(inputs) {
  const packages = new Map();
  for (const name of new Set(
    inputs.map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]).filter(Boolean),
  )) {
    const file = readdirSync(new URL(`node_modules/${name}/`, here)).find((f) => /^licen[cs]e/i.test(f));
    if (!file) throw new Error(`${name} has no licence to pass on`);
    const licence = text(`node_modules/${name}/${file}`).trim();
    packages.set(licence, [...(packages.get(licence) ?? []), name]);
  }
  const comment = [...packages]
    .map(([licence, names]) => `${names.sort().join(", ")}:\n\n${licence}`)
    .join("\n\n");
  if (comment.includes("*/")) throw new Error("a licence would end its own comment");
  return `/*!\n${comment}\n*/\n`;
}

// Functions put the pieces in, so that a "$&" in a script is not a pattern. The policy allows this one script
// by its hash.
async function page() {
  const [main, { text: style }] = [await bundled("src/main.js"), await bundled("style.css")];
  const script = licences(main.inputs) + main.text;
  const hash = `sha256-${createHash("sha256").update(script).digest("base64")}`;
  if (/<\/script|%REPORT%/i.test(script) || /<\/style/i.test(style))
    throw new Error("the bundle would end its own element");
  return text("template.html")
    .replace("%SCRIPT_HASH%", () => hash)
    .replace("%STYLE%", () => style)
    .replace("%SCRIPT%", () => script);
}

function literal(piece) {
  const escapes = { '"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "?": "\\?" };
  const bytes = [...Buffer.from(piece, "utf8")];
  return bytes
    .map(
      (b) =>
        escapes[String.fromCharCode(b)] ??
        (b < 32 || b > 126 ? `\\${b.toString(8).padStart(3, "0")}` : String.fromCharCode(b)),
    )
    .join("");
}

function source(html) {
  const lines = html.match(/[\s\S]{1,2000}/gu).map((piece) => `    "${literal(piece)}"`);
  return `// Written by report/web/build.mjs.\n#include "report/page.hpp"\n\nnamespace lorentz::report {\n
extern const std::string_view page_text{\n${lines.join("\n")},\n    ${Buffer.byteLength(html)}};\n\n}  // namespace lorentz::report\n`;
}

writeFileSync(process.argv[2], source(await page()));
