// The page as one text: template, style and script, and between them %REPORT% where the report goes.
//   node build.mjs page_text.cpp   writes it as C++ source that defines lorentz::report::page_text
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const here = new URL(".", import.meta.url);
const text = (name) => readFileSync(new URL(name, here), "utf8");

async function bundled(entry) {
  const result = await build({
    absWorkingDir: here.pathname, entryPoints: [entry], bundle: true, minify: true, write: false,
    format: "iife", target: "es2022", charset: "utf8", legalComments: "none", logLevel: "warning",
  });
  return result.outputFiles[0].text.trim();
}

// Pieces are put in by functions: a "$&" in a script is no pattern. The policy allows this one script by its hash.
async function page() {
  const [script, style] = [await bundled("src/main.js"), await bundled("style.css")];
  const hash = `sha256-${createHash("sha256").update(script).digest("base64")}`;
  if (/<\/script|%REPORT%/i.test(script) || /<\/style/i.test(style)) throw new Error("the bundle would end its own element");
  return text("template.html").replace("%SCRIPT_HASH%", () => hash).replace("%STYLE%", () => style).replace("%SCRIPT%", () => script);
}

function literal(piece) {
  const escapes = { '"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "?": "\\?" };
  const bytes = [...Buffer.from(piece, "utf8")];
  return bytes.map((b) => escapes[String.fromCharCode(b)] ?? (b < 32 || b > 126 ? `\\${b.toString(8).padStart(3, "0")}` : String.fromCharCode(b))).join("");
}

function source(html) {
  const lines = html.match(/[\s\S]{1,2000}/gu).map((piece) => `    "${literal(piece)}"`);
  return `// Written by report/web/build.mjs.\n#include "report/page_text.hpp"\n\nnamespace lorentz::report {\n
extern const std::string_view page_text{\n${lines.join("\n")},\n    ${Buffer.byteLength(html)}};\n\n}  // namespace lorentz::report\n`;
}

writeFileSync(process.argv[2], source(await page()));
