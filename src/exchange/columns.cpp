#include "src/exchange/columns.hpp"

#include <algorithm>
#include <limits>

namespace lorentz {

void QueryRows::clear() {
  count = 0;
  for (int k = 0; k < 3; ++k) x[k].clear(), v[k].clear(), from_cell[k].clear();
  max_time.clear(), from_lattice.clear(), from_atom.clear(), large_from.clear();
  id.clear(), flaws.clear(), lines.clear();
}

void QueryRows::resize(std::size_t rows, int dimension, bool with_from) {
  count = rows;
  const std::size_t length = std::max(rows, x[0].size()), of_from = with_from ? length : 0;
  for (int k = 0; k < dimension; ++k) x[k].resize(length), v[k].resize(length), from_cell[k].resize(of_from);
  from_lattice.resize(of_from), from_atom.resize(of_from);
}

void QueryRows::set(std::size_t i, const Query& query, int dimension) {
  for (int k = 0; k < dimension; ++k) x[k][i] = query.x[k], v[k][i] = query.v[k];
  if (!query.from) return;
  from_lattice[i] = query.from->lattice, from_atom[i] = query.from->atom;
  for (int k = 0; k < dimension; ++k) from_cell[k][i] = query.from->cell[k].int64();
}

Query QueryRows::query(std::size_t i, int dimension) const {
  Query query;
  for (int k = 0; k < dimension; ++k) query.x[k] = x[k][i], query.v[k] = v[k][i];
  const auto large = std::lower_bound(large_from.begin(), large_from.end(), i,
                                      [](const auto& one, std::size_t row) { return one.first < row; });
  if (large != large_from.end() && large->first == i) query.from = large->second;
  if (from_lattice.empty() || from_lattice[i] < 0) return query;
  query.from.emplace();
  query.from->lattice = from_lattice[i], query.from->atom = from_atom[i];
  for (int k = 0; k < dimension; ++k) query.from->cell[k] = from_cell[k][i];
  return query;
}

void AnswerRows::resize(std::size_t rows, int dimensions) {
  if (rows > outcome.size()) {
    outcome.resize(rows), stage.resize(rows), lattice.resize(rows), atom.resize(rows), time.resize(rows);
    time_is_rounded = std::make_unique<bool[]>(rows);
  }
  cells.resize(outcome.size() * static_cast<std::size_t>(dimensions));
  count = rows, dimension = dimensions;
  large_cells.clear(), reasons.clear();
}

void AnswerRows::set_plain(std::size_t i, Outcome plain) {
  outcome[i] = plain;
  time_is_rounded[i] = false;
  lattice[i] = atom[i] = 0;
  for (int k = 0; k < dimension; ++k) cell(k)[i] = 0;
  time[i] = std::numeric_limits<double>::quiet_NaN();
}

void AnswerRows::set_error(std::size_t i, std::string message, bool unsupported) {
  set_plain(i, Outcome::error);
  stage[i] = kNoStage;
  reasons.push_back({i, std::move(message), unsupported});
}

void AnswerRows::set(std::size_t i, const Answer& answer, std::uint8_t of_stage, bool rounded) {
  if (answer.outcome == Outcome::error) return set_error(i, answer.message, answer.unsupported);
  set_plain(i, answer.outcome);
  stage[i] = of_stage;
  if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside) return;
  lattice[i] = answer.obstacle.lattice, atom[i] = answer.obstacle.atom;
  bool fits = true;
  for (int k = 0; k < dimension; ++k) {
    cell(k)[i] = answer.obstacle.cell[k].fits_int64() ? answer.obstacle.cell[k].int64() : 0;
    fits &= answer.obstacle.cell[k].fits_int64();
  }
  if (!fits) large_cells.emplace_back(i, answer.obstacle.cell);
  if (answer.outcome != Outcome::hit || !answer.time) return;
  time[i] = *answer.time;
  time_is_rounded[i] = rounded;
}

void AnswerRows::refuse_large_cells() {
  for (const auto& [row, large] : large_cells) {
    std::string text = "the cell of the answer, (";
    for (int k = 0; k < dimension; ++k) text += (k == 0 ? "" : ", ") + large[k].decimal();
    set_error(row, text + "), does not fit the 64 bits of a column", true);
  }
  large_cells.clear();
}

}  // namespace lorentz
