#include <lorentz/exchange.hpp>
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz {

std::vector<std::string> csv_answer_columns(int dimension) {
  std::vector<std::string> names{"id", "outcome", "lattice", "atom"};
  for (int k = 1; k <= dimension; ++k) names.push_back("cell" + std::to_string(k));
  names.push_back("time");
  return names;
}

CsvAnswerReader::CsvAnswerReader(const std::string& path, const Components& components)
    : components_(components),
      dimension_(components.of_vectors()),
      table_(
          path, csv_answer_columns(dimension_), [this](const CsvTable& table) { understand(table); },
          [](const std::string&, const std::string&) {}) {}

void CsvAnswerReader::understand(const CsvTable& table) {
  constexpr const char* kNeeded = "answers need it";
  id_ = table.take("id"), outcome_ = table.need("outcome", kNeeded);
  lattice_ = table.need("lattice", kNeeded), atom_ = table.need("atom", kNeeded);
  for (int k = 0; k < dimension_; ++k)
    cell_[static_cast<std::size_t>(k)] = table.need("cell" + std::to_string(k + 1), kNeeded);
  time_ = table.need("time", kNeeded);
}

Answer CsvAnswerReader::answer_of() const {
  Answer answer;
  const auto outcome = outcome_named(table_.field(outcome_));
  if (!outcome) table_.refuse(outcome_, "is not an outcome");
  answer.outcome = *outcome;
  if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside) return answer;
  const auto index = [&](std::size_t column) {
    const std::int64_t value = table_.integer(column);
    if (value < 0 || value > 1'000'000'000)
      table_.refuse(column, "is not the number of a lattice or an atom");
    return static_cast<int>(value);
  };
  answer.obstacle.lattice = index(lattice_), answer.obstacle.atom = index(atom_);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    if (static_cast<int>(k) >= components_.of_cells(answer.obstacle.lattice) &&
        table_.field(cell_[k]).empty())
      continue;
    auto coordinate = Integer::from_decimal(table_.field(cell_[k]));
    answer.obstacle.cell[k] = coordinate ? std::move(*coordinate) : Integer(table_.integer(cell_[k]));
  }
  const std::string_view time = table_.field(time_);
  if (answer.outcome == Outcome::hit && !time.empty())
    answer.time = time == "inf" ? std::numeric_limits<double>::infinity() : table_.number(time_);
  return answer;
}

bool CsvAnswerReader::next(Answer& answer, Id& id) {
  if (!table_.next()) return false;
  const std::uint64_t row = done_++;
  try {
    table_.split();
    answer = answer_of();
  } catch (const InputError& error) {
    throw InputError(name() + ":" + std::to_string(table_.line()) + ": " + error.what());
  }
  id = id_ == CsvTable::kNone ? std::to_string(row) : json_quoted(table_.field(id_));
  return true;
}

}  // namespace lorentz
