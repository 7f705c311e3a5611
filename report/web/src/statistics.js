// The few statistics that a page computes; bounds of shares come with the report.

// Two-sided 95 % points of Student's t for 1 to 30 degrees of freedom.
const STUDENT = [
  12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131,
  2.12, 2.11, 2.101, 2.093, 2.086, 2.08, 2.074, 2.069, 2.064, 2.06, 2.056, 2.052, 2.048, 2.045, 2.042,
];

/**
 * y = c x^exponent, by least squares in the logarithms: {exponent, factor, low, high}; low and high are the 95 %
 * interval of the exponent, null if there are only two points. Null unless there are two different x.
 */
export function powerLaw(points) {
  const n = points.length;
  const xs = points.map(([x]) => Math.log(x)),
    ys = points.map(([, y]) => Math.log(y));
  const mean = (values) => values.reduce((a, b) => a + b, 0) / n;
  const mx = mean(xs),
    my = mean(ys);
  const sxx = xs.reduce((sum, x) => sum + (x - mx) ** 2, 0);
  if (n < 2 || !(sxx > 0)) return null;
  const exponent = xs.reduce((sum, x, i) => sum + (x - mx) * (ys[i] - my), 0) / sxx;
  const rest = xs.reduce((sum, x, i) => sum + (ys[i] - my - exponent * (x - mx)) ** 2, 0);
  const half = n > 2 ? (STUDENT[n - 3] ?? 1.96) * Math.sqrt(rest / (n - 2) / sxx) : null;
  return {
    exponent,
    factor: Math.exp(my - exponent * mx),
    low: half === null ? null : exponent - half,
    high: half === null ? null : exponent + half,
  };
}

/** The points with x and y that no other point beats in both, from left to right. */
export function paretoFront(points) {
  const front = [];
  for (const point of [...points].sort((a, b) => a.x - b.x || a.y - b.y))
    if (!front.length || point.y < front.at(-1).y) front.push(point);
  return front;
}

/** Sum of histograms: {exact, bins: Map of exponent to count, total, max, p99}; p99 is the largest of all. */
export function pooled(histograms) {
  const sum = { exact: 0, bins: new Map(), total: 0, max: 0, p99: 0 };
  for (const histogram of histograms) {
    sum.exact += histogram.exact ?? 0;
    (histogram.counts ?? []).forEach((count, i) => {
      const exponent = histogram.first + i;
      sum.bins.set(exponent, (sum.bins.get(exponent) ?? 0) + count);
    });
    sum.max = Math.max(sum.max, histogram.max ?? 0);
    sum.p99 = Math.max(sum.p99, histogram.p99 ?? 0);
  }
  sum.total = sum.exact + [...sum.bins.values()].reduce((a, b) => a + b, 0);
  return sum;
}
