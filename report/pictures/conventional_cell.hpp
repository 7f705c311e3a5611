// The cube that shows the structure of a centred cubic lattice, which its primitive cell does not. Private to
// report/pictures/.
#pragma once

#include <array>

#include <lorentz/scene.hpp>

namespace lorentz::pictures {

/// The cell that is drawn for a lattice.
struct ShownCell {
  std::array<Vec, 3> vectors{};
  int primitive_cells = 1;  ///< contained in it: 1, or in a cube 2 (bcc) or 4 (fcc)
};

/// The cube of a body-centred or face-centred cubic lattice (3D; rounded vectors are recognised), or the
/// primitive cell.
ShownCell shown_cell(const Lattice& lattice, const std::array<Vec, 3>& short_vectors);

}  // namespace lorentz::pictures
