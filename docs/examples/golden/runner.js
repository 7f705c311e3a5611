// Judges answers with a golden set alone (docs/golden.md).
//   node runner.js SET ANSWERS [ULPS]: a line for each record, its id and a verdict; the counts on stderr.
//   ULPS is above 0 and at most 16. Status 1: an answer is wrong, missing, or an error; 2: a file is unfit.
"use strict";
const fs = require("node:fs");

const [setFile, answerFile, ulps = "4"] = process.argv.slice(2);
if (!answerFile || !(ulps > 0 && ulps <= 16)) refuse("usage: runner.js SET ANSWERS [ULPS]; ULPS is above 0 and at most 16");

function refuse(why) {
  console.error(why);
  process.exit(2);
}

function lines(file) {
  let number = 0;
  try {
    return fs.readFileSync(file, "utf8").split("\n").flatMap((line) => (++number, line.trim() ? [JSON.parse(line)] : []));
  } catch (why) {
    return refuse(`${file}:${number}: ${why.message}`);
  }
}

const same = (a, b) =>
  a.outcome === b.outcome && a.lattice === b.lattice && a.atom === b.atom && (a.cell ?? []).join() === (b.cell ?? []).join();

function ulp(t, bits) {
  const exponent = Math.floor(Math.log2(t)); // may be off by one beside a power of two
  const power = 2 ** exponent > t ? exponent - 1 : 2 ** (exponent + 1) <= t ? exponent + 1 : exponent;
  return bits === 24 ? 2 ** (Math.max(power, -126) - 23) : 2 ** Math.max(power - 52, -1074);
}

const LARGEST = 3.4028235677973366e38; // from here on a binary32 is infinite

function isWrongTime(record, answer, k, bits) {
  const t = record.expect.time;
  if (t === undefined || answer.time === undefined) return false;
  if (t === "inf" || (answer.time === "inf" && bits === 24 && t > LARGEST)) return answer.time !== "inf";
  const given = typeof answer.time === "number" ? answer.time : Infinity;
  return !(Math.abs(given - t) <= k * Math.max(record.time_change ?? 0, ulp(t, bits)));
}

function verdict(record, answer, k, bits) {
  if (!answer) return "missing";
  if (answer.outcome === "undecided" || answer.outcome === "later") return "undecided";
  if (answer.outcome === "error" && record.expect.outcome !== "error")
    return answer.reason === "unsupported" ? "unsupported" : "error";
  if (same(answer, record.expect)) return isWrongTime(record, answer, k, bits) ? "wrong-time" : "agree";
  if ((record.acceptable ?? []).some((other) => same(answer, other) && other.ulps <= k)) return "ill-posed";
  return record.tags.includes("needs-judge") ? "needs-judge" : "wrong";
}

const answers = new Map();
for (const answer of lines(answerFile).filter((line) => typeof line?.id === "string")) {
  if (answers.has(answer.id)) refuse(`${answerFile}: the id ${answer.id} comes twice`);
  answers.set(answer.id, answer);
}
const [first, ...others] = lines(setFile);
const records = others.filter((line) => line.expect);
if (first?.golden?.count !== records.length)
  refuse(`${setFile}: needs a first line with \`golden\`, and as many records as its \`count\``);
const bits = first.golden.precision === "binary32" ? 24 : 53;
const counts = {};
for (const record of records) {
  const found = verdict(record, answers.get(record.id), Number(ulps), bits);
  counts[found] = (counts[found] ?? 0) + 1;
  console.log(record.id, found);
}
console.error(counts);
process.exitCode = counts.wrong || counts.missing || counts.error ? 1 : 0;
