// The uncertainty of a particle's state: a small parallelepiped that turns with the flow. Private to
// oracle/itinerary.
//
// State = middle + Q e, with Q nearly orthogonal and |e_i| <= width_i. A collision maps this into
// F(middle) + J Q e, with J the derivative anywhere in the box (mean value theorem). With Q' = the orthogonal
// factor of the columns of J Q, longest first, this is Q' e', where e' = Q'^-1 (J Q e + rounding). So the box
// is long where the flow stretches and thin elsewhere, and grows by as much as the flow stretches. Boxes
// along the axes would grow by about 4 bits more per collision. (This is R. Lohner's method for differential
// equations.)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/itinerary/ball.hpp"

namespace lorentz::oracle {

template <int N>
class ErrorBox {
 public:
  using Matrix = std::array<BallVec<N>, N>;  ///< rows
  using Bounds = std::array<Bound, N>;

  /// A box in which only the `widths` of the components are uncertain.
  explicit ErrorBox(const Bounds& widths = {}) : turn_(identity()), widths_(widths) {}

  bool is_point() const {
    for (const Bound& width : widths_)
      if (!width.is_zero()) return false;
    return true;
  }

  /// The largest distance of a linear function of the state, with this gradient, from its value in the
  /// middle.
  Bound width_of(const BallVec<N>& gradient) const {
    Bound sum;
    for (int k = 0; k < N; ++k) {
      Ball along;
      for (int i = 0; i < N; ++i) along.add_product(gradient[i], Ball(turn_[i][k]));
      sum += along.size() * widths_[k];
    }
    return sum;
  }

  /// The same for one component.
  Bound width_of(int component) const {
    Bound sum;
    for (int k = 0; k < N; ++k) sum += Ball(turn_[component][k]).size() * widths_[k];
    return sum;
  }

  /// Replaces the box by the box after a step. `derivative` encloses the derivative anywhere in the box, and
  /// `rounding` bounds the rounding of the result's middle.
  void advance(const Matrix& derivative, const Bounds& rounding) {
    const Matrix moved = times_turn(derivative);
    turn_ = turn_along(moved);
    Bounds next;
    Bound largest;
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < N; ++k) {
        Ball entry;  // of Q'^T J Q
        for (int j = 0; j < N; ++j) entry.add_product(Ball(turn_[j][i]), moved[j][k]);
        next[i] += entry.size() * widths_[k] + Ball(turn_[k][i]).size() * rounding[k];
      }
      largest = std::max(largest, next[i]);
    }
    // Q'^-1 = (1 + E)^-1 Q'^T, E = Q'^T Q' - 1. In the norm of the largest component,
    //   |(1 + E)^-1 x - x| <= |E| / (1 - |E|) |x|.
    const Bound slant = beyond_orthogonal();
    for (int i = 0; i < N; ++i) widths_[i] = next[i] + slant * largest;
  }

 private:
  using Turn = std::array<std::array<double, N>, N>;  // rows

  static Turn identity() {
    Turn result{};
    for (int i = 0; i < N; ++i) result[i][i] = 1;
    return result;
  }

  Matrix times_turn(const Matrix& derivative) const {
    Matrix moved;
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < N; ++k)
        for (int j = 0; j < N; ++j) moved[i][k].add_product(derivative[i][j], Ball(turn_[j][k]));
    return moved;
  }

  // Any matrix is valid; a good one is Q of the QR factors of the columns, longest first. The lengths of the
  // columns are beyond binary64's range, but not their directions.
  Turn turn_along(const Matrix& moved) const {
    std::array<int, N> order;
    std::array<Bound, N> length;
    for (int k = 0; k < N; ++k) {
      order[k] = k;
      for (int i = 0; i < N; ++i) length[k] += moved[i][k].size() * widths_[k];
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[b] < length[a]; });
    Turn columns{};
    for (int k = 0; k < N; ++k) {
      Bound largest;
      for (int i = 0; i < N; ++i) largest = std::max(largest, moved[i][order[k]].size());
      for (int i = 0; i < N; ++i)
        columns[i][k] =
            largest.is_zero() ? (i == k ? 1 : 0) : scaled(moved[i][order[k]], -largest.exponent()).nearest();
    }
    return orthogonal_factor(columns);
  }

  // Q of the QR factors, by Householder's reflections: orthogonal even if the columns are nearly dependent.
  static Turn orthogonal_factor(Turn columns) {
    Turn result = identity();
    for (int k = 0; k + 1 < N; ++k) {
      std::array<double, N> normal{};  // of the mirror that takes column k to a multiple of axis k
      double length2 = 0, normal2 = 0;
      for (int i = k; i < N; ++i) length2 += columns[i][k] * columns[i][k];
      for (int i = k; i < N; ++i) {
        normal[i] = columns[i][k] + (i == k ? std::copysign(std::sqrt(length2), columns[k][k]) : 0);
        normal2 += normal[i] * normal[i];
      }
      if (normal2 == 0) continue;
      for (int j = 0; j < N; ++j) {
        double column = 0, row = 0;
        for (int i = k; i < N; ++i) {
          column += normal[i] * columns[i][j];
          row += normal[i] * result[j][i];
        }
        for (int i = k; i < N; ++i) {
          columns[i][j] -= 2 / normal2 * column * normal[i];
          result[j][i] -= 2 / normal2 * row * normal[i];
        }
      }
    }
    return result;
  }

  // |E| / (1 - |E|), or more; |E| is the largest sum of the sizes in a row.
  Bound beyond_orthogonal() const {
    Bound norm;
    for (int i = 0; i < N; ++i) {
      Bound row;
      for (int k = 0; k < N; ++k) {
        Ball product = i == k ? Ball(-1) : Ball();
        for (int j = 0; j < N; ++j) product.add_product(Ball(turn_[j][i]), Ball(turn_[j][k]));
        row += product.size();
      }
      norm = std::max(norm, row);
    }
    if (Bound(0.5) < norm) return Bound(1) / Bound();  // never seen; infinite, so nothing is certain then
    return norm + norm;
  }

  Turn turn_;
  Bounds widths_;
};

}  // namespace lorentz::oracle
