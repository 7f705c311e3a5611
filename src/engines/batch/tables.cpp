// Columns: parts of them, and columns of one's own.
#include <algorithm>
#include <cmath>

#include <lorentz/batch.hpp>

namespace lorentz {
namespace {

template <class T>
void advance(T*& column, std::size_t by) {
  if (column) column += by;
}

}  // namespace

Query QueryColumns::query(std::size_t i, int dimension) const {
  Query query;
  for (int k = 0; k < dimension; ++k) query.x[k] = x[k][i], query.v[k] = v[k][i];
  if (!from_lattice || from_lattice[i] < 0) return query;
  query.from.emplace();
  query.from->lattice = from_lattice[i], query.from->atom = from_atom[i];
  for (int k = 0; k < dimension; ++k) query.from->cell[k] = from_cell[k][i];
  return query;
}

QueryColumns QueryColumns::part(std::size_t begin, std::size_t length) const {
  QueryColumns part = *this;
  part.count = length;
  for (int k = 0; k < 3; ++k)
    advance(part.x[k], begin), advance(part.v[k], begin), advance(part.from_cell[k], begin);
  advance(part.max_time, begin), advance(part.from_lattice, begin), advance(part.from_atom, begin);
  return part;
}

FlightColumns FlightColumns::part(std::size_t begin) const {
  FlightColumns part = *this;
  advance(part.outcome, begin), advance(part.stage, begin), advance(part.time_is_rounded, begin);
  advance(part.lattice, begin), advance(part.atom, begin), advance(part.time, begin);
  for (int k = 0; k < 3; ++k) advance(part.cell[k], begin);
  return part;
}

void QueryTable::clear() {
  any_limit_ = any_from_ = false;
  for (int k = 0; k < 3; ++k) x_[k].clear(), v_[k].clear(), from_cell_[k].clear();
  max_time_.clear(), from_lattice_.clear(), from_atom_.clear();
}

bool QueryTable::push_back(const Query& query, double max_time) {
  for (int k = 0; k < 3; ++k)
    if (query.from && !query.from->cell[k].fits_int64()) return false;
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
  columns.count = size();
  for (int k = 0; k < 3; ++k) columns.x[k] = x_[k].data(), columns.v[k] = v_[k].data();
  if (any_limit_) columns.max_time = max_time_.data();
  if (!any_from_) return columns;
  columns.from_lattice = from_lattice_.data(), columns.from_atom = from_atom_.data();
  for (int k = 0; k < 3; ++k) columns.from_cell[k] = from_cell_[k].data();
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
  columns.outcome = outcome_.data(), columns.stage = stage_.data();
  columns.time_is_rounded = time_is_rounded_.get();
  columns.lattice = lattice_.data(), columns.atom = atom_.data();
  for (int k = 0; k < 3; ++k) columns.cell[k] = cell_[k].data();
  columns.time = time_.data();
  return columns;
}

}  // namespace lorentz
