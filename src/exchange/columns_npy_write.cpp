#include <bit>
#include <cstring>

#include "src/exchange/columns_npy.hpp"

namespace lorentz {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

// The header of a file, padded as in NumPy. `description` and `shape` are literals of Python.
std::string header(const std::string& description, const std::string& shape) {
  std::string text = "{'descr': " + description + ", 'fortran_order': False, 'shape': (" + shape + "), }";
  text.append(63 - (10 + text.size()) % 64, ' ') += '\n';
  const std::string length{static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return "\x93NUMPY" + std::string("\1\0", 2) + length + text;
}

// Room for more bytes, and their place.
char* room(std::string& out, std::size_t bytes) {
  out.resize(out.size() + bytes);
  return out.data() + out.size() - bytes;
}

template <class Number>
void put(char*& place, Number number) {
  std::memcpy(place, &number, sizeof number);
  place += sizeof number;
}

// The codes of docs/formats.md.
static_assert(Outcome{0} == Outcome::hit && Outcome{1} == Outcome::never && Outcome{2} == Outcome::inside &&
              Outcome{3} == Outcome::later && Outcome{4} == Outcome::undecided &&
              Outcome{5} == Outcome::error);

}  // namespace

std::string npy_query_header(std::uint64_t count, int dimension, bool with_from) {
  const std::string n = std::to_string(count), d = "(" + std::to_string(dimension) + ",)";
  if (!with_from) return header("'<f8'", n + ", " + std::to_string(2 * dimension));
  return header("[('x', '<f8', " + d + "), ('v', '<f8', " + d +
                    "), ('from_lattice', '<i4'), ('from_atom', '<i4'), ('from_cell', '<i8', " + d + ")]",
                n + ",");
}

void append_npy_queries(std::string& out, const QueryRows& queries, int dimension) {
  const bool with_from = !queries.from_lattice.empty();
  const std::size_t vectors = with_from ? 3 : 2, indices = with_from ? 8 : 0;
  char* place = room(out, queries.count * (8 * vectors * static_cast<std::size_t>(dimension) + indices));
  for (std::size_t i = 0; i < queries.count; ++i) {
    for (const auto* vector : {&queries.x, &queries.v})
      for (int k = 0; k < dimension; ++k) put(place, (*vector)[k][i]);
    if (!with_from) continue;
    put(place, queries.from_lattice[i]), put(place, queries.from_atom[i]);
    for (int k = 0; k < dimension; ++k) put(place, queries.from_cell[k][i]);
  }
}

std::string npy_answer_header(std::uint64_t count, int dimension) {
  return header(
      "[('outcome', '|u1'), ('stage', '|u1'), ('time_is_rounded', '|b1'), ('lattice', '<i4'), "
      "('atom', '<i4'), ('cell', '<i8', (" +
          std::to_string(dimension) + ",)), ('time', '<f8')]",
      std::to_string(count) + ",");
}

void append_npy_answers(std::string& out, const AnswerRows& answers) {
  char* place = room(out, answers.count * (19 + 8 * static_cast<std::size_t>(answers.dimension)));
  for (std::size_t i = 0; i < answers.count; ++i) {
    put(place, static_cast<std::uint8_t>(answers.outcome[i])), put(place, answers.stage[i]);
    put(place, answers.time_is_rounded[i]), put(place, answers.lattice[i]), put(place, answers.atom[i]);
    for (int k = 0; k < answers.dimension; ++k) put(place, answers.cell[k][i]);
    put(place, answers.time[i]);
  }
}

}  // namespace lorentz
