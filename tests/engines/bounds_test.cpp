// The constants of bounds.hpp, computed again: the engine's own formulas (formulas.hpp) are run on numbers
// that carry a bound of their error, and the predicates on cases at their boundary, with the bounds as they
// are and 50 times too small. What an ellipsoid brings is measured besides: shape_test.cpp.
#include "src/engines/reduction/bounds.hpp"
#include <lorentz/engine_base.hpp>
#include <lorentz/geometry.hpp>

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/predicates.hpp"
#include "src/engines/reduction/reduce_3d.hpp"
#include "src/engines/reduction/sparse_rows.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using lorentz::test::Draw;

namespace {

/// A number of at most this size that errs by at most this much (in units of the roundoff u), to first order.
/// Each operation adds the rounding of its result to what its operands bring.
struct Carried {
  double size = 0, error = 0;

  friend Carried operator+(Carried a, Carried b) { return rounded({a.size + b.size, a.error + b.error}); }
  friend Carried operator-(Carried a, Carried b) { return a + b; }
  Carried operator-() const { return *this; }
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

/// An exact product or sum of two numbers, as a high and a low part: what the operands bring, the low part
/// has.
struct CarriedPair {
  Carried hi, lo;

  static CarriedPair product(Carried a, Carried b) {
    const double size = a.size * b.size;
    return {{size}, {size * kRoundoff, a.size * b.error + a.error * b.size}};
  }
  static CarriedPair sum(Carried a, Carried b) {
    const double size = a.size + b.size;
    return {{size}, {size * kRoundoff, a.error + b.error}};
  }
};

/// The same as Carried in double-double, in units of u^2 (docs/bounds.md, lemma 2).
struct CarriedWide {
  double size = 0, error = 0;

  CarriedWide() = default;
  CarriedWide(double exactly, double its_error = 0) : size(exactly), error(its_error) {}
  static CarriedWide product(double a, double b) { return {a * b}; }

