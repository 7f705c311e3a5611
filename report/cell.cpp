#include "report/cell.hpp"

#include <fmt/format.h>

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

std::string text(json::value value) {
  return std::string(std::string_view(value));
}

std::optional<double> number_or_null(json::value value) {
  if (value.is_null()) return std::nullopt;
  return read_number(value, "cell");
}

double number(json::object& object, const char* key) {
  return read_number(object[key], key);
}

std::size_t count(json::object& object, const char* key) {
  return std::uint64_t(object[key]);
}

Share share(json::object object) {
  Share share;
  share.count = count(object, "count");
  share.low = number(object, "low");
  share.high = number(object, "high");
  return share;
}

Times times(json::object object) {
  Times ns;
  ns.median = number(object, "median");
  ns.q1 = number(object, "q1");
  ns.q3 = number(object, "q3");
  ns.mean = number(object, "mean");
  return ns;
}

Histogram histogram(json::object object) {
  Histogram histogram;
  histogram.exact = count(object, "exact");
  histogram.first = static_cast<int>(std::int64_t(object["first"]));
  for (std::uint64_t bin : json::array(object["counts"])) histogram.counts.push_back(bin);
  histogram.mean = number(object, "mean");
  histogram.p99 = number(object, "p99");
  histogram.max = number(object, "max");
  return histogram;
}

Worst worst(json::object object) {
  Worst worst;
  worst.verdict = text(object["verdict"]);
  worst.ulps = number_or_null(object["ulps"]);
  worst.query = std::string(std::string_view(json::object(object["query"]).raw_json()));
  worst.command = text(object["command"]);
  return worst;
}

void read_measured(json::object& object, Cell& cell) {
  cell.ns = times(object["ns"]);
  cell.instructions = number_or_null(object["instructions"]);
  cell.mean_path = number(object, "mean_path");
  cell.undecided = share(object["undecided"]);
  cell.ill_posed = share(object["ill_posed"]);
  cell.wrong = share(object["wrong"]);
  cell.wrong_time = share(object["wrong_time"]);
  cell.error = count(object, "error");
  cell.missing = count(object, "missing");
  cell.ulps = histogram(object["ulps"]);
  cell.conditions = histogram(object["conditions"]);
  if (json::value value = object["worst"]; !value.is_null()) cell.worst = worst(value);
}

}  // namespace

Cell cell_of(std::string_view text_of_cell) {
  try {
    const simdjson::padded_string padded(text_of_cell);
    json::parser parser;
    json::document document = parser.iterate(padded);
    json::object object = document.get_object();
    Cell cell;
    cell.scene = text(object["scene"]);
    cell.radius = number_or_null(object["radius"]);
    cell.dimension = static_cast<int>(std::int64_t(object["dimension"]));
    cell.difficulty = text(object["difficulty"]);
    cell.engine = text(object["engine"]);
    cell.queries = count(object, "queries");
    cell.skipped = bool(object["skipped"]);
    cell.unsupported = count(object, "unsupported");
    if (!cell.skipped) read_measured(object, cell);
    return cell;
  } catch (const simdjson::simdjson_error& error) {
    throw InputError(std::string("no cell of a table: ") + error.what());
  }
}

}  // namespace lorentz::report
