#include "report/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lorentz::report {

std::string Table::text() const {
  std::vector<std::size_t> width(rows_[0].size(), 0);
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], width_of(row[i]));
  std::string out;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t i = 0; i < rows_[r].size(); ++i)
      if (prose_ && i + 1 == width.size())
        out += "  " + rows_[r][i];
      else
        out += i == 0 ? fmt::format("{:<{}}", rows_[r][i], width[i])
                      : fmt::format("  {:>{}}", rows_[r][i], width[i]);
    out += '\n';
    if (r > 0) continue;
    for (std::size_t i = 0; i < width.size(); ++i) out += (i == 0 ? "" : "  ") + std::string(width[i], '-');
    out += '\n';
  }
  return out;
}

}  // namespace lorentz::report
