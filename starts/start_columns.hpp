// Starts of flights in columns.
#pragma once

#include <array>
#include <vector>

#include <lorentz/batch.hpp>

namespace lorentz::starts {

/// One column per component, as in QueryColumns. In 2D the third columns are empty.
struct StartColumns {
  std::array<std::vector<double>, 3> x, v;

  /// The obstacle that each flight leaves. Empty if no flight leaves one.
  std::vector<std::int32_t> from_lattice, from_atom;
  std::array<std::vector<std::int64_t>, 3> from_cell;

  std::size_t size() const { return x[0].size(); }

  /// Makes room for `count` starts. Memory stays allocated.
  void resize(std::size_t count, int dimension, bool with_from);

  /// A view of the columns. It is valid until the next change of their size.
  QueryColumns view() const;
};

}  // namespace lorentz::starts
