#include "src/exchange/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_number.hpp"
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

// Why a file's first line has no column names, if the file is in another format that the user may have meant.
std::string other_format(std::string_view text) {
  if (text.starts_with("\x93NUMPY")) return "this is a .npy file: --format npy reads it";
  if (trimmed(text).starts_with('{')) return "this looks like a stream in JSON: --format ndjson reads it";
  return {};
}

}  // namespace

CsvTable::CsvTable(const std::string& path, const std::vector<std::string>& known,
                   const std::function<void(CsvTable&)>& understand, const OnUnknownColumn& on_unknown_column)
    : lines_(path) {
  do {
    if (!lines_.next(line_)) throw InputError(lines_.name() + ": is empty: no line with names of columns");
  } while (trimmed(without_line_end(line_.text)).empty() && !line_.too_long);
  const std::string place = lines_.name() + ":" + std::to_string(line_.number);
  try {
    if (line_.too_long) throw InputError("the line is longer than 32 MiB");
    if (const std::string why = other_format(line_.text); !why.empty()) throw InputError(why);
    split(without_line_end(line_.text));
    names_.assign(fields_.begin(), fields_.end());
    const std::vector<std::string> unknown = unknown_names(known);
    understand(*this);
    for (const std::string& name : unknown) on_unknown_column(place, name);
  } catch (const InputError& error) {
    throw InputError(place + ": " + error.what());
  }
}

std::vector<std::string> CsvTable::unknown_names(const std::vector<std::string>& known) const {
  std::vector<std::string> unknown;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (std::find(known.begin(), known.end(), names_[i]) == known.end())
      unknown.push_back(names_[i]);
    else if (std::find(names_.begin(), names_.begin() + i, names_[i]) != names_.begin() + i)
      throw InputError("there are two columns " + names_[i]);
  return unknown;
}

std::size_t CsvTable::take(const std::string& column) const {
  const auto place = std::find(names_.begin(), names_.end(), column);
  return place == names_.end() ? kNone : static_cast<std::size_t>(place - names_.begin());
}

std::size_t CsvTable::need(const std::string& column, const char* why) const {
  const std::size_t place = take(column);
  if (place == kNone) throw InputError("there is no column " + column + "; " + why);
  return place;
}

// Reads a field in quotes that begins at `begin`. Returns where it ends, at a comma or the end of the line.
std::size_t CsvTable::split_quoted(std::string_view text, std::size_t begin) {
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

void CsvTable::split(std::string_view text) {
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

bool CsvTable::next() {
  fields_.clear(), unquoted_.clear();
  while (lines_.next(line_))
    if (line_.too_long || !trimmed(without_line_end(line_.text)).empty()) return true;
  return false;
}

void CsvTable::split() {
  if (line_.too_long) throw InputError("the line is longer than 32 MiB");
  split(without_line_end(line_.text));
  if (fields_.size() != names_.size())
    throw InputError("there are " + std::to_string(fields_.size()) + " fields, and " +
                     std::to_string(names_.size()) + " names of columns");
}

void CsvTable::refuse(std::size_t column, const char* why) const {
  throw InputError("column " + names_[column] + ": " + shown(fields_[column]) + " " + why);
}

double CsvTable::number(std::size_t column) const {
  const std::string_view text = fields_[column];
  auto value = nearest_decimal(text);
  if (!value) value = nearest_hexadecimal(text);
  if (!value) refuse(column, "is not a number");
  if (!std::isfinite(*value)) refuse(column, "is beyond the range of binary64");
  return *value;
}

// Accepts digits, or a number with an integer value, because tables write integers that way if they once
// stood beside empty fields.
std::int64_t CsvTable::integer(std::size_t column) const {
  const std::string_view text = fields_[column];
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::result_out_of_range) refuse(column, "does not fit 64 bits");
  if (status == std::errc{} && end == text.data() + text.size()) return value;
  const auto real = nearest_decimal(text);
  if (!real || !(std::fabs(*real) <= 0x1p53) || *real != std::floor(*real))
    refuse(column, "is not an integer");
  return static_cast<std::int64_t>(*real);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos && trimmed(text) == text) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace lorentz
