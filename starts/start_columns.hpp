// Starts of flights in columns.
#pragma once

#include <array>
#include <vector>

#include <lorentz/batch.hpp>

namespace lorentz::starts {

/// A column each component, as QueryColumns has them; in 2D the third columns are empty.
struct StartColumns {
  std::array<std::vector<double>, 3> x, v;

  /// The obstacle that a flight leaves; empty: no flight leaves one.
  std::vector<std::int32_t> from_lattice, from_atom;
  std::array<std::vector<std::int64_t>, 3> from_cell;

  std::size_t size() const { return x[0].size(); }

  /// Room for so many; what is allocated stays.
  void resize(std::size_t count, int dimension, bool with_from);

  /// Until the next change of their size.
  QueryColumns view() const;
};

}  // namespace lorentz::starts
