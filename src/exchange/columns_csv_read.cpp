#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <lorentz/exchange.hpp>
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/exchange_number.hpp"
#include "src/exchange/input_file.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz {
namespace {

constexpr std::string_view kSpaces = " \t";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

std::string_view without_line_end(std::string_view text) {
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string shown(std::string_view text) {
  return json_quoted(shortened(text, 60));
}

std::string numbered(const char* name, int k) {
  return name + std::to_string(k + 1);
}

// Why a file's first line has no names of columns, if it is of a format that one may have meant.
std::string other_format(std::string_view text) {
  if (text.starts_with("\x93NUMPY")) return "this is a .npy file: --format npy reads it";
  if (trimmed(text).starts_with('{')) return "this looks like a stream in JSON: --format ndjson reads it";
  return {};
}

}  // namespace

std::vector<std::string> csv_query_columns(int dimension) {
  std::vector<std::string> names;
  for (const char* vector : {"x", "v"})
    for (int k = 0; k < dimension; ++k) names.push_back(numbered(vector, k));
  names.insert(names.end(), {"max_time", "from_lattice", "from_atom"});
  for (int k = 0; k < dimension; ++k) names.push_back(numbered("from_cell", k));
  names.push_back("id");
  return names;
}

CsvQueryReader::CsvQueryReader(const std::string& path, int dimension,
                               const OnUnknownColumn& on_unknown_column)
    : lines_(path), dimension_(dimension) {
  LineReader::Line line;
  do {
    if (!lines_.next(line)) throw InputError(lines_.name() + ": is empty: no line with names of columns");
  } while (trimmed(without_line_end(line.text)).empty() && !line.too_long);
  const std::string place = lines_.name() + ":" + std::to_string(line.number);
  try {
    if (line.too_long) throw InputError("the line is longer than 32 MiB");
    if (const std::string why = other_format(line.text); !why.empty()) throw InputError(why);
    split(without_line_end(line.text));
    for (const std::string& name : read_names()) on_unknown_column(place, name);
  } catch (const InputError& error) {
    throw InputError(place + ": " + error.what());
  }
  lines_.before_waiting([this] {
    if (!is_ready(lines_.descriptor())) before_waiting_();
  });
}

std::vector<std::string> CsvQueryReader::read_names() {
  names_.assign(fields_.begin(), fields_.end());
  std::vector<std::string> unknown;
  const std::vector<std::string> known = csv_query_columns(dimension_);
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (std::find(known.begin(), known.end(), names_[i]) == known.end())
      unknown.push_back(names_[i]);
    else if (std::find(names_.begin(), names_.begin() + i, names_[i]) != names_.begin() + i)
      throw InputError("there are two columns " + names_[i]);
  const std::string in_space = "queries in " + std::to_string(dimension_) + " dimensions need it";
  for (int k = 0; k < dimension_; ++k) x_[k] = need(numbered("x", k), in_space.c_str());
  for (int k = 0; k < dimension_; ++k) v_[k] = need(numbered("v", k), in_space.c_str());
  max_time_ = take("max_time"), id_ = take("id");
  const bool leaves = std::any_of(names_.begin(), names_.end(), [&](const std::string& name) {
    return name.starts_with("from_") && std::find(known.begin(), known.end(), name) != known.end();
  });
  if (!leaves) return unknown;
  constexpr const char* kTogether = "from_lattice, from_atom and the cell stand together";
  from_lattice_ = need("from_lattice", kTogether), from_atom_ = need("from_atom", kTogether);
  for (int k = 0; k < dimension_; ++k) from_cell_[k] = need(numbered("from_cell", k), kTogether);
  return unknown;
}

std::size_t CsvQueryReader::take(const std::string& column) {
  const auto place = std::find(names_.begin(), names_.end(), column);
  return place == names_.end() ? kNone : static_cast<std::size_t>(place - names_.begin());
}

std::size_t CsvQueryReader::need(const std::string& column, const char* why) {
  const std::size_t place = take(column);
  if (place == kNone) throw InputError("there is no column " + column + "; " + why);
  return place;
}

// A field in quotes that begins at `begin`; returns where it ends, at a comma or the end of the line.
std::size_t CsvQueryReader::split_quoted(std::string_view text, std::size_t begin) {
  std::string& field = unquoted_.emplace_back();
  for (std::size_t i = begin + 1; i < text.size(); ++i) {
    if (text[i] != '"') {
      field += text[i];
    } else if (i + 1 < text.size() && text[i + 1] == '"') {
      field += text[i++];
    } else {
      const std::size_t end = std::min(text.find(',', i), text.size());
      if (!trimmed(text.substr(i + 1, end - i - 1)).empty()) throw InputError("there is text behind a quote");
      fields_.push_back(field);
      return end;
    }
  }
  throw InputError("a quote is not closed");
}

void CsvQueryReader::split(std::string_view text) {
  fields_.clear(), unquoted_.clear();
  for (std::size_t begin = 0;;) {
    const std::size_t first = text.find_first_not_of(kSpaces, begin);
    std::size_t end;
    if (first != text.npos && text[first] == '"') {
      end = split_quoted(text, first);
    } else {
      end = std::min(text.find(',', begin), text.size());
      fields_.push_back(trimmed(text.substr(begin, end - begin)));
    }
    if (end == text.size()) return;
    begin = end + 1;
  }
}

bool CsvQueryReader::next(QueryRows& rows, std::size_t most) {
  const std::size_t before = rows.count;
  for (LineReader::Line line; rows.count < before + most && lines_.next(line);)
    if (line.too_long || !trimmed(without_line_end(line.text)).empty()) read_row(line, rows);
  return rows.count > before;
}

void CsvQueryReader::read_row(const LineReader::Line& line, QueryRows& rows) {
  Row row;
  try {
    row = row_of(line);
  } catch (const InputError& error) {
    rows.flaws.push_back({rows.count, error.what()});
    row = {};
    row.max_time = std::numeric_limits<double>::infinity();
  }
  rows.lines.push_back(line.number);
  push_back(row, rows);
}

CsvQueryReader::Row CsvQueryReader::row_of(const LineReader::Line& line) {
  if (line.too_long) throw InputError("the line is longer than 32 MiB");
  split(without_line_end(line.text));
  if (fields_.size() != names_.size())
    throw InputError("there are " + std::to_string(fields_.size()) + " fields, and " +
                     std::to_string(names_.size()) + " names of columns");
  Row row;
  for (int k = 0; k < dimension_; ++k) row.x[k] = number(x_[k]), row.v[k] = number(v_[k]);
  row.max_time = std::numeric_limits<double>::infinity();
  if (max_time_ != kNone && !fields_[max_time_].empty() && fields_[max_time_] != "inf") {
    row.max_time = number(max_time_);
    if (!(row.max_time > 0)) refuse(max_time_, "must be above zero");
  }
  if (from_lattice_ != kNone) read_from(row);
  return row;
}

void CsvQueryReader::refuse(std::size_t column, const char* why) const {
  throw InputError("column " + names_[column] + ": " + shown(fields_[column]) + " " + why);
}

double CsvQueryReader::number(std::size_t column) const {
  const std::string_view text = fields_[column];
  auto value = nearest_decimal(text);
  if (!value) value = nearest_hexadecimal(text);
  if (!value) refuse(column, "is no number");
  if (!std::isfinite(*value)) refuse(column, "is beyond the range of binary64");
  return *value;
}

// Digits; or, as tables write integers that once stood beside empty fields, a number that means one.
std::int64_t CsvQueryReader::integer(std::size_t column) const {
  const std::string_view text = fields_[column];
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::result_out_of_range) refuse(column, "does not fit 64 bits");
  if (status == std::errc{} && end == text.data() + text.size()) return value;
  const auto real = nearest_decimal(text);
  if (!real || !(std::fabs(*real) <= 0x1p53) || *real != std::floor(*real)) refuse(column, "is no integer");
  return static_cast<std::int64_t>(*real);
}

