// Numbers for people.

const SUPERSCRIPTS = {
  "-": "⁻",
  0: "⁰",
  1: "¹",
  2: "²",
  3: "³",
  4: "⁴",
  5: "⁵",
  6: "⁶",
  7: "⁷",
  8: "⁸",
  9: "⁹",
};
export const superscript = (integer) => [...String(integer)].map((c) => SUPERSCRIPTS[c]).join("");

export const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

/** A number with `digits` significant digits; powers of ten instead of many zeros. */
export function number(value, digits = 3) {
  if (!isNumber(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e6) return count(value);
  if (size >= 1e4 && size < 1e6) return count(Number(value.toPrecision(Math.max(digits, 4))));
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const factor = String(Number(mantissa));
  const power = `10${superscript(Number(exponent))}`;
  return (factor === "1" ? power : factor === "-1" ? `−${power}` : `${factor} × ${power}`).replace("-", "−");
}

/** A number of ulps; beyond 2^20 it says nothing, as for times near 0. */
export const ulps = (value) =>
  !isNumber(value) ? "–" : value < 2 ** 20 ? `${number(value)} ulps` : "2²⁰ ulps or more";

/** 1234567 as 1 234 567, with narrow spaces that do not break. */
export function count(value) {
  return isNumber(value)
    ? String(value)
        .replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f")
        .replace("-", "−")
    : "–";
}

/** A duration given in nanoseconds. */
export function duration(ns) {
  if (!isNumber(ns)) return "–";
  const units = [
    [1e9, "s"],
    [1e6, "ms"],
    [1e3, "µs"],
    [1, "ns"],
  ];
  const [size, unit] = units.find(([size]) => ns >= size) ?? units[3];
  return `${number(ns / size)}\u202f${unit}`;
}

/** A share between 0 and 1. */
export function percent(share) {
  if (!isNumber(share)) return "–";
  if (share === 0) return "0";
  return share >= 1e-4 ? `${Number((100 * share).toPrecision(3))}\u202f%` : number(share, 2);
}

/** A tick of a logarithmic axis. */
export function powerTick(value) {
  const exponent = Math.round(Math.log10(value));
  if (Math.abs(Math.log10(value) - exponent) > 1e-9) return number(value);
  return exponent >= 0 && exponent <= 3 ? String(10 ** exponent) : `10${superscript(exponent)}`;
}

/** "0x1.8p-1" as 0.75; NaN for another text. Exact: the digits are those of one binary64. */
export function fromHexadecimal(text) {
  const parts = /^\s*([+-]?)0x([0-9a-f]*)\.?([0-9a-f]*)(?:p([+-]?\d+))?\s*$/i.exec(text);
  if (!parts || !(parts[2] + parts[3])) return NaN;
  const digits = BigInt(`0x${parts[2] + parts[3]}`);
  const exponent = Number(parts[4] ?? 0) - 4 * parts[3].length;
  const scaled =
    exponent < -1000 ? Number(digits) * 2 ** -1000 * 2 ** (exponent + 1000) : Number(digits) * 2 ** exponent;
  return parts[1] === "-" ? -scaled : scaled;
}
