// The constants of bounds.hpp, computed again: the formulas of predicates.hpp are run on numbers that carry a
// bound of their error, and the predicates on cases at their boundary, with the bounds as they are and 50
// times too small.
#include "src/engines/reduction/bounds.hpp"

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include "src/engines/reduction/predicates.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using lorentz::test::Draw;

namespace {

/// A number of at most this size that errs by at most this much (in units of the roundoff u), to first order.
/// Each operation adds the rounding of its result to what its operands bring.
struct Carried {
  double size, error = 0;

  friend Carried operator+(Carried a, Carried b) { return rounded({a.size + b.size, a.error + b.error}); }
  friend Carried operator-(Carried a, Carried b) { return a + b; }
  friend Carried operator*(Carried a, Carried b) {
    return rounded({a.size * b.size, a.size * b.error + a.error * b.size});
  }
  friend Carried operator/(Carried a, Carried b) {  // b of exactly this size
    return rounded({a.size / b.size, a.error / b.size + a.size * b.error / (b.size * b.size)});
  }
  friend Carried sqrt(Carried a) { return rounded({std::sqrt(a.size), a.error / (2 * std::sqrt(a.size))}); }

 private:
  static Carried rounded(Carried a) { return {a.size, a.error + a.size}; }
};

Carried exact(double size) {
  return {size};
}

// That a constant is not below what is derived, and not so far above it that the derivation says nothing.
void covers(double constant, double derived) {
  INFO("constant " << constant << ", derived " << derived);
  CHECK(constant >= derived);
  CHECK(constant <= 2.5 * derived);
}

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>>;

}  // namespace

TEST_CASE("Height in a row: kHeight", "[engines][bounds]") {
  // Relative to the sum of the terms' sizes, so the worst is the worst of one term alone. D_R and D_L are
  // rounded sums: one roundoff each. What y brings besides its own roundings is accounted for apart.
  const Carried one = exact(1), none = exact(0), D{1, 1};
  const double of_y = height_in_row(one, none, none, none, none).error;
  const double of_R = height_in_row(none, one, D, none, none).error;
  const double of_L = height_in_row(none, none, none, one, D).error;
  covers(kHeight, std::max({of_y, of_R, of_L}));
}

TEST_CASE("Position along the line: kAlong", "[engines][bounds]") {
  // S_R and S_L are themselves sums of two or three products of rounded forms.
  const Carried form = exact(1) * exact(1) + exact(0), S = exact(1) * form + exact(0) + exact(0);
  covers(kAlong, sum_along(exact(0), exact(1), S, exact(0), exact(0)).error);
}

TEST_CASE("Across the line in 3D: kAcross", "[engines][bounds]") {
  // A coordinate is the anchor's plus at most four steps along the basis; each step rounds a product whose
  // factor errs by 3 roundoffs (compensated sum, scale), and each sum rounds all before it.
  const Carried arm{1, 3};
  Carried first = exact(1) * arm;  // the term that passes all the sums
  for (int sums = 0; sums < 4; ++sums) first = first + exact(0);
  covers(kAcross, first.error);
}

TEST_CASE("Coordinates in a cell: kCoordinate", "[engines][bounds]") {
  // In units of |B_j| |B_k|, kappa = 1. A component of B_j x B_k, from rounded vectors: the sizes of its two
  // terms add up to 1 at most.
  const Carried b{1, 1};
  const Carried cross = b * b - exact(0);
  // The volume: its three terms add up to 1, but each component of the cross product may err by as much as
  // the largest, so sqrt(3) times its error comes in.
  const Carried volume = b * Carried{1, std::sqrt(3) * cross.error} + exact(0) + exact(0);
  const Carried dual = cross / volume;
  covers(kCoordinate, (dual * b + exact(0) + exact(0)).error);
}

TEST_CASE("Scale and radius: kScale, kRho, kInside", "[engines][bounds]") {
  // rho = r sqrt(v.v); the comparison rounds once more, and so does the sum with the spread.
  const Carried c = exact(1);
  const Carried v2 = speed_squared(c, c, c), rho = exact(1) * sqrt(v2);
  covers(kRho, rho.error / rho.size + 2);
  // scale = 1 / (sqrt(v_a^2 + v_b^2) r) / |v|, squared, and |p|^2 by two products and a sum.
  const Carried across = sqrt(c * c + c * c), scale = c / (across * c) / sqrt(v2);
  const Carried p{1, scale.error / scale.size}, square = p * p + exact(0) * exact(0);
  covers(kScale, square.error);
  // |d|^2 - r^2.
  const double of_d = (c * c + exact(0) + exact(0)).error + 1, of_r = (c * c).error + 1;
  covers(kInside, std::max(of_d, of_r));
}

TEST_CASE("At the boundary the predicate is never wrong; with a bound 50 times smaller it is",
          "[engines][bounds]") {
  Draw draw(17);
  long decided = 0, doubtful = 0, wrong_if_shrunk = 0;
  for (int i = 0; i < 400'000; ++i) {
    const double y = draw.tiny(-3, 3), n = std::floor(draw.between(-100, 100)),
                 m = std::floor(draw.between(-100, 100));
    const double D_R = draw.tiny(-6, 0), D_L = draw.tiny(-6, 0);
    const Real height = abs(Real(y) + Real(n) * D_R - Real(m) * D_L);
    const double h = height_in_row(y, n, D_R, m, D_L),
                 rho = static_cast<double>(height) * (1 + draw.tiny(-56, -40));
    if (!(rho > 0)) continue;
    const double error = kHeight * kRoundoff * (std::fabs(y) + std::fabs(n * D_R) + std::fabs(m * D_L));
    const bool below = height < rho;
    const Decision decision = is_below(h, rho, error),
                   shrunk = is_below(h, rho, error / 50 - kRho * kRoundoff * rho * 0.98);
    if (decision == Decision::doubtful) {
      ++doubtful;
    } else {
      ++decided;
      REQUIRE((decision == Decision::yes) == below);
    }
    if (shrunk != Decision::doubtful) wrong_if_shrunk += (shrunk == Decision::yes) != below;
  }
  CHECK(decided > 100'000);
  CHECK(doubtful > 50'000);
  CHECK(wrong_if_shrunk > 100);
}
