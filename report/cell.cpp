#include "report/cell.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

Histogram histogram_of(const std::vector<double>& errors) {
  Histogram histogram;
  if (errors.empty()) return histogram;
  for (const double error : errors) {
    if (!(error >= 0) || std::isinf(error)) throw std::invalid_argument("histogram_of: no error");
    histogram.mean += error / static_cast<double>(errors.size());
  }
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  histogram.max = sorted.back();
  // The smallest error that 99 % of all do not exceed.
  histogram.p99 = sorted[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(sorted.size()))) - 1];
  const std::span<const double> inexact(std::upper_bound(sorted.begin(), sorted.end(), 0.0), sorted.end());
  histogram.exact = sorted.size() - inexact.size();
  if (inexact.empty()) return histogram;
  histogram.first = std::ilogb(inexact.front());
  histogram.counts.resize(static_cast<std::size_t>(std::ilogb(histogram.max) - histogram.first) + 1);
  for (const double error : inexact)
    ++histogram.counts[static_cast<std::size_t>(std::ilogb(error) - histogram.first)];
  return histogram;
}

namespace {

void add_times(json::Members& object, const question::Speed& speed) {
  object.add("median", speed.ns_median, "q1", speed.ns_low, "q3", speed.ns_high, "mean", speed.ns_per_query);
}

void add_worst(json::Members& object, const Worst& worst) {
  object.add("verdict", worst.verdict, "ulps", worst.ulps, "query", json::Raw{worst.query}, "command",
             worst.command);
}

auto members_of(const Histogram& its) {
  return [&its](json::Members& object) {
    object.add("exact", its.exact, "first", its.first, "counts", its.counts, "mean", its.mean, "p99", its.p99,
               "max", its.max);
  };
}

}  // namespace

void append_json(std::string& out, const Cell& cell) {
  // null for everything that was not measured
  const bool is_skipped = !cell.skipped.empty();
  const auto measured = [&](const auto& value) { return is_skipped ? std::nullopt : std::optional(value); };
  json::append(out, [&](json::Members& object) {
    object.add("scene", cell.scene, "radius", cell.radius, "dimension", cell.dimension, "difficulty",
               cell.difficulty, "engine", cell.engine, "queries", cell.queries, "outside_domain",
               cell.outside, "skipped", is_skipped);
    for (const question::CountName& name : question::names_counted(question::Counted::examinations))
      object.add_named(name.key, is_skipped && name.count != question::Count::unsupported
                                     ? std::nullopt
                                     : std::optional(share_of(cell.counts[name.count], cell.queries)));
    object.add("ns",
               cell.speed && !is_skipped
                   ? std::optional([&](json::Members& ns) { add_times(ns, *cell.speed); })
                   : std::nullopt,
               "mean_path", measured(cell.mean_path), "ulps", measured(members_of(cell.ulps)), "conditions",
               measured(members_of(cell.conditions)), "calls", measured(cell.calls), "worst",
               cell.worst && !is_skipped
                   ? std::optional([&](json::Members& worst) { add_worst(worst, *cell.worst); })
                   : std::nullopt);
  });
}

}  // namespace lorentz::report
