#include "starts/start_columns.hpp"

namespace lorentz::starts {

void StartColumns::resize(std::size_t count, int dimension, bool with_from) {
  const std::size_t from_count = with_from ? count : 0;
  for (int i = 0; i < 3; ++i) {
    const bool used = i < dimension;
    x[i].resize(used ? count : 0);
    v[i].resize(used ? count : 0);
    from_cell[i].resize(used ? from_count : 0);
  }
  from_lattice.resize(from_count);
  from_atom.resize(from_count);
}

QueryColumns StartColumns::view() const {
  QueryColumns columns;
  for (int i = 0; i < 3; ++i) columns.x[i] = x[i], columns.v[i] = v[i];
  if (from_lattice.empty()) return columns;
  columns.from_lattice = from_lattice, columns.from_atom = from_atom;
  for (int i = 0; i < 3; ++i) columns.from_cell[i] = from_cell[i];
  return columns;
}

}  // namespace lorentz::starts
