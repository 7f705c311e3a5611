// A drawn symmetry of the square or cubic lattice.
#pragma once

#include <array>

#include <lorentz/query.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// Permutes and reflects the components of vectors and cells: a symmetry of the square or cubic lattice.
class Symmetry {
 public:
  Symmetry(Random& random, int dimension);
  Vec operator()(const Vec& a) const;
  Query operator()(const Query& query) const;

 private:
  std::array<int, 3> from_{0, 1, 2};
  std::array<int, 3> sign_{1, 1, 1};
};

}  // namespace lorentz::cases
