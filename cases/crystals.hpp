// The lattices that families draw on: those of the catalogue (data/scenes/), restated, so that a case needs
// no file.
#pragma once

#include <string_view>

#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

struct Crystal {
  std::string_view name;
  Scene scene;  ///< obstacles as in the catalogue: some 4/5 of what would touch
};

const std::vector<Crystal>& crystals();

/// One of them, of this dimension.
const Crystal& drawn_crystal(Random& random, int dimension);

}  // namespace lorentz::cases
