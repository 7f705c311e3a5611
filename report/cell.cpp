#include "report/cell.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "src/exchange/exchange_json.hpp"
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

void add_times(json::Members& object, const CellTimes& ns) {
  object.add("median", ns.median, "q1", ns.q1, "q3", ns.q3, "mean", ns.mean);
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
  const auto measured = [&](const auto& value) { return cell.skipped ? std::nullopt : std::optional(value); };
  json::append(out, [&](json::Members& object) {
    object.add("scene", cell.scene, "radius", cell.radius, "dimension", cell.dimension, "difficulty",
               cell.difficulty, "engine", cell.engine, "queries", cell.queries, "skipped", cell.skipped,
               "unsupported", cell.unsupported);
    object.add("ns",
               cell.ns && !cell.skipped ? std::optional([&](json::Members& ns) { add_times(ns, *cell.ns); })
                                        : std::nullopt,
               "instructions", cell.skipped ? std::nullopt : cell.instructions, "mean_path",
               measured(cell.mean_path), "undecided", measured(cell.undecided), "ill_posed",
               measured(cell.ill_posed), "wrong", measured(cell.wrong), "wrong_time",
               measured(cell.wrong_time), "error", measured(cell.error), "missing", measured(cell.missing),
               "ulps", measured(members_of(cell.ulps)), "conditions", measured(members_of(cell.conditions)),
               "calls", measured(cell.calls), "worst",
               cell.worst && !cell.skipped
                   ? std::optional([&](json::Members& worst) { add_worst(worst, *cell.worst); })
                   : std::nullopt);
  });
}

namespace {

std::string text(json::Value value) {
  return std::string(value.text());
}

double number(json::Object& object, const char* key) {
  return read_number_or_infinity(object[key], "a number");
}

std::optional<double> number_or_null(json::Value value) {
  if (value.is_null()) return std::nullopt;
  return read_number_or_infinity(value, "a number");
}

std::size_t count(json::Object& object, const char* key) {
  return object[key].natural();
}

Share share(json::Object object) {
  return {count(object, "count"), number(object, "low"), number(object, "high")};
}

CellTimes times(json::Object object) {
  return {number(object, "median"), number(object, "q1"), number(object, "q3"), number(object, "mean")};
}

Histogram histogram(json::Object object) {
  Histogram histogram;
  histogram.exact = count(object, "exact");
  histogram.first = static_cast<int>(object["first"].integer());
  json::each_element(object["counts"].array(),
                     [&](json::Value bin) { histogram.counts.push_back(bin.natural()); });
  histogram.mean = number(object, "mean");
  histogram.p99 = number(object, "p99");
  histogram.max = number(object, "max");
  return histogram;
}

Worst worst(json::Object object) {
  return {text(object["verdict"]), number_or_null(object["ulps"]),
          std::string(object["query"].object().text()), text(object["command"])};
}

void read_measured(json::Object& object, Cell& cell) {
  if (json::Value value = object["ns"]; !value.is_null()) cell.ns = times(value.object());
  cell.instructions = number_or_null(object["instructions"]);
  cell.mean_path = number(object, "mean_path");
  cell.undecided = share(object["undecided"].object());
  cell.ill_posed = share(object["ill_posed"].object());
  cell.wrong = share(object["wrong"].object());
  cell.wrong_time = share(object["wrong_time"].object());
  cell.error = count(object, "error");
  cell.missing = count(object, "missing");
  cell.ulps = histogram(object["ulps"].object());
  cell.conditions = histogram(object["conditions"].object());
  cell.calls = calls_of(object["calls"].array());
  if (json::Value value = object["worst"]; !value.is_null()) cell.worst = worst(value.object());
}

}  // namespace

Cell cell_of(std::string_view text_of_cell) {
  try {
    json::Document document;
    document.open(text_of_cell);
    json::Object object = document.object();
    Cell cell;
    cell.scene = text(object["scene"]);
    cell.radius = number_or_null(object["radius"]);
    cell.dimension = static_cast<int>(object["dimension"].integer());
    cell.difficulty = text(object["difficulty"]);
    cell.engine = text(object["engine"]);
    cell.queries = count(object, "queries");
    cell.skipped = object["skipped"].boolean();
    cell.unsupported = count(object, "unsupported");
    if (!cell.skipped) read_measured(object, cell);
    return cell;
  } catch (const std::runtime_error& error) {  // InputError, NotJson, json::Error
    throw InputError(std::string("is not a cell of a table: ") + error.what());
  }
}

namespace {

bool fits(const Histogram& h, std::size_t most) {
  std::size_t left = most;
  const auto take = [&](std::size_t count) { return count <= left && ((left -= count), true); };
  if (!take(h.exact)) return false;
  for (const std::size_t count : h.counts)
    if (!take(count)) return false;
  const bool is_empty = left == most,
             ends = h.counts.empty() || (h.counts.front() > 0 && h.counts.back() > 0);
  if (is_empty) return h == Histogram();
  return ends && h.first >= -1074 && h.first < 1024 && h.mean >= 0 && h.mean <= h.max * (1 + 1e-9) &&
         h.p99 >= 0 && h.p99 <= h.max && std::isfinite(h.max) &&
         (h.counts.empty() ? h.max == 0
                           : std::ilogb(h.max) == h.first + static_cast<int>(h.counts.size()) - 1);
}

// True if the calls have no more of each verdict than the cell.
bool fits(const Calls& calls, const Cell& cell) {
  Call all;
  for (const auto& [decade, call] : calls.by_decade()) {
    if (call.total() == 0 || !(call.radii_off >= 0)) return false;
    for (const auto part : {&Call::right, &Call::ill_posed, &Call::wrong, &Call::undecided}) {
      if (call.*part > cell.queries) return false;
      all.*part += call.*part;
    }
  }
  return all.ill_posed <= cell.ill_posed.count && all.wrong <= cell.wrong.count &&
         all.undecided <= cell.undecided.count && all.total() <= cell.queries;
}

bool is_verdict(const std::string& text) {
  return text == "wrong" || text == "ill-posed" || text == "wrong-time" || text == "agree";
}

}  // namespace

std::string flaw_of(const Cell& cell, std::size_t most) {
  const std::size_t n = cell.queries;
  if (n > most || cell.unsupported > n) return "counts more queries than were asked";
  if (cell.skipped) return "";
  for (const Share* share : {&cell.undecided, &cell.ill_posed, &cell.wrong, &cell.wrong_time})
    if (share->count > n || !(*share == share_of(share->count, n)))
      return "has a share that is not one of its queries";
  if (cell.error > n || cell.missing > n ||
      cell.undecided.count + cell.ill_posed.count + cell.wrong.count + cell.unsupported + cell.error +
              cell.missing >
          n)
    return "counts more answers than queries";
  const CellTimes ns = cell.ns.value_or(CellTimes());
  if (!(ns.q1 >= 0 && ns.q1 <= ns.median && ns.median <= ns.q3 && ns.mean >= 0 &&
        std::isfinite(ns.q3 + ns.mean)))
    return "has times out of order";
  if (!(cell.instructions.value_or(0) >= 0) || !(cell.mean_path >= 0)) return "has a number below zero";
  if (!fits(cell.ulps, n) || !fits(cell.conditions, n))
    return "has a histogram that is not one of its answers";
  if (!fits(cell.calls, cell)) return "has calls that are not those of its answers";
  if (cell.worst && (!is_verdict(cell.worst->verdict) || !(cell.worst->ulps.value_or(0) >= 0)))
    return "has a worst input without a verdict";
  return "";
}

}  // namespace lorentz::report
