// The first ball of a 3D Bravais lattice that a line meets, in O(log 1/r). Private to the reduction engine.
//
// Coordinates: across the line in units of r, along it in units of a length that grows while nothing is met.
// In these the cylinder is of radius 1, a window of it of length 1, and a basis that is short in them has few
// lattice planes and few lattice lines that meet the window. A line is solved by one quadratic.
#pragma once

#include <algorithm>

#include "src/engines/reduction/frame_3d.hpp"
#include "src/engines/reduction/reduce_3d.hpp"

namespace lorentz {

/// A lattice seen along one direction: all that does not depend on the start.
template <bool kUnit, bool kBall>
struct Direction3 : Frame3<kUnit, kBall> {
  using Frame = Frame3<kUnit, kBall>;
  using Frame::inverse_r, Frame::scale, Frame::v2;

  Basis3 basis;

  template <class Arch>
  void set(const Bravais& lattice, const double (&velocity)[3]) {
    Frame::template set<Arch>(lattice, velocity);
    basis.length = first_length(lattice);
    const double along = 1 / basis.length;
    const auto& form = this->form();
    for (int i = 0; i < 3; ++i) {
      Arm3& arm = basis.b[i];
      for (int j = 0; j < 3; ++j) arm.n[j] = i == j;
      arm.p[0] = scale[0] * form[0][i].hi, arm.p[1] = scale[1] * form[1][i].hi, arm.z = along * form[2][i].hi;
    }
    reduce<Arch>(basis);
  }

  /// Another atom of the same lattice, with balls of another radius: only the scales differ, and the basis is
  /// reduced on from where it is.
  template <class Arch>
  void retarget(const Bravais& lattice) {
    const double before = inverse_r, length_before = basis.length;
    this->set_radius(lattice);
    basis.length = first_length(lattice);
    const double wider = inverse_r / before, longer = length_before / basis.length;
    for (Arm3& arm : basis.b) arm.p[0] *= wider, arm.p[1] *= wider, arm.z *= longer;
    reduce<Arch>(basis);
  }

  /// A longer window: the basis is reduced on from where it is.
  template <class Arch>
  void lengthen(Basis3& longer, double factor) const {
    longer.length *= factor;
    for (Arm3& arm : longer.b) arm.z /= factor;
    reduce<Arch>(longer);
  }

 private:
  // Of a window in which two balls are expected.
  double first_length(const Bravais& lattice) const {
    return kWindowCells * lattice.volume / (3.14 * lattice.radius * lattice.radius) * std::sqrt(v2);
  }

  // To a basis that is short in the window's metric, then once more from exact coefficients.
  template <class Arch>
  void reduce(Basis3& basis) const {
    GreedyReduction reduction(basis);
    bool done = false;
    for (int round = 0; round < kMaxReductionRounds && !done; ++round) {
      done = reduction.run() && reduction.is_accurate(inverse_r);
      for (Arm3& arm : basis.b) this->template recompute<Arch>(arm, basis.length);
      reduction.refresh();
    }
    basis.set_dual();
    basis.usable = basis.usable && done && reduction.largest() < kMaxCoefficient / 2;
  }
};

}  // namespace lorentz
