// Parts of columns, and tables that own their columns.
#include <lorentz/batch.hpp>

#include <algorithm>

namespace lorentz {
namespace {

template <class T>
std::span<T> part_of(std::span<T> column, std::size_t begin, std::size_t length = std::dynamic_extent) {
  return column.empty() ? column : column.subspan(begin, length);
}

}  // namespace

Query QueryColumns::query(std::size_t i, int dimension) const {
  Query query;
  const auto at = [i](const auto& column) { return column.empty() ? 0 : column[i]; };
  for (int k = 0; k < dimension; ++k) query.x[k] = at(x[k]), query.v[k] = at(v[k]);
  if (from_lattice.empty() || from_lattice[i] < 0) return query;
  query.from.emplace();
  query.from->lattice = from_lattice[i], query.from->atom = from_atom[i];
  for (int k = 0; k < dimension; ++k) query.from->cell[k] = at(from_cell[k]);
  return query;
}

QueryColumns QueryColumns::part(std::size_t begin, std::size_t length) const {
  QueryColumns part;
  for (int k = 0; k < 3; ++k) {
    part.x[k] = part_of(x[k], begin, length), part.v[k] = part_of(v[k], begin, length);
    part.from_cell[k] = part_of(from_cell[k], begin, length);
  }
  part.max_time = part_of(max_time, begin, length);
  part.from_lattice = part_of(from_lattice, begin, length);
  part.from_atom = part_of(from_atom, begin, length);
  return part;
}

FlightColumns FlightColumns::part(std::size_t begin) const {
  FlightColumns part;
  part.outcome = part_of(outcome, begin), part.stage = part_of(stage, begin);
  part.time_is_rounded = part_of(time_is_rounded, begin);
  part.lattice = part_of(lattice, begin), part.atom = part_of(atom, begin);
  part.time = part_of(time, begin);
  for (int k = 0; k < 3; ++k) part.cell[k] = part_of(cell[k], begin);
  return part;
}

void FlightColumns::set(std::size_t i, const Flight& flight) const {
  const auto put = [i](const auto& column, auto value) {
    if (!column.empty()) column[i] = value;
  };
  put(outcome, flight.outcome), put(stage, flight.stage), put(time_is_rounded, flight.time_is_rounded);
  put(lattice, flight.lattice), put(atom, flight.atom), put(time, flight.time);
  for (int k = 0; k < 3; ++k) put(cell[k], flight.cell[k]);
}

std::optional<std::string> flaw_of(const QueryColumns& queries, const FlightColumns& flights, int dimension) {
  const bool any_from =
      !queries.from_lattice.empty() || !queries.from_atom.empty() ||
      std::ranges::any_of(queries.from_cell, [](const auto& column) { return !column.empty(); });
  const std::size_t size = std::max({queries.x[0].size(), queries.x[1].size(), queries.v[0].size()});
  std::optional<std::string> flaw;  // the first
  const auto see = [&](std::size_t rows, const std::string& name, bool needed) {
    if (flaw || (rows == 0 && !needed)) return;
    flaw = rows == 0
               ? "the column " + name + " is missing"
               : "the column " + name + " has " + std::to_string(rows) + " rows, not " + std::to_string(size);
  };
  const auto asked = [&](const auto& column, const std::string& name, bool needed) {
    if (column.size() != size) see(column.size(), name, needed);
  };
  const auto told = [&](const auto& column, const std::string& name, bool needed = false) {
    if (column.size() < size) see(column.size(), name, needed);
  };
  asked(queries.max_time, "max_time", false);
  asked(queries.from_lattice, "from_lattice", any_from);
  asked(queries.from_atom, "from_atom", any_from);
  for (int k = 0; k < dimension; ++k) {
    const std::string component = "[" + std::to_string(k) + "]";
    asked(queries.x[k], "x" + component, true);
    asked(queries.v[k], "v" + component, true);
    asked(queries.from_cell[k], "from_cell" + component, any_from);
  }
  for (int k = 0; k < 3; ++k) told(flights.cell[k], "cell[" + std::to_string(k) + "]");
  told(flights.outcome, "outcome", true);
  told(flights.stage, "stage");
  told(flights.time_is_rounded, "time_is_rounded");
  told(flights.lattice, "lattice");
  told(flights.atom, "atom");
  told(flights.time, "time");
  return flaw;
}

void QueryTable::clear() {
  for (int k = 0; k < 3; ++k) x_[k].clear(), v_[k].clear(), from_cell_[k].clear();
  max_time_.clear(), from_lattice_.clear(), from_atom_.clear();
}

bool QueryTable::push_back(const Query& query, double max_time) {
  for (int k = 0; k < 3; ++k)
    if (query.from && !query.from->cell[k].fits_int64()) return false;
  if (max_time_.empty()) any_limit_ = any_from_ = false;  // new, cleared, or moved from
  for (int k = 0; k < 3; ++k) {
    x_[k].push_back(query.x[k]), v_[k].push_back(query.v[k]);
    from_cell_[k].push_back(query.from ? query.from->cell[k].int64() : 0);
  }
  max_time_.push_back(max_time);
  from_lattice_.push_back(query.from ? query.from->lattice : -1);
  from_atom_.push_back(query.from ? query.from->atom : 0);
  any_limit_ |= max_time != std::numeric_limits<double>::infinity();
  any_from_ |= query.from.has_value();
  return true;
}

Query QueryTable::operator[](std::size_t i) const {
  return columns().query(i, 3);
}

QueryColumns QueryTable::columns() const {
  QueryColumns columns;
  for (int k = 0; k < 3; ++k) columns.x[k] = x_[k], columns.v[k] = v_[k];
  if (any_limit_) columns.max_time = max_time_;
  if (!any_from_) return columns;
  columns.from_lattice = from_lattice_, columns.from_atom = from_atom_;
  for (int k = 0; k < 3; ++k) columns.from_cell[k] = from_cell_[k];
  return columns;
}

void FlightTable::resize(std::size_t count) {
  if (count > outcome_.size()) time_is_rounded_ = std::make_unique<bool[]>(count);
  outcome_.resize(count), stage_.resize(count), lattice_.resize(count), atom_.resize(count);
  for (auto& column : cell_) column.resize(count);
  time_.resize(count);
}

Flight FlightTable::operator[](std::size_t i) const {
  Flight flight;
  flight.outcome = outcome_[i], flight.stage = stage_[i], flight.time_is_rounded = time_is_rounded_[i];
  flight.lattice = lattice_[i], flight.atom = atom_[i];
  for (int k = 0; k < 3; ++k) flight.cell[k] = cell_[k][i];
  flight.time = time_[i];
  return flight;
}

FlightColumns FlightTable::columns() {
  FlightColumns columns;
  columns.outcome = outcome_, columns.stage = stage_;
  columns.time_is_rounded = {time_is_rounded_.get(), outcome_.size()};
  columns.lattice = lattice_, columns.atom = atom_;
  for (int k = 0; k < 3; ++k) columns.cell[k] = cell_[k];
  columns.time = time_;
  return columns;
}

}  // namespace lorentz
