#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <lorentz/errors.hpp>
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/input_file.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");
// The codes of docs/formats.md.
static_assert(Outcome{0} == Outcome::hit && Outcome{1} == Outcome::never && Outcome{2} == Outcome::inside &&
              Outcome{3} == Outcome::later && Outcome{4} == Outcome::undecided &&
              Outcome{5} == Outcome::error);

// An array with N rows, whose header is `before`, N, and `after`.
struct NpyForm {
  std::string before, after;
  std::size_t row_bytes;
};
NpyForm form_of(const std::string& type, std::size_t row_bytes, const std::string& columns = "") {
  return {"{'descr': " + type + ", 'fortran_order': False, 'shape': (", "," + columns + "), }", row_bytes};
}

// As numbers, as fields, and as fields that leave obstacles: each without limits, and with limits (odd).
constexpr std::size_t kLeaving = 4;
std::vector<NpyForm> forms_of_queries(int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::string of_d = "', (" + std::to_string(d) + ",))";
  const std::string x_v = "[('x', '<f8" + of_d + ", ('v', '<f8" + of_d, limit = ", ('max_time', '<f8')",
                    from = ", ('from_lattice', '<i4'), ('from_atom', '<i4'), ('from_cell', '<i8" + of_d;
  return {form_of("'<f8'", 16 * d, " " + std::to_string(2 * d)),
          form_of("'<f8'", 16 * d + 8, " " + std::to_string(2 * d + 1)),
          form_of(x_v + "]", 16 * d),
          form_of(x_v + limit + "]", 16 * d + 8),
          form_of(x_v + from + "]", 24 * d + 8),
          form_of(x_v + limit + from + "]", 24 * d + 16)};
}

// With `stage` and `time_is_rounded`, and without.
std::vector<NpyForm> forms_of_answers(int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::string outcome = "[('outcome', '|u1')", stage = ", ('stage', '|u1'), ('time_is_rounded', '|b1')",
                    rest = ", ('lattice', '<i4'), ('atom', '<i4'), ('cell', '<i8', (" + std::to_string(d) +
                           ",)), ('time', '<f8')]";
  return {form_of(outcome + stage + rest, 19 + 8 * d), form_of(outcome + rest, 17 + 8 * d)};
}

// Copies a number from a row, or to it, and goes on behind it.
template <class Number>
void take(const char*& place, Number& number) {
  std::memcpy(&number, place, sizeof number);
  place += sizeof number;
}
template <class Number>
void put(char*& place, Number number) {
  std::memcpy(place, &number, sizeof number);
  place += sizeof number;
}

// The text of the header, which follows the magic bytes, the version and its length.
std::string header_text(InputFile& file) {
  constexpr std::size_t kLongest = 1 << 12;
  char front[12] = {};
  const std::size_t there = file.read_all(front, 8), width = front[6] == 1 ? 2 : 4;
  if (there == 0) throw InputError(file.name() + ": is empty");
  if (std::memcmp(front, "\x93NUMPY", std::min<std::size_t>(there, 6)) != 0 ||
      (there == 8 && (front[6] < 1 || front[6] > 3 || front[7] != 0)))
    throw InputError(file.name() +
                     ": is no .npy file of version 1.0, 2.0 or 3.0 (--format ndjson, csv: text)");
  std::uint32_t length = 0;
  const bool whole = there == 8 && file.read_all(front + 8, width) == width;
  std::memcpy(&length, front + 8, sizeof length);
  std::string text(std::min<std::size_t>(length, kLongest), '\0');
  if (!whole || file.read_all(text.data(), text.size()) < length)
    throw InputError(file.name() + ": ends in its header, or has one longer than 4 KiB");
  return text.substr(0, text.find_last_not_of(" \n") + 1);
}

