#include <algorithm>
#include <limits>

#include <lorentz/exchange.hpp>
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/input_file.hpp"

namespace lorentz {
namespace {

constexpr std::size_t kNone = CsvTable::kNone;

std::string numbered(const char* name, int k) {
  return name + std::to_string(k + 1);
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

CsvQueryReader::CsvQueryReader(const std::string& path, const Components& components,
                               const OnUnknownColumn& on_unknown_column)
    : components_(components),
      dimension_(components.of_vectors()),
      table_(
          path, csv_query_columns(dimension_), [this](CsvTable& table) { understand(table); },
          on_unknown_column) {
  table_.lines().before_waiting([this] {
    if (!is_ready(table_.lines().descriptor())) before_waiting_();
  });
}

void CsvQueryReader::understand(const CsvTable& table) {
  const std::string in_space = "queries in " + std::to_string(dimension_) + " dimensions need it";
  for (int k = 0; k < dimension_; ++k) x_[k] = table.need(numbered("x", k), in_space.c_str());
  for (int k = 0; k < dimension_; ++k) v_[k] = table.need(numbered("v", k), in_space.c_str());
  max_time_ = table.take("max_time"), id_ = table.take("id");
  const std::vector<std::string> known = csv_query_columns(dimension_);
  const bool leaves = std::any_of(known.begin(), known.end(), [&](const std::string& name) {
    return name.starts_with("from_") && table.take(name) != kNone;
  });
  if (!leaves) return;
  constexpr const char* kTogether = "from_lattice, from_atom and the cell stand together";
  from_lattice_ = table.need("from_lattice", kTogether), from_atom_ = table.need("from_atom", kTogether);
  for (int k = 0; k < dimension_; ++k) from_cell_[k] = table.need(numbered("from_cell", k), kTogether);
}

bool CsvQueryReader::next(QueryRows& rows, std::size_t most) {
  const std::size_t before = rows.count;
  while (rows.count < before + most && table_.next()) read_row(rows);
  return rows.count > before;
}

void CsvQueryReader::read_row(QueryRows& rows) {
  Row row;
  try {
    table_.split();
    row = row_of();
  } catch (const InputError& error) {
    rows.flaws.push_back({rows.count, error.what()});
    row = {};
  }
  rows.lines.push_back(table_.line());
  push_back(row, rows);
}

CsvQueryReader::Row CsvQueryReader::row_of() const {
  Row row;
  for (int k = 0; k < dimension_; ++k) row.x[k] = table_.number(x_[k]), row.v[k] = table_.number(v_[k]);
  if (max_time_ != kNone && !table_.field(max_time_).empty() && table_.field(max_time_) != "inf") {
    row.max_time = table_.number(max_time_);
    if (!(row.max_time > 0)) table_.refuse(max_time_, "must be above zero");
  }
  if (from_lattice_ != kNone) read_from(row);
  return row;
}

void CsvQueryReader::read_from(Row& row) const {
  std::vector<std::size_t> columns{from_lattice_, from_atom_};
  columns.insert(columns.end(), from_cell_.begin(), from_cell_.begin() + dimension_);
  const auto is_empty = [&](std::size_t column) { return table_.field(column).empty(); };
  if (std::all_of(columns.begin(), columns.end(), is_empty)) return;
  const auto index = [&](std::size_t column) {
    const std::int64_t value = table_.integer(column);
    if (value > std::numeric_limits<std::int32_t>::max())
      table_.refuse(column, "is too large for a number in a scene");
    return static_cast<std::int32_t>(std::max<std::int64_t>(value, -1));
  };
  row.from_lattice = index(from_lattice_);
  if (row.from_lattice < 0) return;
  row.from_atom = index(from_atom_);
  for (int k = 0; k < dimension_; ++k)
    if (k < components_.of_cells(row.from_lattice) || !table_.field(from_cell_[k]).empty())
      row.from_cell[k] = table_.integer(from_cell_[k]);
}

void CsvQueryReader::push_back(const Row& row, QueryRows& rows) const {
  ++rows.count;
  for (int k = 0; k < dimension_; ++k) rows.x[k].push_back(row.x[k]), rows.v[k].push_back(row.v[k]);
  if (max_time_ != kNone) rows.max_time.push_back(row.max_time);
  if (id_ != kNone) rows.id.emplace_back(table_.is_whole() ? table_.field(id_) : std::string_view());
  if (from_lattice_ == kNone) return;
  rows.from_lattice.push_back(row.from_lattice), rows.from_atom.push_back(row.from_atom);
  for (int k = 0; k < dimension_; ++k) rows.from_cell[k].push_back(row.from_cell[k]);
}

}  // namespace lorentz
