#include <bit>
#include <cstring>

#include "src/exchange/columns_npy.hpp"

namespace lorentz {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");
static_assert(sizeof(bool) == 1);

template <class Number>
char* put(char* out, Number number) {
  std::memcpy(out, &number, sizeof number);
  return out + sizeof number;
}

// The codes of docs/formats.md.
static_assert(static_cast<int>(Outcome::hit) == 0 && static_cast<int>(Outcome::never) == 1 &&
              static_cast<int>(Outcome::inside) == 2 && static_cast<int>(Outcome::later) == 3 &&
              static_cast<int>(Outcome::undecided) == 4 && static_cast<int>(Outcome::error) == 5);

template <int d>
void put_all(char* out, const AnswerRows& answers) {
  for (std::size_t i = 0; i < answers.count; ++i) {
    out = put(out, static_cast<std::uint8_t>(answers.outcome[i]));
    out = put(out, answers.stage[i]);
    out = put(out, answers.time_is_rounded[i]);
    out = put(out, answers.lattice[i]);
    out = put(out, answers.atom[i]);
    for (int k = 0; k < d; ++k) out = put(out, answers.cell[k][i]);
    out = put(out, answers.time[i]);
  }
}

}  // namespace

std::string npy_query_header(std::uint64_t count, int dimension, bool with_from) {
  const std::string n = std::to_string(count), d = "(" + std::to_string(dimension) + ",)";
  if (!with_from) return npy_header("'<f8'", "(" + n + ", " + std::to_string(2 * dimension) + ")");
  return npy_header("[('x', '<f8', " + d + "), ('v', '<f8', " + d +
                        "), ('from_lattice', '<i4'), ('from_atom', '<i4'), ('from_cell', '<i8', " + d + ")]",
                    "(" + n + ",)");
}

void append_npy_queries(std::string& out, const QueryRows& queries, int dimension) {
  const bool with_from = !queries.from_lattice.empty();
  const std::size_t vectors = with_from ? 3 : 2;
  const std::size_t row = 8 * vectors * static_cast<std::size_t>(dimension) + (with_from ? 8 : 0);
  const std::size_t before = out.size();
  out.resize(before + row * queries.count);
  char* end = out.data() + before;
  for (std::size_t i = 0; i < queries.count; ++i) {
    for (const auto* vector : {&queries.x, &queries.v})
      for (int k = 0; k < dimension; ++k) end = put(end, (*vector)[k][i]);
    if (!with_from) continue;
    end = put(end, queries.from_lattice[i]);
    end = put(end, queries.from_atom[i]);
    for (int k = 0; k < dimension; ++k) end = put(end, queries.from_cell[k][i]);
  }
}

std::string npy_answer_header(std::uint64_t count, int dimension) {
  return npy_header(
      "[('outcome', '|u1'), ('stage', '|u1'), ('time_is_rounded', '|b1'), ('lattice', '<i4'), "
      "('atom', '<i4'), ('cell', '<i8', (" +
          std::to_string(dimension) + ",)), ('time', '<f8')]",
      "(" + std::to_string(count) + ",)");
}

void append_npy_answers(std::string& out, const AnswerRows& answers) {
  const std::size_t row = 3 + 4 + 4 + 8 * static_cast<std::size_t>(answers.dimension) + 8;
  const std::size_t before = out.size();
  out.resize(before + row * answers.count);
  if (answers.dimension == 2)
    put_all<2>(out.data() + before, answers);
  else
    put_all<3>(out.data() + before, answers);
}

}  // namespace lorentz
