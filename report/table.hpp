// Aligned text tables for people.
#pragma once

#include <string>
#include <vector>

#include "src/problem/safe_text.hpp"

namespace lorentz::report {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  /// Escapes characters that act on a terminal.
  void add(std::vector<std::string> row) {
    for (std::string& text : row) text = printable(text);
    rows_.push_back(std::move(row));
  }

  /// The last column is prose and is aligned to the left.
  Table& with_prose() {
    prose_ = true;
    return *this;
  }

  /// The first column is aligned to the left, the others to the right; the header is underlined.
  std::string text() const;

 private:
  bool prose_ = false;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace lorentz::report
