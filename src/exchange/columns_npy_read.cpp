#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <regex>

#include <lorentz/errors.hpp>
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/input_file.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz {
namespace {

constexpr std::size_t kLongestHeader = 1 << 16, kLongestRow = 1 << 20, kLargestPart = 1 << 26;  // bytes
constexpr std::string_view kReal = "f8", kInteger = "i1 i2 i4 i8 u1 u2 u4 u8";

struct NpyField {
  std::string name, type;                // "f8"; an array without fields has one without a name
  std::size_t bytes, count, offset = 0;  // of one number; of numbers; in the row
};

// The text of the header, which follows the magic bytes, the version and its length.
std::string header_text(InputFile& file) {
  char front[12] = {};
  const std::size_t there = file.read_all(front, 8), width = front[6] == 1 ? 2 : 4;
  if (there == 0) throw InputError("is empty");
  if (std::memcmp(front, "\x93NUMPY", there > 0 && there < 6 ? there : 6) != 0)
    throw InputError("is no .npy file: it does not begin with \\x93NUMPY (--format ndjson, csv: text)");
  if (there == 8 && (front[6] < 1 || front[6] > 3 || front[7] != 0))
    throw InputError("is of version " + std::to_string(front[6]) + "." + std::to_string(front[7]) +
                     " of the format .npy; 1.0, 2.0 and 3.0 are read");
  std::uint32_t length = 0;
  const bool whole = there == 8 && file.read_all(front + 8, width) == width;
  std::memcpy(&length, front + 8, sizeof length);
  std::string text(std::min<std::size_t>(length, kLongestHeader), '\0');
  if (!whole || file.read_all(text.data(), text.size()) < length)
    throw InputError("ends in its header, or has one longer than 64 KiB");
  return text.substr(0, text.find_last_not_of(" \n") + 1);
}

// An array of shape (N,), or of shape (N, n) as N rows with a field of n numbers, read part by part.
class NpyArray {
 public:
  // `expected` says in messages what the array must be.
  NpyArray(const std::string& path, const std::string& expected) : file(path) {
    try {
      understand(header_text(file), expected);
    } catch (const InputError& error) {
      throw InputError(file.name() + ": " + error.what());
    }
  }

  // Throws InputError for a field of other types, and for one that must be there.
  std::optional<NpyField> field(std::string_view name, std::string_view types, std::size_t count,
                                bool must) const {
    for (const NpyField& field : fields)
      if (field.name == name) {
        if (types.find(field.type) != types.npos && field.count == count) return field;
        must = true;
      }
    if (must) throw InputError(file.name() + ": " + what_it_is_);
    return {};
  }

  // Reads the next rows as they arrive: at least one and up to about `most`, 0 after the last.
  std::size_t read(std::size_t most, const std::function<void()>& before_waiting) {
    done += rows_;
    std::copy(buffer_.data() + rows_ * row_bytes_, buffer_.data() + end_, buffer_.data());
    end_ -= rows_ * row_bytes_;
    most = std::min(most, std::max<std::size_t>(kLargestPart / row_bytes_, 1));
    const std::size_t wanted = std::min<std::uint64_t>(promised - done, most) * row_bytes_;
    buffer_.resize(std::max(buffer_.size(), wanted));
    while (end_ < wanted) {
      const bool ready = file.is_ready();
      if (!ready && end_ >= row_bytes_) break;
      if (!ready) before_waiting();
      const std::size_t more = file.read(buffer_.data() + end_, wanted - end_);
      if (more == 0) break;
      end_ += more;
    }
    rows_ = end_ / row_bytes_;
    if (rows_ == 0 && done < promised)
      throw InputError(file.name() + ": ends too early: " + std::to_string(promised - done) + " of " +
                       std::to_string(promised) + " rows are missing");
    return rows_;
  }

  // A number of a row that was read last.
  template <class Number>
  Number number(std::size_t row, const NpyField& field, std::size_t k = 0) const {
    Number number;
    std::memcpy(&number, &buffer_[row * row_bytes_ + field.offset + k * sizeof number], sizeof number);
    return number;
  }
  // Nothing beyond the range of int64.
  std::optional<std::int64_t> integer(std::size_t row, const NpyField& field, std::size_t k = 0) const {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &buffer_[row * row_bytes_ + field.offset + k * field.bytes], field.bytes);
    const std::size_t unused = 64 - 8 * field.bytes;
    if (field.type[0] == 'i') return static_cast<std::int64_t>(bits << unused) >> unused;
    return bits >> 63 ? std::nullopt : std::optional(static_cast<std::int64_t>(bits));
  }

  InputFile file;
  std::vector<NpyField> fields;
  std::uint64_t promised = 0, done = 0;  // rows; done: before those that were read last

 private:
  // {'descr': '<f8', 'fortran_order': False, 'shape': (7, 4), }
  // {'descr': [('x', '<f8', (2,)), ('n', '<i4')], 'fortran_order': False, 'shape': (7,), }
  void understand(const std::string& header, const std::string& expected) {
    static const std::regex kNumbers(R"(\{'descr': ()'([<>|])(\w)(\d{1,9})')"),
        kField(R"((?:\{'descr': \[|, )\('([^']{0,99})', '([<>|])(\w)(\d{1,9})[^']{0,99}')"
               R"((?:, \((\d{1,9}),\))?\))"),
        kRest(R"((\])?, 'fortran_order': (True|False), 'shape': \((\d{1,18}),(?: (\d{1,9}))?\), \})");
    what_it_is_ = "is an array with the header " + shortened(header, 200) + "; " + expected;
    const bool has_fields = header.starts_with("{'descr': [");
    auto place = header.begin();
    std::smatch part;
    const auto take = [&](const std::regex& form) {
      const bool found =
          std::regex_search(place, header.end(), part, form, std::regex_constants::match_continuous);
      if (found) place = part[0].second;
      return found;
    };
    while (take(has_fields ? kField : kNumbers)) {
      const std::string type = part.str(3) + part.str(4);
      if (part[2] == ">")
        throw InputError("is big-endian: '>" + type + "'; save the array with .astype('<" + type + "')");
      const std::size_t bytes = std::stoull(part[4]) * (part[3] == "U" ? 4 : 1);
      fields.push_back({part[1], type, bytes, part[5].length() > 0 ? std::stoull(part[5]) : 1});
    }
    if (!take(kRest) || place != header.end() || fields.empty() || part[1].matched != has_fields ||
        part[4].matched == has_fields)
      throw InputError(what_it_is_);
    if (part[2] == "True")
      throw InputError("is in Fortran order, column by column; save np.ascontiguousarray(ARRAY)");
    promised = std::stoull(part[3]);
    if (!has_fields) fields[0].count = std::stoull(part[4]);
    for (NpyField& field : fields) {
      field.offset = row_bytes_;
      row_bytes_ += field.bytes * field.count;
      if (row_bytes_ > kLongestRow) throw InputError("its rows are longer than 1 MiB");
    }
  }

  std::string what_it_is_;  // for messages
  std::vector<char> buffer_;
  std::size_t row_bytes_ = 0, rows_ = 0, end_ = 0;  // in the buffer: of those read last; of all that it holds
};

class NpyQueries final : public NpyQueryReader {
 public:
  NpyQueries(const std::string& path, const std::string& d, const OnUnknownColumn& on_unknown_column)
      : array_(path,
               "queries in d = " + d +
                   " dimensions are float64 of shape (N, 2 d): x, v; or (N, 2 d + 1): max_time, too; or of "
                   "shape (N,) with the fields x, v (float64, shape (d,)), perhaps max_time, and "
                   "from_lattice, from_atom, from_cell (integers)"),
        d_(std::stoull(d)) {
    if (array_.fields[0].name.empty()) {  // columns of numbers
      const bool limits = array_.fields[0].count > 2 * d_;
      NpyField column = *array_.field("", kReal, 2 * d_ + limits, true);
      x_ = column, column.offset = 8 * d_;
      v_ = column, column.offset = 16 * d_;
      if (limits) max_time_ = column;
      return;
    }
    x_ = array_.field("x", kReal, d_, true), v_ = array_.field("v", kReal, d_, true);
    max_time_ = array_.field("max_time", kReal, 1, false);
    for (bool leaves : {false, true}) {  // one of these fields needs the others
      leaves &= from_lattice_ || from_atom_ || from_cell_;
      from_lattice_ = array_.field("from_lattice", kInteger, 1, leaves);
      from_atom_ = array_.field("from_atom", kInteger, 1, leaves);
      from_cell_ = array_.field("from_cell", kInteger, d_, leaves);
    }
    const std::vector<std::string> known = npy_query_fields();
    for (const NpyField& field : array_.fields)
      if (!field.name.empty() && std::find(known.begin(), known.end(), field.name) == known.end())
        on_unknown_column(name(), field.name);
  }

  const std::string& name() const override { return array_.file.name(); }
  std::uint64_t promised() const override { return array_.promised; }
  bool has_more() override {
    char byte;
    if (!array_.file.is_ready()) before_waiting_();
    return array_.file.read(&byte, 1) == 1;
  }

  bool next(QueryRows& rows, std::size_t most) override {
    const std::size_t count = array_.read(most, before_waiting_);
    rows.first = array_.done;
    const auto append = [&](std::vector<double>& column, const NpyField& field, std::size_t k) {
      for (std::size_t i = 0; i < count; ++i) column.push_back(array_.number<double>(i, field, k));
    };
    for (std::size_t k = 0; k < d_; ++k) append(rows.x[k], *x_, k), append(rows.v[k], *v_, k);
    if (max_time_) append(rows.max_time, *max_time_, 0);
    for (std::size_t i = 0; from_cell_ && i < count; ++i) append_from(rows, i);
    rows.count += count;
    return count > 0;
  }

 private:
  void append_from(QueryRows& rows, std::size_t i) const {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const auto index = [&](const NpyField& field) {
      return static_cast<std::int32_t>(
          std::clamp<std::int64_t>(array_.integer(i, field).value_or(kMost), -1, kMost));
    };
    rows.from_lattice.push_back(index(*from_lattice_)), rows.from_atom.push_back(index(*from_atom_));
    bool fits = true;
    for (std::size_t k = 0; k < d_; ++k) {
      const auto coordinate = array_.integer(i, *from_cell_, k);
      fits &= coordinate.has_value();
      rows.from_cell[k].push_back(coordinate.value_or(0));
    }
    if (!fits && rows.from_lattice.back() >= 0)
      rows.flaws.push_back({rows.count + i, "from_cell does not fit 64 bits with a sign"});
  }

  NpyArray array_;
  const std::size_t d_;
  std::optional<NpyField> x_, v_, max_time_, from_lattice_, from_atom_, from_cell_;
};

class NpyAnswers final : public AnswerReader {
 public:
  NpyAnswers(const std::string& path, const std::string& d)
      : array_(path, "answers in d = " + d +
                         " dimensions are of shape (N,) with the fields outcome, lattice, atom, cell "
                         "(integers, the last of shape (d,)) and time (float64 or float32)"),
        d_(std::stoull(d)) {}

  const std::string& name() const override { return array_.file.name(); }

  bool next(Answer& answer, Id& id) override {
    if (++row_ >= rows_) row_ = 0, rows_ = array_.read(1 << 10, [] {});
    if (rows_ == 0) return false;
    id = std::to_string(array_.done + row_);
    const auto integer = [&](const NpyField& field, std::int64_t least, std::int64_t most,
                             std::size_t k = 0) {
      const auto value = array_.integer(row_, field, k);
      if (!value || *value < least || *value > most)
        throw InputError(name() + ": row " + id + ": is not an answer: " + field.name + " is out of range");
      return *value;
    };
    constexpr std::int64_t kMost = 1'000'000'000, kAny = std::numeric_limits<std::int64_t>::max();
    answer = {};
    answer.outcome = static_cast<Outcome>(integer(outcome_, 0, static_cast<int>(Outcome::error)));
    const std::int64_t lattice = integer(lattice_, 0, kMost), atom = integer(atom_, 0, kMost);
    if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside) return true;
    answer.obstacle.lattice = static_cast<int>(lattice), answer.obstacle.atom = static_cast<int>(atom);
    for (std::size_t k = 0; k < d_; ++k) answer.obstacle.cell[k] = integer(cell_, -kAny - 1, kAny, k);
    const double time =
        time_.bytes == 8 ? array_.number<double>(row_, time_) : array_.number<float>(row_, time_);
    if (answer.outcome == Outcome::hit && !std::isnan(time)) answer.time = time;
    return true;
  }

 private:
  NpyField field(std::string_view name, std::size_t count = 1, std::string_view types = kInteger) const {
    return *array_.field(name, types, count, true);
  }

  NpyArray array_;
  const std::size_t d_;
  const NpyField outcome_ = field("outcome"), lattice_ = field("lattice"), atom_ = field("atom"),
                 cell_ = field("cell", d_), time_ = field("time", 1, "f8 f4");
  std::size_t row_ = 0, rows_ = 0;  // of those that were read last
};

}  // namespace

std::unique_ptr<NpyQueryReader> read_npy_queries(const std::string& path, int dimension,
                                                 const OnUnknownColumn& on_unknown_column) {
  return std::make_unique<NpyQueries>(path, std::to_string(dimension), on_unknown_column);
}

std::unique_ptr<AnswerReader> read_npy_answers(const std::string& path, int dimension) {
  return std::make_unique<NpyAnswers>(path, std::to_string(dimension));
}

}  // namespace lorentz
