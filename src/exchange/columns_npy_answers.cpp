#include <cmath>

#include <lorentz/errors.hpp>
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/npy_number.hpp"

namespace lorentz {

NpyAnswerReader::NpyAnswerReader(const std::string& path, int dimension)
    : file_(path), header_(read_npy_header(file_)), dimension_(dimension) {
  outcome_ = field("outcome", 1), lattice_ = field("lattice", 1), atom_ = field("atom", 1);
  cell_ = field("cell", static_cast<std::size_t>(dimension)), time_ = field("time", 1);
  if (header_.shape.size() != 1 || time_.kind != 'f' || time_.bytes < 4) refuse("is not an array of answers");
  row_.resize(header_.item_bytes);
}

void NpyAnswerReader::refuse(const std::string& what) const {
  const std::string d = std::to_string(dimension_);
  throw InputError(file_.name() + ": " + what + "; it is an array of " + header_.description +
                   "; answers in " + d +
                   " dimensions are one of shape (N,) with the fields outcome, lattice, atom, "
                   "cell (integers, the last of shape (" +
                   d + ",)) and time (float64 or float32)");
}

const NpyField& NpyAnswerReader::field(const char* name, std::size_t numbers) const {
  for (const NpyField& field : header_.fields) {
    const bool is_number = field.is_integer() || (field.kind == 'f' && field.has_usual_size());
    if (header_.structured && field.name == name && is_number && field.count() == numbers) return field;
  }
  refuse(std::string("has no field ") + name + " of that kind");
}

std::int64_t NpyAnswerReader::integer(const NpyField& field, std::size_t component) const {
  const auto value = field.kind == 'f'
                         ? std::nullopt
                         : integer_at(field, row_.data() + field.offset + component * field.bytes);
  if (!value)
    throw InputError(file_.name() + ": row " + std::to_string(done_) + ": " + field.name +
                     ": is not an integer of 64 bits");
  return *value;
}

bool NpyAnswerReader::next(Answer& answer, Id& id) {
  if (done_ == header_.shape[0]) return false;
  if (file_.read_all(row_.data(), row_.size()) < row_.size())
    refuse_truncated(file_, done_, header_.shape[0]);
  const std::int64_t outcome = integer(outcome_), lattice = integer(lattice_), atom = integer(atom_);
  constexpr std::int64_t kMost = 1'000'000'000;
  if (outcome < 0 || outcome > static_cast<int>(Outcome::error) || lattice < 0 || atom < 0 ||
      lattice > kMost || atom > kMost)
    throw InputError(file_.name() + ": row " + std::to_string(done_) + ": is not an answer: outcome " +
                     std::to_string(outcome) + ", lattice " + std::to_string(lattice) + ", atom " +
                     std::to_string(atom) + " is out of range");
  answer = {};
  answer.outcome = static_cast<Outcome>(outcome);
  if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) {
    answer.obstacle.lattice = static_cast<int>(lattice), answer.obstacle.atom = static_cast<int>(atom);
    for (int k = 0; k < dimension_; ++k)
      answer.obstacle.cell[k] = Integer(integer(cell_, static_cast<std::size_t>(k)));
  }
  const char* const at = row_.data() + time_.offset;
  const double time = time_.bytes == 8 ? number_in<double, std::uint64_t>(at, must_swap(time_))
                                       : double{number_in<float, std::uint32_t>(at, must_swap(time_))};
  if (answer.outcome == Outcome::hit && !std::isnan(time)) answer.time = time;
  id = std::to_string(done_++);
  return true;
}

}  // namespace lorentz
