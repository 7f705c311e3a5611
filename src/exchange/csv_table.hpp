// A table in CSV: a line of names, then lines of fields. Private to the formats.
#pragma once

#include <deque>

#include <lorentz/line_reader.hpp>
#include "src/exchange/columns.hpp"

namespace lorentz {

/// The text as a field: in quotes if a reader would otherwise split or trim it.
std::string csv_field(const std::string& text);

class CsvTable {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Opens the file, or standard input for "-", reads its first line, and calls understand(*this). Throws
  /// FileError. Throws InputError, with the place, if there are no names, if a known name comes twice, or if
  /// understand() throws it.
  CsvTable(const std::string& path, const std::vector<std::string>& known,
           const std::function<void(CsvTable&)>& understand, const OnUnknownColumn& on_unknown_column);

  LineReader& lines() { return lines_; }
  const LineReader& lines() const { return lines_; }

  /// The number of a column. If there is no such column, `take` returns kNone, and `need` throws InputError,
  /// which says why it is needed.
  std::size_t take(const std::string& column) const;
  std::size_t need(const std::string& column, const char* why) const;

  /// Goes to the next line that is not blank; false at the end.
  bool next();
  std::size_t line() const { return line_.number; }

  /// Splits the line into fields. Throws InputError if there are not as many fields as names, or if a quote
  /// is not closed.
  void split();
  bool is_whole() const { return fields_.size() == names_.size(); }
  std::string_view field(std::size_t column) const { return fields_[column]; }  ///< without spaces and quotes

  /// The value of a field. These throw InputError, with the column.
  double number(std::size_t column) const;
  std::int64_t integer(std::size_t column) const;
  [[noreturn]] void refuse(std::size_t column, const char* why) const;

 private:
  std::vector<std::string> unknown_names(const std::vector<std::string>& known) const;
  void split(std::string_view text);
  std::size_t split_quoted(std::string_view text, std::size_t begin);

  LineReader lines_;
  LineReader::Line line_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  // fields that differ from their text in the line
};

}  // namespace lorentz