// The number of rows, if the header is of this form.
std::optional<std::uint64_t> rows_in(std::string text, const NpyForm& form) {
  if (!text.starts_with(form.before)) return {};
  text.erase(0, form.before.size());
  const std::size_t digits = text.find_first_not_of("0123456789");
  if (digits == 0 || digits > 18 || text.substr(digits) != form.after) return {};
  return std::stoull(text);
}

// An array in one of several forms, read part by part.
class NpyArray {
 public:
  // `expected` says in messages what the array must be.
  NpyArray(const std::string& path, int d, const std::vector<NpyForm>& forms, const std::string& expected)
      : file(path) {
    const std::string header = header_text(file);
    for (; form < forms.size(); ++form)
      if (const auto rows = rows_in(header, forms[form])) {
        promised = *rows, row_bytes_ = forms[form].row_bytes;
        return;
      }
    throw InputError(file.name() + ": is an array with the header " + shortened(header, 200) +
                     "; in d = " + std::to_string(d) + " dimensions " + expected +
                     "; save np.ascontiguousarray(ARRAY, DTYPE)");
  }

  // Reads the next rows as they arrive: at least one and up to `most`, 0 after the last.
  std::size_t read(std::size_t most, const std::function<void()>& before_waiting) {
    done += rows_;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(rows_ * row_bytes_));
    const std::size_t wanted = std::min<std::uint64_t>(promised - done, most) * row_bytes_;
    while (buffer_.size() < wanted) {
      const std::size_t end = buffer_.size();
      const bool ready = file.is_ready();
      if (!ready && end >= row_bytes_) break;
      if (!ready) before_waiting();
      buffer_.resize(wanted);
      buffer_.resize(end + file.read(buffer_.data() + end, wanted - end));
      if (buffer_.size() == end) break;
    }
    rows_ = buffer_.size() / row_bytes_;
    if (rows_ == 0 && done < promised)
      throw InputError(file.name() + ": ends too early: " + std::to_string(promised - done) + " of " +
                       std::to_string(promised) + " rows are missing");
    return rows_;
  }

  const char* row(std::size_t i) const { return buffer_.data() + i * row_bytes_; }  // of those read last
  InputFile file;
  std::size_t form = 0;                  // which one
  std::uint64_t promised = 0, done = 0;  // rows; done: before those that were read last

 private:
  std::vector<char> buffer_;  // the rows that were read last, and perhaps a part of the next
  std::size_t row_bytes_ = 0, rows_ = 0;
};

class NpyQueries final : public ColumnReader {
 public:
  NpyQueries(const std::string& path, int dimension)
      : array_(path, dimension, forms_of_queries(dimension),
               "queries are float64 of shape (N, 2 d), x and v, or (N, 2 d + 1), max_time too; or they have "
               "the fields x, v (<f8), max_time (<f8), from_lattice, from_atom (<i4), from_cell (<i8), of "
               "which the last four may be missing"),
        d_(dimension) {}

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
    for (std::size_t i = 0; i < count; ++i) append(rows, array_.row(i));
    rows.count += count;
    return count > 0;
  }

 private:
  void append(QueryRows& rows, const char* place) const {
    const auto append = [&](auto& column) { take(place, column.emplace_back()); };
    for (auto* vector : {&rows.x, &rows.v})
      for (int k = 0; k < d_; ++k) append((*vector)[k]);
    if (array_.form % 2 == 1) append(rows.max_time);
    if (array_.form < kLeaving) return;
    append(rows.from_lattice), append(rows.from_atom);
    for (int k = 0; k < d_; ++k) append(rows.from_cell[k]);
  }

  NpyArray array_;
  const int d_;
};

class NpyAnswers final : public AnswerReader {
 public:
  NpyAnswers(const std::string& path, int dimension)
      : array_(path, dimension, forms_of_answers(dimension),
               "answers have the fields outcome, stage (|u1), time_is_rounded (|b1), lattice, atom (<i4), "
               "cell (<i8), time (<f8), of which stage and time_is_rounded may be missing"),
        d_(dimension) {}

