// The shape of an ellipsoid { A y : |y| < 1 }, prepared for the reduction engine: as a ball in another
// metric.
//
// With r = |det A|^(1/d) and N = r A^-1 the ellipsoid is { d : |N d| < r }, a ball of radius r in the
// coordinates N d, and det N is 1 up to rounding. The engine stays in the scene's coordinates, where lattice,
// start and velocity are exact, and asks its questions in the metric G = N^T N:
//   along    s = (N v).(N d) = w . d,  w = G v
//   speed    v2 = |N v|^2 = w . v
//   across   (N v) x (N d) = C (v x d),  C = det(N) N^-T the cofactors of N
// In 2D C is a number: then heights are those of balls, and only the width of the strip differs.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/vec.hpp>
#include "src/engines/base/double_double.hpp"

namespace lorentz {

/// In 2D a third semiaxis of length r is added at right angles to the plane.
struct Shape {
  Vec semiaxes[3];
  double radius = 0;  ///< r
  Vec to_ball[3];     ///< rows of N
  Vec cofactor[3];    ///< rows of C
  double volume = 1;  ///< det N
  Wide metric[3][3];  ///< G
  Wide wide_cofactor[3][3];
  double metric_size = 0, cofactor_size = 0;    ///< at least |G|, |C| (2-norms)
  double metric_error = 0, cofactor_error = 0;  ///< |computed - exact| at most, in the 2-norm
  double inverse_height_scale = 1;              ///< 2D: 1 / |C|
  double along_error = 0;  ///< 2D: 16 c u |N| / r, c the condition (direction_2d-inl.hpp)
  double condition = 1;    ///< at least |N| |N^-1|: the longest semiaxis of the ellipsoid over the shortest

  friend bool operator==(const Shape& a, const Shape& b) {
    return a.semiaxes[0] == b.semiaxes[0] && a.semiaxes[1] == b.semiaxes[1] && a.semiaxes[2] == b.semiaxes[2];
  }
};

/// The shape of d semiaxes (for a ball: r times the axes). Nothing if the ellipsoid is too slender, if the
/// semiaxes are dependent, or if r is not between 2^-100 and 2^100.
std::optional<Shape> shape_of(const std::vector<Vec>& semiaxes);

}  // namespace lorentz
