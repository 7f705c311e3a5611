#include "oracle/first_hit/window_basis.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {
namespace {

double product(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

}  // namespace

void WindowBasis::BasisVector::add_multiple(const Z& k, const BasisVector& other) {
  WindowVector::add_multiple(k, other);
  for (std::size_t i = 0; i < 3; ++i) h[i].add_product(k, other.h[i]);
}

WindowBasis::WindowBasis(const ExactVelocity<3>& velocity, const Basis<3>& basis) : velocity_(velocity) {
  for (std::size_t i = 0; i < 3; ++i) {
    vectors_[i].point = basis[i];
    vectors_[i].s = dot(velocity.v, basis[i].p);
    vectors_[i].h = cross(velocity.v, basis[i].p);
  }
}

WindowBasis::Rounded WindowBasis::rounded(long j) const {
  std::array<std::array<BinaryApproximation, 4>, 3> exact;
  long largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      BinaryApproximation& x = exact[i][k];
      x = approximation(k < 3 ? vectors_[i].h[k] : vectors_[i].s);
      if (k < 3) x.exponent += j;
      if (x.mantissa != 0) largest = std::max(largest, x.exponent);
    }
  Rounded result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const BinaryApproximation& x = exact[i][k];
      constexpr long kNothing = -500;  // its square would be 0
      result[i][k] = std::ldexp(x.mantissa, static_cast<int>(std::max(x.exponent - largest, kNothing)));
    }
  return result;
}

// Subtracts k a + m b from a vector, if that makes it shorter.
WindowBasis::Step WindowBasis::take(Rounded& vectors, std::size_t from, std::size_t a, double k,
                                    std::size_t b, double m) {
  if (k == 0 && m == 0) return Step::none;
  constexpr double kLargest = 0x1p50;
  if (!(std::fabs(k) < kLargest && std::fabs(m) < kLargest)) return Step::out_of_range;
  std::array<double, 4> shorter;
  for (std::size_t i = 0; i < 4; ++i) shorter[i] = vectors[from][i] - k * vectors[a][i] - m * vectors[b][i];
  if (!(product(shorter, shorter) < product(vectors[from], vectors[from]))) return Step::none;
  vectors[from] = shorter;
  if (k != 0) vectors_[from].add_multiple(-static_cast<long>(k), vectors_[a]);
  if (m != 0) vectors_[from].add_multiple(-static_cast<long>(m), vectors_[b]);
  return Step::done;
}

// One step of the greedy algorithm (short_basis.hpp).
WindowBasis::Step WindowBasis::shorten(Rounded& vectors) {
  std::array<double, 3> square;
  for (std::size_t i = 0; i < 3; ++i) square[i] = product(vectors[i], vectors[i]);
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return square[a] < square[b]; });
  const auto [first, second, third] = order_;
  const double g11 = square[first], g22 = square[second], g12 = product(vectors[first], vectors[second]);
  const Step pair = take(vectors, second, first, std::nearbyint(g12 / g11), first, 0);
  if (pair != Step::none) return pair;
  const double g13 = product(vectors[first], vectors[third]), g23 = product(vectors[second], vectors[third]),
               det = g11 * g22 - g12 * g12;
  return take(vectors, third, first, std::nearbyint((g13 * g22 - g23 * g12) / det), second,
              std::nearbyint((g23 * g11 - g13 * g12) / det));
}

bool WindowBasis::shorten(long j) {
  bool changed = false;
  const auto before = order_;
  // After much cancellation the vectors must be rounded again. A few times are enough, unless the window's
  // shape differs greatly from that of the last one.
  constexpr int kTimes = 8, kSteps = 64;
  for (int time = 0; time < kTimes; ++time) {
    Rounded vectors = rounded(j);
    int steps = 0;
    Step step = shorten(vectors);
    for (; step == Step::done && steps < kSteps; ++steps) step = shorten(vectors);
    if (step == Step::out_of_range) break;
    if (steps == 0) return changed || order_ != before;
    changed = true;
  }
  std::array<BasisVector, 3> ordered;
  for (std::size_t i = 0; i < 3; ++i) ordered[i] = std::move(vectors_[order_[i]]);
  vectors_ = std::move(ordered);
  order_ = {0, 1, 2};
  reduce(vectors_, window_form(velocity_, j));
  return true;
}

}  // namespace lorentz::oracle
