#include <algorithm>
#include <cstring>
#include <limits>

#include <lorentz/errors.hpp>
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/npy_number.hpp"

namespace lorentz {
namespace {

constexpr std::size_t kLargestPart = std::size_t{1} << 26;  // bytes that are held
// The first part read from a pipe, which is held whole; each next part doubles what is held.
constexpr std::size_t kFirstPart = std::size_t{1} << 16;

void append_reals(std::vector<double>& column, const char* first, std::size_t stride, std::size_t count,
                  bool swap) {
  const std::size_t before = column.size();
  column.resize(before + count);
  double* const out = column.data() + before;
  for (std::size_t i = 0; i < count; ++i) out[i] = number_in<double, std::uint64_t>(first + i * stride, swap);
}

}  // namespace

std::vector<std::string> npy_query_fields() {
  return {"x", "v", "max_time", "from_lattice", "from_atom", "from_cell"};
}

NpyQueryReader::NpyQueryReader(const std::string& path, int dimension,
                               const OnUnknownColumn& on_unknown_column)
    : file_(path), header_(read_npy_header(file_)), dimension_(dimension) {
  if (header_.structured)
    understand_fields(on_unknown_column);
  else
    understand_numbers();
  promised_ = header_.shape[0];
  if (promised_ > (std::uint64_t{1} << 62) / row_bytes_) refuse();  // places in the file fit 63 bits
  if (by_columns_) place_ = file_.place();
}

void NpyQueryReader::refuse() const {
  const std::string d = std::to_string(dimension_), numbers = std::to_string(2 * dimension_);
  throw InputError(
      file_.name() + ": is an array of " + header_.description + "; queries in " + d +
      " dimensions are one of float64, shape (N, " + numbers +
      "): columns x, v; or one column more, max_time; or one of shape (N,) with the fields x and "
      "v (float64, shape (" +
      d + ",)), perhaps max_time, from_lattice, from_atom, from_cell");
}

void NpyQueryReader::understand_numbers() {
  const auto d = static_cast<std::size_t>(dimension_);
  const NpyField& number = header_.fields[0];
  const bool good = number.kind == 'f' && number.bytes == 8 && header_.shape.size() == 2 &&
                    (header_.shape[1] == 2 * d || header_.shape[1] == 2 * d + 1);
  if (!good) refuse();
  x_ = v_ = number;
  v_.offset = 8 * d;
  row_bytes_ = 8 * header_.shape[1];
  by_columns_ = header_.fortran_order;
  if (header_.shape[1] == 2 * d) return;
  max_time_ = number;
  max_time_->offset = 16 * d;
}

const NpyField* NpyQueryReader::field(const std::string& name, bool needed) const {
  for (const NpyField& field : header_.fields)
    if (field.name == name) return &field;
  if (needed) refuse();
  return nullptr;
}

// Refuses a field that does not have the type and shape that it must have.
void NpyQueryReader::check_number(const NpyField& field, bool is_vector, bool is_real) const {
  const bool real = field.kind == 'f' && field.bytes == 8;
  std::vector<std::size_t> shape;
  if (is_vector) shape.push_back(static_cast<std::size_t>(dimension_));
  if (!(is_real ? real : field.is_integer()) || field.shape != shape) refuse();
}

void NpyQueryReader::understand_fields(const OnUnknownColumn& on_unknown_column) {
  if (header_.shape.size() != 1) refuse();
  row_bytes_ = header_.item_bytes;
  check_number(x_ = *field("x", true), true, true);
  check_number(v_ = *field("v", true), true, true);
  if (const NpyField* limit = field("max_time", false)) check_number(*(max_time_ = *limit), false, true);
  const bool leaves = field("from_lattice", false) || field("from_atom", false) || field("from_cell", false);
  if (leaves) {
    check_number(*(from_lattice_ = *field("from_lattice", true)), false, false);
    check_number(*(from_atom_ = *field("from_atom", true)), false, false);
    check_number(*(from_cell_ = *field("from_cell", true)), true, false);
  }
  const std::vector<std::string> known = npy_query_fields();
  for (const NpyField& field : header_.fields)
    if (!field.name.empty() && std::find(known.begin(), known.end(), field.name) == known.end())
      on_unknown_column(file_.name(), field.name);
}

// Reads rows as they arrive: no more than are available at once, but at least one.
std::size_t NpyQueryReader::fill_rows(std::size_t most) {
  if (begin_ > 0) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_, begin_ = 0;
  const std::size_t wanted = most * row_bytes_;
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  while (end_ < wanted) {
    if (!file_.is_ready()) {
      if (end_ >= row_bytes_) break;
      before_waiting_();
    }
    const std::size_t more = file_.read(buffer_.data() + end_, wanted - end_);
    if (more == 0) break;
    end_ += more;
  }
  const std::size_t rows = end_ / row_bytes_;
  begin_ = rows * row_bytes_;
  return rows;
}

// Reads the next numbers of a column, and returns how many.
std::size_t NpyQueryReader::read_column(std::size_t column, std::size_t most, char* bytes) {
  const std::uint64_t from = 8 * (column * promised_ + done_);
  if (place_) return file_.read_all_at(*place_ + from, bytes, 8 * most) / 8;
  const std::size_t there = from < all_.size() ? std::min<std::size_t>(all_.size() - from, 8 * most) : 0;
  std::copy_n(all_.data() + std::min<std::size_t>(from, all_.size()), there, bytes);
  return there / 8;
}

// Reads a part of each column. A pipe is read to its end for that, because the last column comes last.
std::size_t NpyQueryReader::fill_columns(std::size_t most) {
  if (!place_ && all_.empty()) {
    const std::uint64_t size = row_bytes_ * promised_;
    for (std::size_t end = 0; end < size; end = all_.size()) {
      all_.resize(std::min<std::uint64_t>(size, end + std::max(end, kFirstPart)));
      all_.resize(end + file_.read_all(all_.data() + end, all_.size() - end));
      if (all_.size() == end) break;
    }
  }
  held_ = most;
  if (buffer_.size() < row_bytes_ * most) buffer_.resize(row_bytes_ * most);
  std::size_t rows = most;
  for (std::size_t column = 0; column < row_bytes_ / 8; ++column)
    rows = std::min(rows, read_column(column, most, buffer_.data() + 8 * column * held_));
  return rows;
}

NpyQueryReader::Numbers NpyQueryReader::numbers(const NpyField& field, int component) const {
  const std::size_t offset = field.offset + field.bytes * static_cast<std::size_t>(component);
  if (by_columns_) return {buffer_.data() + offset * held_, 8};
  return {buffer_.data() + offset, row_bytes_};
}

void NpyQueryReader::append_rows(QueryRows& rows, std::size_t count) const {
  const auto append = [&](std::vector<double>& column, const NpyField& field, int component) {
    const Numbers from = numbers(field, component);
    append_reals(column, from.first, from.stride, count, must_swap(field));
  };
  for (int k = 0; k < dimension_; ++k) append(rows.x[k], x_, k), append(rows.v[k], v_, k);
  if (max_time_) append(rows.max_time, *max_time_, 0);
  if (from_lattice_) append_from(rows, count);
  rows.count += count;
}

void NpyQueryReader::append_from(QueryRows& rows, std::size_t count) const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = [&](const NpyField& field, int component) {
      const Numbers from = numbers(field, component);
      return integer_at(field, from.first + i * from.stride);
    };
    const auto index = [&](const NpyField& field) {
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(value(field, 0).value_or(kMost), -1, kMost));
    };
    rows.from_lattice.push_back(index(*from_lattice_));
    rows.from_atom.push_back(index(*from_atom_));
    bool fits = true;
    for (int k = 0; k < dimension_; ++k) {
      const auto coordinate = value(*from_cell_, k);
      fits &= coordinate.has_value();
      rows.from_cell[k].push_back(coordinate.value_or(0));
    }
    if (!fits && rows.from_lattice.back() >= 0)
      rows.flaws.push_back({rows.count + i, "from_cell does not fit 64 bits with a sign"});
  }
}

bool NpyQueryReader::next(QueryRows& rows, std::size_t most) {
  if (done_ == promised_) return false;
  const std::size_t held = std::max<std::size_t>(kLargestPart / row_bytes_, 1);
  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(promised_ - done_, std::min(most, held)));
  const std::size_t count = by_columns_ ? fill_columns(wanted) : fill_rows(wanted);
  if (count == 0) refuse_truncated(file_, done_, promised_);
  rows.first = done_;
  append_rows(rows, count);
  done_ += count;
  return true;
}

bool NpyQueryReader::has_more() {
  char byte;
  if (by_columns_ && place_) return file_.read_all_at(*place_ + row_bytes_ * promised_, &byte, 1) == 1;
  if (!file_.is_ready()) before_waiting_();
  return file_.read(&byte, 1) == 1;
}

}  // namespace lorentz
