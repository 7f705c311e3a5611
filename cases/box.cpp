#include "cases/box.hpp"

#include <algorithm>
#include <cmath>

namespace lorentz::cases {

Box Box::of(const Scene& scene, std::uint64_t cells) {
  Box box = cell_of(scene);
  if (scene.lattices.size() == 1) return box;
  const auto n = static_cast<double>(cells);
  const auto side = [](double length) { return std::max(1.0, std::round(length)); };
  if (scene.dimension == 2)
    box.cells = {side(std::sqrt(1.6 * n)), side(std::sqrt(n / 1.6)), 1};
  else
    box.cells.fill(side(std::cbrt(n)));
  return box;
}

}  // namespace lorentz::cases