  friend CarriedWide operator+(CarriedWide a, CarriedWide b) {
    const double size = a.size + b.size;
    return {size, a.error + b.error + (a.size == 0 || b.size == 0 ? 0 : 3 * size)};
  }
  friend CarriedWide operator-(CarriedWide a, CarriedWide b) { return a + b; }
  friend CarriedWide operator*(CarriedWide a, CarriedWide b) {
    return {a.size * b.size, a.size * b.error + a.error * b.size + 5 * a.size * b.size};
  }
  friend CarriedWide operator*(CarriedWide a, double b) { return {a.size * b, a.error * b + 3 * a.size * b}; }
  friend CarriedWide operator/(CarriedWide a, CarriedWide b) {  // b of exactly this size
    const double size = a.size / b.size;
    return {size, a.error / b.size + size * b.error / b.size + 15 * size};
  }
  friend CarriedWide add_product(CarriedWide sum, CarriedWide a, double b) {
    const double size = sum.size + a.size * b;
    return {size, sum.error + a.error * b + 4 * size};
  }
};

const Carried one{1}, none{0};

// That a constant is not below what is derived, and not so far above it that the derivation says nothing.
void covers(double constant, double derived, double times = 2.5) {
  INFO("constant " << constant << ", derived " << derived);
  CHECK(constant >= derived);
  CHECK(constant <= times * derived);
}

// That it is large enough: more would do no harm.
void is_enough(double constant, double derived) {
  INFO("constant " << constant << ", derived " << derived);
  CHECK(constant >= derived);
}

// v . v in 2D, where the last sum adds zero; and 1 / A = 1 / (v^2 times the cell's area), whose two terms add
// up to 1.
Carried v_squared() {
  Carried v2 = speed_squared(one, none, none);
  --v2.error;
  return v2;
}
Carried inverse_area() {
  return one / (v_squared() * difference_of_products(Carried{1, 1}, Carried{1, 1}, none, none));
}

// S of an arm: an integer combination of the forms along the line, of vectors that were rounded.
Carried along_of_arm() {
  return sum_of_products(one, sum_of_products(one, Carried{1, 1}, none, none), none, none);
}

// A coordinate across of a vector of a 3D basis, but for the scale that is common to all: rounded after its
// compensated sum, and by one product.
Carried across_of_arm() {
  return one * Carried{1, 1} * one;
}

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>>;

}  // namespace

TEST_CASE("What is taken as zero: kFlushed", "[engines][bounds]") {
  // A tiny component of v or of the offset times one of 2^53 cells, three of these; and a tiny component of a
  // lattice vector times a coefficient of the short basis, likewise. Cells are below 2^kMaxSpacing.
  const double cells = 3 * kMaxCoefficient;
  is_enough(kFlushed, 2 * kTinyComponent * cells);
  is_enough(kFlushed, 2 * kTinyVectorComponent * kMaxTransform * cells);
}

TEST_CASE("Height in a row: kHeight", "[engines][bounds]") {
  // Relative to the sum of the terms' sizes, so the worst is the worst of one term alone. D_R and D_L are
  // rounded sums: one roundoff each. What y brings besides its own roundings is accounted for apart.
  const Carried D{1, 1};
  const double of_y = height_in_row(one, none, none, none, none).error;
  const double of_R = height_in_row(none, one, D, none, none).error;
  const double of_L = height_in_row(none, none, none, one, D).error;
  covers(kHeight, std::max({of_y, of_R, of_L}));
}

TEST_CASE("Position along the line: kAlong", "[engines][bounds]") {
  covers(kAlong, sum_along(none, one, along_of_arm(), none, none).error);
  covers(kAlongOnUnit, sum_along(none, one, sum_of_products(one, one, none, none), none, none).error);
  // 3D: four steps from the anchor, each of a rounded z.
  Carried z = stepped(none, one, Carried{1, 1});
  for (int step = 1; step < 4; ++step) z = stepped(z, none, none);
  covers(kAlong, z.error);
}

TEST_CASE("An anchor's height, and other compensated sums: kAnchor, kAnchorTerms", "[engines][bounds]") {
  // The last sum rounds its result; what else there is, is small beside the terms. A form in double-double
  // errs by 6 u^2 of its terms.
  const CarriedPair form{{1}, {kRoundoff, 6 * kRoundoff}}, nothing{};
  const auto of_terms = [](Carried sum) { return (sum.error - sum.size) * kRoundoff; };
  const CarriedPair two[2] = {form, nothing}, three[3] = {form, nothing, nothing};
  const Carried n2[2] = {one, none}, n3[3] = {one, none, none};
  const Carried height = compensated_height<true>(nothing, n2, two);
  covers(kAnchor, 1, 3);  // of the result
  covers(kAnchorTerms, of_terms(height), 5);
  covers(kAnchorTerms, of_terms(compensated_sum<CarriedPair>(three, n3)), 5);
  const CarriedPair wide_n[3] = {{one, {kRoundoff}}, nothing, nothing};
  covers(kAnchorTerms, of_terms(compensated_sum<CarriedPair>(three, wide_n, nothing)), 5);
  covers(kAnchorTerms, of_terms(compensated_sum_from<CarriedPair>(nothing, three, n3)), 5);
}

TEST_CASE("Rows beside the start, and where they enter the strip", "[engines][bounds]") {
  const Carried S = along_of_arm(), D{1, 1};
  const double number = std::max(row_number(S, one, none, none, inverse_area()).error,
                                 row_number(none, none, D, one, inverse_area()).error);
  covers(kRowNumber, number);
  covers(kRowSlop, number * kRoundoff * 0x1p20);  // terms below 2^20
  // D and the radius are rounded; 1 / D_L is computed beforehand.
  const Carried inverse = one / D, rho = width_of(one, v_squared()),
                y = height_in_row(none, one, D, none, none);
  covers(kRowEntry, std::max(entry_of_row(y, none, inverse).error, entry_of_row(none, rho, inverse).error));
  const double passing = passing_of_row(none, one, S, one / S).error;
  covers(kSlop2d, passing * kRoundoff * 0x1p18);  // quotients below 2^18
  covers(kRowSlope, (row_slope(D, inverse_area()).error + 2) * kRoundoff,
         3);  // its own product, and the sum
}

TEST_CASE("A vector of the short basis: kBasis, kBasisInHeight, kBasisInSize, kForm", "[engines][bounds]") {
  CarriedWide component(0);
  for (int j = 0; j < 3; ++j) component = component + CarriedWide::product(1, 1);
  covers(kBasis, component.error);
  // A form is v . a or v x a, with |v| < 2 sqrt(2) or 2 sqrt(3), or at most |a| in units of r. In 2D a
  // component errs by as much as the others. In 3D what the components err by adds up: see kPlace below; of
  // the basis it is 6 times what is derived above.
  is_enough(kForm, 2 + 2);
  is_enough(kForm, 6 * component.error / kBasis);
  is_enough(kForm, kDiagonal);
  covers(kDiagonal, std::sqrt(3));
  // Terms of this size times kAnchorTerms err by what the basis brings: times 4 in 2D; in 3D kForm follows.
  is_enough(kBasisInHeight * kAnchorTerms, 4);
  is_enough(kBasisInSize * kAnchorTerms, 3);
}

TEST_CASE("An obstacle's place: kPlace", "[engines][bounds]") {
  const CarriedWide step = CarriedWide(1) * CarriedWide(1), little(0x1p-60);
  const CarriedWide first[3] = {step, little, little};  // this term passes all the sums
  covers(kPlace, place_after(first, little).error * kWideRoundoff);
  // The offset from a home cell; each component errs by so much of its own terms only, so all three together
  // by no more than this in a form with components of 2.
  CarriedWide d(1);
  for (int i = 0; i < 3; ++i) d = add_product(d, CarriedWide(0), 1.0);
  covers(kPlace, d.error * kWideRoundoff);
  is_enough(kForm * kPlace, 2 * d.error * kWideRoundoff);
}

TEST_CASE("Coordinates in a cell: kCoordinate", "[engines][bounds]") {
  // In units of |B_j| |B_k|, kappa = 1. A component of B_j x B_k, from rounded vectors: the sizes of its two
  // terms add up to 1 at most.
  using Vector = std::array<Carried, 3>;
  const Carried b{1, 1};
  const Carried cross = cross_product(Vector{none, b, none}, Vector{none, none, b})[0];
  // The volume: its three terms add up to 1, but each component of the cross product may err by as much as
  // the largest, so sqrt(3) times its error comes in.
  const Carried volume =
      volume_of(Vector{b, none, none}, Vector{Carried{1, std::sqrt(3) * cross.error}, none, none});
  const Carried dual = cross / volume;
  covers(kCoordinate, sum_of_products(dual, b, none, none, none, none).error);
}

TEST_CASE("Radius and insideness: kRho, kInside, kInsideEllipsoid", "[engines][bounds]") {
  // rho = r sqrt(v.v); the comparison rounds once more, and so does the sum with the spread.
  const Carried rho = width_of(one, speed_squared(one, none, none));
  covers(kRho, rho.error + 2);
  // |d|^2 - r^2, where the high parts of d are a roundoff off; how the difference is rounded does not change
  // its sign.
  const Carried d[3] = {Carried{1, 1}, none, none};
  covers(kInside, std::max(square_of(d).error, (one * one).error));
  struct Entry {
    Carried hi;
  };
  const Entry G[3][3] = {{{{1, 1}}, {}, {}}, {}, {}};
  covers(kInsideEllipsoid, form_of(G, d).error);
}

TEST_CASE("A single ball: kLoneAlong, kLoneAcross, kLoneSlack", "[engines][bounds]") {
  // The high part of d is a roundoff off. The terms of s err relative to |v_k d_k|, whose sum is at most
  // |v| |d|; those of v x d relative to |v_i d_k| + |v_k d_i|, whose norm is at most sqrt(2) of that.
  const Carried d{1, 1};
  covers(kLoneAlong, sum_of_products(one, d, none, none, none, none).error);
  covers(kLoneAcross, std::sqrt(2) * difference_of_products(one, d, none, none).error);
  // The width takes |v|^2 and two products, |v x d|^2 a square and two sums; their difference rounds, too.
  const Carried h[3] = {one, none, none};
  covers(kLoneSlack,
         std::max(squared_width_of(one, speed_squared(one, none, none)).error, square_of(h).error) + 1);
}

TEST_CASE("A root from above is at least the root, and little more", "[engines][bounds]") {
  Draw draw(7);
  for (int i = 0; i < 100'000; ++i) {
    // All mantissas; also next to those at which it is the root.
    double a = std::fabs(draw.tiny(-1000, 1000)) * draw.between(1, 4);
    if (draw.one_in(4)) a = std::nextafter(std::ldexp(1, std::ilogb(a)), draw.one_in(2) ? 0 : HUGE_VAL);
    const double root = root_above(a);
    CHECK((root >= std::sqrt(a) && root <= 1.07 * std::sqrt(a)));
  }
  CHECK((root_above(0) >= 0 && root_above(0x1p-1074) >= 0x1p-537 && root_above(HUGE_VAL) == HUGE_VAL));
  CHECK(std::isnan(root_above(std::nan(""))));
}

TEST_CASE("Rows beside a line: kSparse, kSparseOfShape", "[engines][bounds]") {
  // A row's start d + k e, where e = t_0 B_0 + t_1 B_1; high parts are a roundoff off.
  const Carried high{1, 1}, step = high * one + none, start = step * one + none;
  covers(kSparse, std::sqrt(2) * difference_of_products(one, start, none, none).error);
  covers(kSparse, sum_of_products(one, start, none, none, none, none).error);
  const Carried normal = difference_of_products(high, high, none, none);
  covers(kLayer, sum_of_products(high, normal, none, none, none, none).error);
  // N a for two vectors, whose norms are at most the condition times those of their images; the norm of N is
  // that of all its rows.
  const Carried N{1, 1}, image = sum_of_products(N, high, none, none, none, none);
  covers(kSparseOfShape, 2 * image.error);
}

namespace {

using Exact = boost::multiprecision::mpfr_float_100;
using ExactVec = std::array<Exact, 3>;

ExactVec exact(const Vec& a) {
  return {a[0], a[1], a[2]};
}
ExactVec exact_sum(const Vec& a, double n, const Vec& b) {
  ExactVec sum = exact(a);
  for (int k = 0; k < 3; ++k) sum[k] += Exact(n) * Exact(b[k]);
  return sum;
}
Exact exact_square(const ExactVec& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}
ExactVec exact_cross(const ExactVec& a, const ExactVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact exact_dot(const ExactVec& a, const ExactVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

// Lines that pass a row at up to a radius, half of them nearly along it, far out; two in three meet a ball,
// or a row, by less than is computed.
TEST_CASE("Ranges of rows and of balls leave out none that a line meets", "[engines][bounds]") {
  Draw draw(20261125);
  long met = 0, looked_at = 0, met_rows = 0, rows = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Vec b = draw.vec(dimension, -1, 1), aside = draw.vec(dimension, -1, 1);
    Vec e = draw.vec(dimension, -1, 1), v = draw.vec(dimension, -1, 1), d{};
    if (draw.one_in(2))
      for (int k = 0; k < 3; ++k) v[k] = b[k] + std::exp2(draw.between(-20, -1)) * v[k];
    if (draw.one_in(4))  // a plane that is nearly parallel to the line
      for (int k = 0; k < 3; ++k) e[k] = v[k] - 0.25 * b[k] + std::exp2(draw.between(-30, -1)) * e[k];
    const double speed = std::exp2(std::round(draw.between(-10, 10)));
    for (int k = 0; k < 3; ++k) v[k] *= speed;
    double r = length(b) * draw.between(0.01, 0.5);
    const double far = std::round(std::exp2(draw.between(0, 30)));
    for (int k = 0; k < 3; ++k) d[k] = far / speed * v[k] - 4 * b[k] + r * aside[k];
    const ExactVec c = exact_cross(exact(v), exact(b));
    const double number = static_cast<double>(draw.below(9)),
                 row_number = draw.one_in(2) ? number : std::round(std::exp2(draw.between(4, 30)));
    const Exact of_ball =
                    exact_square(exact_cross(exact(v), exact_sum(d, number, b))) / exact_square(exact(v)),
                of_row = abs(exact_dot(exact_sum(d, row_number, e), c)) / sqrt(exact_square(c));
    const auto touching = draw.below(3);
    if (touching > 0)
      r = std::nextafter((touching == 1 ? sqrt(of_ball) : of_row).convert_to<double>(), 1e300);
    const auto seen = [](const Vec& a) { return SparseVector<3>{{a[0], a[1], a[2]}, length(a)}; };
    const SparseRow<3> row({v[0], v[1], v[2]}, kSparse * kRoundoff, seen(b), r, 0);
    const auto range = row.balls(seen(d)), planes = row.rows(seen(d), seen(e));
    if (row.is_level()) continue;
    if (range.known) looked_at += static_cast<long>(std::clamp(range.last - range.first + 1, 0.0, 25.0));
    if (planes.known) rows += static_cast<long>(std::clamp(planes.last - planes.first + 1, 0.0, 25.0));
    for (double n = -8; n <= 16; ++n) {
      const Exact across = exact_square(exact_cross(exact(v), exact_sum(d, n, b)));
      if (range.known && across < Exact(r) * Exact(r) * exact_square(exact(v))) {
        ++met;
        CHECK((range.first <= n && n <= range.last));
      }
      const double k = n < 16 ? n : row_number;
      const Exact distance = exact_dot(exact_sum(d, k, e), c);
      if (planes.known && distance * distance < Exact(r) * Exact(r) * exact_square(c)) {
        ++met_rows;
        CHECK((planes.first <= k && k <= planes.last));
      }
    }
  }
  INFO(met << " of " << looked_at << ", rows " << met_rows << " of " << rows);
  CHECK((met > 5000 && looked_at < 3 * met));
  CHECK((met_rows > 5000 && rows < 3 * met_rows));
}

TEST_CASE("Across the line in 3D: kAcross, kScale", "[engines][bounds]") {
  // A coordinate is the anchor's plus at most four steps along the basis. The first passes all the sums.
  Carried p = stepped(none, one, across_of_arm());
  for (int step = 1; step < 4; ++step) p = stepped(p, none, none);
  covers(kAcross, p.error);
  // The second scale is the first over |v|. Squared, and |p|^2 by two products and a sum.
  const Carried across = sqrt(sum_of_products(one, one, none, none)),
                scale = first_scale(one, across, one) / sqrt(speed_squared(one, none, none));
  const Carried point[2] = {scale, none};
  covers(kScale, square_of(point).error);
}

TEST_CASE("Lines in 3D: kLine, kDiscriminant, kLineEnd", "[engines][bounds]") {
  Carried at = stepped(none, one, across_of_arm());
  for (int step = 1; step < 4; ++step) at = stepped(at, none, none);
  const Carried q[2] = {at, none}, a[2] = {none, across_of_arm()};
  const double moment = moment_of_line(q, a).error;
  covers(kLine, moment);
  // The discriminant |a|^2 - moment^2, relative to |a|^2, where the moment is up to |a| and errs by the
  // line's error e |a|; in units of e >= kLine u. Its root is no smaller than the true one then, and b /
  // |a|^2 errs by no more than the moment does.
  const Carried square = square_of(a), product = Carried{1, kLine} * Carried{1, kLine};
  covers(kDiscriminant, (square.error + product.error + 1) / kLine, 4);
  covers(kLineEnd, (moment + square.error + 2) / kLine, 6);
}

TEST_CASE("Planes in 3D: kTilt, kPlane, kSlop3d", "[engines][bounds]") {
  // dual_2 along the line is b_0 x b_1 across, divided by the volume.
  const Carried p = across_of_arm();
  covers(kTilt, (difference_of_products(p, p, none, none) * one).error, 4);
  // |b_2| |dual_2| = kappa sin(b_0, b_1) <= kMaxDefect, and the sine is no less than 1 / kMaxDefect, because
  // b_0 is as far from the line along b_1 as from the plane of b_1 and b_2 at least, which is 1 / |dual_0|.
  // So kappa is at most kMaxDefect^2, and b_0 x b_1 no more than that smaller than |b_0| |b_1|.
  constexpr double kMaxKappa = kMaxDefect * kMaxDefect;
  const Carried cross = difference_of_products(p, p, none, none);
  const double of_cross = kMaxKappa * cross.error;
  const Carried volume = sum_of_products(p, Carried{1, std::sqrt(3) * cross.error}, none, none, none, none);
  const double of_volume = kMaxKappa * volume.error;
  const Carried dual = Carried{1, of_cross} * (one / Carried{1, of_volume});
  // The terms of kappa err by what the points err (kAcross), and so does the length of dual_2 across.
  const Carried kappa = sum_of_products(dual, Carried{1, kAcross}, none, none, none, none),
                inverse_g = one / sqrt(sum_of_products(dual, dual, none, none));
  covers(kPlane, distance_of_plane(kappa, none, none, inverse_g).error);
  // Numbers of planes, with terms below 2^20, and half of it for the anchor.
  covers(kSlop3d, kSlop3d / 2 + distance_of_plane(kappa, none, none, one).error * kRoundoff * 0x1p20);
  is_enough(kSectionSlop, sqrt((one - none) * (one + none) + none).error * kRoundoff);
}

TEST_CASE("Windows in 3D: kWindowStart, kNextWindow, kEntryCurvature", "[engines][bounds]") {
  // z is at most 2 in size with its steps, a point's number of which the anchor's is rounded once.
  covers(kWindowStart, 2 * kAlong * kRoundoff);
  covers(kNextWindow, (one + none).error + 0.5);  // and of the product with u
  // Newton's step, of 1, to the root x of x - b x^2 = 1, where b is what the curvature adds.
  const double b = kEntryCurvature, root = (1 - std::sqrt(1 - 4 * b)) / (2 * b);
  covers(2 * b, root - 1);
  is_enough(kEntrySlop, 1 + 0.5);  // rounded down, from a rounded estimate
}

TEST_CASE("What is rounded up without much thought: kAmple, kReachSlop", "[engines][bounds]") {
  // The farthest s of interest; and the norm of a matrix, of which the condition is a product of two.
  is_enough(kAmple,
            (one * speed_squared(one, none, none) + width_of(one, speed_squared(one, none, none))).error *
                kRoundoff);
  const Carried entries[9] = {one, one, one, one, one, one, one, one, one};
  const Carried norm = sqrt(square_of(entries));
  is_enough(kAmple, (norm * norm / one).error / 9 * kRoundoff);
  // A form in the metric of a shape, whose terms may cancel as far as its condition allows.
  const Carried row = sum_of_products(Carried{1, 1}, one, none, none, none, none);
  is_enough(kReachSlop, (one * row / one).error * kMaxCondition * kRoundoff);
}

TEST_CASE("In double-double: kStable and its multiples", "[engines][bounds]") {
  // Relative to |v| |d| sqrt(2) and |d|^2: the worst term passes two sums.
  const CarriedWide d(1), nothing;
  const double v = 1;
  const double across = difference_of_products(d, v, nothing, v).error;
  const double along = sum_of_products(d, v, nothing, v, nothing, v).error;
  const CarriedWide components[3] = {d, nothing, nothing};
  const double square = square_of(components).error;
  is_enough(kStable, std::max({across, along, square}) * kWideRoundoff);
  // All terms in size, sqrt(3) of the lengths' product each.
  const CarriedWide every[3] = {d, d, d};
  const double worst =
      std::max({difference_of_products(d, v, d, v).error * std::sqrt(3) / 2,
                sum_of_products(d, v, d, v, d, v).error / 3 * std::sqrt(3), square_of(every).error / 3});
  covers(kStable, worst * kWideRoundoff);
  // G d, and d . G d.
  const CarriedWide form = sum_of_products(d, d, nothing, nothing, nothing, nothing) * d;
  covers(kStableForm, 3 * form.error * kWideRoundoff);
  // r^2 and |d|^2 are about the same, and their difference rounds once.
  const CarriedWide gap = CarriedWide::product(1, 1) + square_of(every) * (1.0 / 3);
  is_enough(kStableGap, gap.error * kWideRoundoff);
  const CarriedWide time = (d - nothing) / d;
  is_enough(kStableTime, time.error * kWideRoundoff);
  covers(kRoot, sqrt(Carried{1, 0.5}).error + 0.5);  // its low part is left aside
}

TEST_CASE("The shape of an ellipsoid: its metric in double-double", "[engines][bounds]") {
  // Semiaxes with all components 1, of the length sqrt(3); Frobenius norms are 3 times an entry. The factors
  // sqrt(2) and sqrt(3) are for rows in other directions. Each constant is derived from exact numbers: what
  // the others bring is added where it is used.
  const std::array<std::array<double, 3>, 3> a{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  ShapeForms<CarriedWide> forms;
  forms.set_adjugate(a);
  const double third = 1 / 3.0;  // of the square of a length
  covers(kAdjugate, 3 * forms.adjugate[0][0].error * third * std::sqrt(2));
  covers(kDeterminant, forms.det.error * third * std::sqrt(third) * std::sqrt(3));
  ShapeForms<CarriedWide> exact;
  for (auto& row : exact.adjugate)
    for (CarriedWide& entry : row) entry = 1;
  exact.det = 1;
  exact.set_forms(a, 1);
  covers(kToBall, exact.to_ball[0][0].error);
  covers(kCofactor, exact.cofactor[0][0].error);
  for (auto& row : exact.to_ball)
    for (CarriedWide& entry : row) entry = 1;
  exact.set_metric();
  covers(kMetric, 3 * exact.metric[0][0].error / 9);  // relative to |N|^2 = 9
}

TEST_CASE("The width of an ellipse: kRhoOfShape, kAlongOfShape", "[engines][bounds]") {
  // w = N v, relative to |N| |v|, which is up to c |w|; the rest is as for discs.
  const Carried N{1, 1};
  const double of_w = sum_of_products(N, one, none, none).error;
  const auto rho_error = [&](double c) {
    const Carried w[2] = {{1, c * of_w}, none};
    return width_of(one, square_of(w)).error;
  };
  covers(kRhoOfShape, rho_error(1) - rho_error(0));
  // v^2, which the time is divided by, errs by up to twice as much: Entry::v2_error.
  for (const double c : {1.0, 16.0, kMaxCondition}) {
    const Carried w[2] = {{1, c * of_w}, none};
    covers(2 * (kRho + kRhoOfShape * c), square_of(w).error, 4);
  }
  is_enough(kRho, rho_error(0) + 3);  // det N's rounding, and two of a comparison
  // s = (N^T w) . d, relative to |N| |w| |d|, where c >= 1; sqrt(2) since the terms add up in both sums.
  const Carried along = sum_of_products(N, Carried{1, of_w}, none, none);
  covers(kAlongOfShape, std::sqrt(2) * sum_of_products(along, one, none, none).error);
}

TEST_CASE("The time from binary64: kRoughTime", "[engines][bounds]") {
  // s and q have their own errors; those of the root, the difference, the quotient and v^2 are here.
  const Carried q = sqrt(one), v2 = speed_squared(one, none, none);
  covers(kRoughTime, rough_time_of(one, none, v2).error + rough_time_of(none, q, v2).error);
}

TEST_CASE("At the boundary the predicate is never wrong, with a bound 50 times smaller it is",
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
  CHECK(decided > 170'000);        // 214 604 seen
  CHECK(doubtful > 150'000);       // 185 396 seen
  CHECK(wrong_if_shrunk > 3'500);  // 4 465 seen
}

TEST_CASE("Times that are soon rounded: kSoonSlack, kSoonTime", "[engines][bounds]") {
  // Kahan's difference of products rounds twice; r^2 v^2 is of a rounded v^2; the square of h is not rounded.
  const Carried h{1, 2}, rho2 = one * one * Carried{1, 1}, slack = rho2 - h * h;
  covers(kSoonSlack, slack.error);
  // s: low parts of three products and two sums, and those of three components, each a roundoff of |v| |d|;
  // v^2 has fewer. The quotient, whose divisor's inverse is three roundings off, is mended by what it leaves.
  Carried low{kRoundoff};
  for (int part = 1; part < 8; ++part) low = low + Carried{kRoundoff};
  const Carried rest = (Carried{8 * kRoundoff} + Carried{8 * kRoundoff}) * Carried{1, 4};
  const double own = (2 * low.error + rest.error) * kRoundoff;
  // Twice the bound of double-double, so that this is certain, too.
  is_enough(kSoonTime, 2 * own + 2 * 2 * (2 * kStable + kStableTime));
}

TEST_CASE("A basis in 3D is usable only if each of its vectors is", "[engines][bounds]") {
  const auto usable = [](int i, double coefficient, double tilt) {
    Basis3 basis{};
    for (int k = 0; k < 3; ++k) {
      Arm3& arm = basis.b[k];
      double* const components[] = {&arm.p[0], &arm.p[1], &arm.z};
      *components[k] = arm.n[k] = 1;
      if (k != i) continue;  // this one is turned towards both others, which stand upright all the same
      *components[(k + 1) % 3] = *components[(k + 2) % 3] = tilt;
      arm.n[(k + 1) % 3] = coefficient;
    }
    basis.set_dual();
    return basis.usable;
  };
  for (int i = 0; i < 3; ++i) {
    CHECK(usable(i, 0x1p53 - 1, 1));
    CHECK_FALSE(usable(i, 0x1p53, 1));
    CHECK_FALSE(usable(i, -0x1p53, 1));
    CHECK(usable(i, 0, 1.8));        // sqrt(1 + 2 * 1.8^2) = 2.74
    CHECK_FALSE(usable(i, 0, 1.9));  // 2.87; the others' is 2.15
    CHECK_FALSE(usable(i, 0, NAN));
  }
}

TEST_CASE("A step of the greedy reduction by a large quotient, of either sign, wants exact coordinates",
          "[engines][bounds]") {
  const auto reduces = [](double s, double t, double turn) {  // turn b - a = (0, t), of which a holds s / t
    Basis3 basis{};
    const double places[3][3] = {{1, s, 0}, {turn, turn * (s + t), 0}, {0, 0, 8}};
    for (int i = 0; i < 3; ++i) {
      Arm3& arm = basis.b[i];
      arm.p[0] = places[i][0], arm.p[1] = places[i][1], arm.z = places[i][2], arm.n[i] = 1;
    }
    return GreedyReduction(basis).run();
  };
  for (const double s : {0.5, -0.5})
    for (const double sign : {1., -1.})
      for (const double turn : {1., -1.}) {
        CHECK(reduces(s, sign * 0x1p-20, turn));
        CHECK_FALSE(reduces(s, sign * 0x1p-22, turn));
      }
}

TEST_CASE("A basis is exact only if each of its components is", "[engines][bounds]") {
  for (const int dimension : {2, 3})
    for (int k = 0; k < dimension; ++k)
      for (const double rest : {0., 0x1p-60}) {
        // u_1 - u_0 is (0.1 - rest) e_k: rounded, if there is a rest.
        const int other = (k + 1) % dimension;
        Scene scene{dimension, {{{}, {Atom{{}, 0.01, {}}}}}};
        auto& u = scene.lattices[0].vectors;
        u[0][other] = u[1][other] = 1;
        u[0][k] = rest, u[1][k] = 0.1;
        if (dimension == 3) u[2][(k + 2) % 3] = 1;
        const PreparedScene prepared = prepare(scene);
        REQUIRE(prepared.beyond == "");
        CHECK(prepared.atoms.at(0).exact == (rest == 0));
        CHECK((prepared.atoms[0].basis_error == 0) == (rest == 0));
      }
}
