#include "report/cell.hpp"

#include <fmt/format.h>

#include <cmath>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz::report {
namespace {

void append(std::string& out, const char* key, double value) {
  out += fmt::format("\"{}\":", key);
  append_number(out, value);
}

void append_times(std::string& out, const Times& ns) {
  append(out, "median", ns.median);
  append(out += ',', "q1", ns.q1);
  append(out += ',', "q3", ns.q3);
  append(out += ',', "mean", ns.mean);
}

void append_worst(std::string& out, const Worst& worst) {
  out += fmt::format("{{\"verdict\":{},\"ulps\":", json_quoted(worst.verdict));
  if (worst.ulps)
    append_number(out, *worst.ulps);
  else
    out += "null";
  out += fmt::format(",\"query\":{},\"command\":{}}}", worst.query, json_quoted(worst.command));
}

void append_measured(std::string& out, const Cell& cell) {
  append_times(out += ",\"ns\":{", cell.ns);
  out += "},\"instructions\":";
  if (cell.instructions)
    append_number(out, *cell.instructions);
  else
    out += "null";
  append(out += ',', "mean_path", cell.mean_path);
  append_share(out += ",\"undecided\":", cell.undecided);
  append_share(out += ",\"ill_posed\":", cell.ill_posed);
  append_share(out += ",\"wrong\":", cell.wrong);
  append_share(out += ",\"wrong_time\":", cell.wrong_time);
  out += fmt::format(",\"error\":{},\"missing\":{}", cell.error, cell.missing);
  append_histogram(out += ",\"ulps\":", cell.ulps);
  append_histogram(out += ",\"conditions\":", cell.conditions);
  out += ",\"worst\":";
  if (cell.worst)
    append_worst(out, *cell.worst);
  else
    out += "null";
}

constexpr const char* kNotMeasured =
    ",\"ns\":null,\"instructions\":null,\"mean_path\":null,\"undecided\":null,\"ill_posed\":null,"
    "\"wrong\":null,\"wrong_time\":null,\"error\":null,\"missing\":null,\"ulps\":null,"
    "\"conditions\":null,\"worst\":null";

}  // namespace

void append_cell(std::string& out, const Cell& cell) {
  out += fmt::format("{{\"scene\":{},\"radius\":", json_quoted(cell.scene));
  if (cell.radius)
    append_number(out, *cell.radius);
  else
    out += "null";
  out += fmt::format(
      ",\"dimension\":{},\"difficulty\":{},\"engine\":{},\"queries\":{},\"skipped\":{},\"unsupported\":{}",
      cell.dimension, json_quoted(cell.difficulty), json_quoted(cell.engine), cell.queries, cell.skipped,
      cell.unsupported);
  if (cell.skipped)
    out += kNotMeasured;
  else
    append_measured(out, cell);
  out += '}';
}

namespace {

std::string text(json::Value value) {
  return std::string(value.text());
}

// What append_number wrote.
double number(json::Value value) {
  if (value.type() == json::Type::string && value.text() == "inf") return HUGE_VAL;
  return read_number(value, "a number");
}

std::optional<double> number_or_null(json::Value value) {
  if (value.is_null()) return std::nullopt;
  return number(value);
}

double number(json::Object& object, const char* key) {
  return number(object[key]);
}

std::size_t count(json::Object& object, const char* key) {
  return object[key].natural();
}

Share share(json::Object object) {
  Share share;
  share.count = count(object, "count");
  share.low = number(object, "low");
  share.high = number(object, "high");
  return share;
}

Times times(json::Object object) {
  Times ns;
  ns.median = number(object, "median");
  ns.q1 = number(object, "q1");
  ns.q3 = number(object, "q3");
  ns.mean = number(object, "mean");
  return ns;
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
  Worst worst;
  worst.verdict = text(object["verdict"]);
  worst.ulps = number_or_null(object["ulps"]);
  worst.query = std::string(object["query"].object().text());
  worst.command = text(object["command"]);
  return worst;
}

void read_measured(json::Object& object, Cell& cell) {
  cell.ns = times(object["ns"].object());
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
  const Times& ns = cell.ns;
  if (!(ns.q1 >= 0 && ns.q1 <= ns.median && ns.median <= ns.q3 && ns.mean >= 0 &&
        std::isfinite(ns.q3 + ns.mean)))
    return "has times out of order";
  if (!(cell.instructions.value_or(0) >= 0) || !(cell.mean_path >= 0)) return "has a number below zero";
  if (!fits(cell.ulps, n) || !fits(cell.conditions, n))
    return "has a histogram that is not one of its answers";
  if (cell.worst && (!is_verdict(cell.worst->verdict) || !(cell.worst->ulps.value_or(0) >= 0)))
    return "has a worst input without a verdict";
  return "";
}

}  // namespace lorentz::report
