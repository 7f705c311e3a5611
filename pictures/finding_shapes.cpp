// Obstacles as ellipses: sections by a plane, or shadows.
#include <cmath>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {

// y = B w + q, B the two columns of A^-1 for the axes: |w - w0|^2_S < 1, S = B^T B / k.
std::optional<ShapeSection> section_of(const Atom& atom, const Axes& axes, double depth) {
  const auto rows = to_ball(atom, 3);
  const Vec a = coordinates(rows, axes.along), b = coordinates(rows, axes.across),
            q = coordinates(rows, scaled(axes.depth, -depth));
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
  const double aq = dot(a, q), bq = dot(b, q);
  const Point w0{(ab * bq - bb * aq) / det, (ab * aq - aa * bq) / det};
  const Vec nearest = sum(q, sum(scaled(a, w0.x), scaled(b, w0.y)));
  const double k = 1 - dot(nearest, nearest);
  if (!(k > 0)) return std::nullopt;
  // w - w0 = L^-T u for S = L L^T, |u| < 1.
  const double l11 = std::sqrt(aa / k), l21 = ab / k / l11, l22 = std::sqrt(det / aa / k);
  return ShapeSection{w0, ellipse_of({1 / l11, -l21 / (l11 * l22), 0}, {0, 1 / l22, 0})};
}

}  // namespace lorentz::pictures