void CsvQueryReader::read_from(Row& row) const {
  std::vector<std::size_t> columns{from_lattice_, from_atom_};
  columns.insert(columns.end(), from_cell_.begin(), from_cell_.begin() + dimension_);
  const auto is_empty = [&](std::size_t column) { return fields_[column].empty(); };
  if (std::all_of(columns.begin(), columns.end(), is_empty)) return;
  const auto index = [&](std::size_t column) {
    const std::int64_t value = integer(column);
    if (value > std::numeric_limits<std::int32_t>::max())
      refuse(column, "is too large for a number in a scene");
    return static_cast<std::int32_t>(std::max<std::int64_t>(value, -1));
  };
  row.from_lattice = index(from_lattice_);
  if (row.from_lattice < 0) return;
  row.from_atom = index(from_atom_);
  for (int k = 0; k < dimension_; ++k) row.from_cell[k] = integer(from_cell_[k]);
}

void CsvQueryReader::push_back(const Row& row, QueryRows& rows) const {
  ++rows.count;
  for (int k = 0; k < dimension_; ++k) rows.x[k].push_back(row.x[k]), rows.v[k].push_back(row.v[k]);
  if (max_time_ != kNone) rows.max_time.push_back(row.max_time);
  if (id_ != kNone) rows.id.emplace_back(fields_.size() == names_.size() ? fields_[id_] : std::string_view());
  if (from_lattice_ == kNone) return;
  rows.from_lattice.push_back(row.from_lattice), rows.from_atom.push_back(row.from_atom);
  for (int k = 0; k < dimension_; ++k) rows.from_cell[k].push_back(row.from_cell[k]);
}

}  // namespace lorentz
