// The lattices that families draw on: those of the catalogue (data/scenes/), repeated here so that a case
// needs no file.
#pragma once

#include <string_view>

#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

struct Crystal {
  std::string_view name;
  Scene scene;  ///< obstacles as in the catalogue: in most lattices about 4/5 of touching size
};

const std::vector<Crystal>& crystals();

/// A crystal of this dimension, drawn from them.
const Crystal& drawn_crystal(Random& random, int dimension);

}  // namespace lorentz::cases
