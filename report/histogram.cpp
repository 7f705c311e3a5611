#include "report/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

Histogram histogram_of(const std::vector<double>& errors) {
  Histogram histogram;
  if (errors.empty()) return histogram;
  std::map<int, std::size_t> bins;  // by the binary exponent
  for (const double error : errors) {
    if (!(error >= 0) || std::isinf(error)) throw std::invalid_argument("histogram_of: no error");
    histogram.mean += error / static_cast<double>(errors.size());
    if (error == 0)
      ++histogram.exact;
    else
      ++bins[std::ilogb(error)];
  }
  if (!bins.empty()) {
    histogram.first = bins.begin()->first;
    histogram.counts.resize(static_cast<std::size_t>(bins.rbegin()->first - histogram.first) + 1);
    for (const auto& [exponent, count] : bins)
      histogram.counts[static_cast<std::size_t>(exponent - histogram.first)] = count;
  }
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  histogram.max = sorted.back();
  // The smallest error that 99 % of all do not exceed.
  histogram.p99 = sorted[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(sorted.size()))) - 1];
  return histogram;
}

void append_json(std::string& out, const Histogram& histogram) {
  json::append(out, [&](json::Members& object) {
    object.add("exact", histogram.exact, "first", histogram.first, "counts", histogram.counts, "mean",
               histogram.mean, "p99", histogram.p99, "max", histogram.max);
  });
}

}  // namespace lorentz::report