  const std::string& name() const override { return array_.file.name(); }
  bool next(Answer& answer, Id& id) override {
    if (++row_ >= rows_) row_ = 0, rows_ = array_.read(1 << 10, [] {});
    if (rows_ == 0) return false;
    answer = {}, id = std::to_string(array_.done + row_);
    const char* place = array_.row(row_);
    std::int32_t lattice, atom;
    const int outcome = static_cast<unsigned char>(*place++);
    if (array_.form == 0) place += 2;  // stage, time_is_rounded
    take(place, lattice), take(place, atom);
    if (outcome > static_cast<int>(Outcome::error) || lattice < 0 || atom < 0)
      throw InputError(name() + ": row " + id + ": is not an answer: a number is out of range");
    answer.outcome = static_cast<Outcome>(outcome);
    if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside) return true;
    answer.obstacle.lattice = lattice, answer.obstacle.atom = atom;
    for (std::int64_t k = 0, n; k < d_; ++k) take(place, n), answer.obstacle.cell[k] = n;
    if (answer.outcome == Outcome::hit) take(place, answer.time.emplace());
    if (std::isnan(answer.time.value_or(0))) answer.time.reset();
    return true;
  }

 private:
  NpyArray array_;
  const int d_;
  std::size_t row_ = 0, rows_ = 0;  // of those that were read last
};

// The header of a file with `count` rows, padded as in NumPy.
std::string npy_header(const NpyForm& form, std::uint64_t count) {
  std::string text = form.before + std::to_string(count) + form.after;
  text.append(63 - (10 + text.size()) % 64, ' ') += '\n';
  const std::string length{static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return "\x93NUMPY" + std::string("\1\0", 2) + length + text;
}

// Room for `count` more rows, and their place.
char* room(std::string& out, const NpyForm& form, std::size_t count) {
  out.resize(out.size() + count * form.row_bytes);
  return out.data() + out.size() - count * form.row_bytes;
}

}  // namespace

std::unique_ptr<ColumnReader> read_npy_queries(const std::string& path, int dimension) {
  return std::make_unique<NpyQueries>(path, dimension);
}

std::unique_ptr<AnswerReader> read_npy_answers(const std::string& path, int dimension) {
  return std::make_unique<NpyAnswers>(path, dimension);
}

std::string npy_query_header(std::uint64_t count, int dimension, bool with_from) {
  return npy_header(forms_of_queries(dimension)[with_from ? kLeaving : 0], count);
}

void append_npy_queries(std::string& out, const QueryRows& queries, int dimension) {
  const bool with_from = !queries.from_lattice.empty();
  char* place = room(out, forms_of_queries(dimension)[with_from ? kLeaving : 0], queries.count);
  for (std::size_t i = 0; i < queries.count; ++i) {
    for (const auto* vector : {&queries.x, &queries.v})
      for (int k = 0; k < dimension; ++k) put(place, (*vector)[k][i]);
    if (!with_from) continue;
    put(place, queries.from_lattice[i]), put(place, queries.from_atom[i]);
    for (int k = 0; k < dimension; ++k) put(place, queries.from_cell[k][i]);
  }
}

std::string npy_answer_header(std::uint64_t count, int dimension) {
  return npy_header(forms_of_answers(dimension)[0], count);
}

void append_npy_answers(std::string& out, const AnswerRows& answers) {
  char* place = room(out, forms_of_answers(answers.dimension)[0], answers.count);
  for (std::size_t i = 0; i < answers.count; ++i) {
    put(place, static_cast<std::uint8_t>(answers.outcome[i])), put(place, answers.stage[i]);
    put(place, answers.time_is_rounded[i]), put(place, answers.lattice[i]), put(place, answers.atom[i]);
    for (int k = 0; k < answers.dimension; ++k) put(place, answers.cell(k)[i]);
    put(place, answers.time[i]);
  }
}

}  // namespace lorentz
