// All obstacles of one atom that a stretch of a cylinder around the line of flight holds, by exact bounds in
// a basis short enough to make the bounds tight. Certificates, margins and judgements are built on this.
// Private to oracle/.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "oracle/exact/exact_line.hpp"
#include "oracle/exact/inside.hpp"
#include "oracle/exact/planes.hpp"

namespace lorentz::oracle {

/// The centres with low <= s <= high, and the basis in which they are searched.
template <std::size_t D>
struct RowStretch {
  Z low, high;
  Basis<D> basis;
  Z rows = 0;  ///< those with and without centres, or a lower bound of many
};

/// The s up to which obstacles of a view's lattice come within 4 radii of the line; nothing if there is no
/// such bound.
template <std::size_t D>
std::optional<Z> last_s(const View<D>& view);

/// The centres with |h|^2 < reach2 around the line of a view. For a cylinder of radius R, reach2 = R^2 v^2.
/// If the lattice is completed, R must be at most 4 radii of the obstacles, so that no copy is in the
/// cylinder.
template <std::size_t D>
class Stretches {
 public:
  Stretches(const View<D>& view, const Z& reach2)
      : view_(view), reach2_(reach2), reach_(reach2 > 0 ? root_below(reach2) : Z(0)) {}

  /// Cuts low <= s <= high into stretches of few rows each, as far as possible: no stretch is made shorter
  /// than about the width of the cylinder. Passes them to `take` in order, up to last_s, until `take` returns
  /// true. Returns whether it did. Two neighbouring stretches share an end.
  bool cut(const Z& low, const Z& high, const std::function<bool(const RowStretch<D>&)>& take) const;

  /// Visits the rows of a stretch that hold centres of the cylinder, until `visit` returns true. Returns
  /// whether it did. A row is given as its first such centre, the step, and the last index. Looks at no more
  /// than `most` rows, with and without centres.
  bool visit(const RowStretch<D>& stretch, const RowVisitor<D>& visit,
             long most = std::numeric_limits<long>::max()) const;

 private:
  /// Makes the basis short for the stretch. Returns the number of rows, or a lower bound of it that is
  /// already too many.
  Z shorten(Basis<D>& basis, const Z& low, const Z& high) const;
  /// The same in space, for the planes of b1 and b2.
  Z shorten_in_planes(Basis<D>& basis, const Z& low, const Z& high) const;
  /// Longer than the cylinder is wide, so it may be cut.
  bool is_long(const Z& low, const Z& high) const { return high - low > reach_ + 1; }
  /// `row`: one with the stretch's step.
  bool visit_row(const LatticePoint<D>& start, const RowStretch<D>& stretch, ExactRow<D>& row,
                 const RowVisitor<D>& visit) const;

  const View<D>& view_;
  const Z reach2_;
  const Z reach_;  // the largest |h| of integers in the plane
};

/// Visits the points of a row that are candidates for the smallest or largest margin, as visit(point, more) with
/// the number of points that follow it. These are all points; in a row of more than kManyPoints, they are those
/// at its ends and those nearest to the line. (In the plane these suffice: a margin is a quotient of linear
/// functions, so it is monotone along a row on either side of the line.)
template <std::size_t D, class Visit>
void visit_extremes(const ExactVelocity<D>& velocity, const LatticePoint<D>& first,
                    const LatticePoint<D>& step, const Z& last, const Visit& visit) {
  constexpr long kManyPoints = 64, kFewPoints = 16;
  const auto visit_range = [&](Z begin, Z end) {
    begin = std::max(begin, Z(0));
    end = std::min(end, last);
    if (begin > end) return;
    LatticePoint<D> point = first;
    point.add_multiple(begin, step);
    visit(std::move(point), Z(end - begin).get_si());
  };
  if (last < kManyPoints) return visit_range(0, last);
  const ExactRow<D> row(velocity, first, step);
  const Z nearest = row.A == 0 ? Z(0) : floor_div(-row.B, row.A);
  visit_range(0, kFewPoints);
  visit_range(nearest - kFewPoints, nearest + kFewPoints);
  visit_range(last - kFewPoints, last);
}

}  // namespace lorentz::oracle
