// Double-double arithmetic against MPFR: the stated bounds, and the same bits with and without the
// instruction.
#include "src/engines/base/double_double.hpp"

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include "tests/support/support.hpp"

using namespace lorentz;
using lorentz::test::Draw;

namespace {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>>;
using Fused = DoubleDouble<HardwareFma>;  // without the instruction, the library's fma: the same value

constexpr double u = 0x1p-53;

template <class DD>
Real exact(const DD& a) {
  return Real(a.hi) + Real(a.lo);
}

Wide drawn(Draw& draw) {
  const double hi = draw.tiny(-40, 40);
  return Wide::ordered_sum(hi, hi * draw.tiny(-60, -53));
}

// The largest relative error of an operation over many drawn pairs, some of them nearly cancelling, in units
// of u^2.
template <class Operation, class Truth>
double worst(Operation operation, Truth truth) {
  Draw draw(11);
  Real largest = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Wide a = drawn(draw);
    const Wide b = draw.one_in(4) ? Wide::ordered_sum(-a.hi * (1 + draw.tiny(-60, -1)), a.lo) : drawn(draw);
    const Wide result = operation(a, b);
    const Fused fused = operation(Fused(a), Fused(b));
    REQUIRE(result.hi == fused.hi);
    REQUIRE(result.lo == fused.lo);
    const Real right = truth(exact(a), exact(b));
    if (right == 0) {
      REQUIRE(exact(result) == 0);
      continue;
    }
    largest = std::max<Real>(largest, abs((exact(result) - right) / right));
  }
  return static_cast<double>(largest / (u * u));
}

}  // namespace

TEST_CASE("The error of a product is exact, with the instruction and without", "[engines][double_double]") {
  Draw draw(12);
  for (int i = 0; i < 300'000; ++i) {
    const double a = draw.tiny(-200, 200), b = draw.tiny(-200, 200), p = a * b;
    const double error = SplitProduct::product_error(a, b, p);
    REQUIRE(error == HardwareFma::product_error(a, b, p));
    REQUIRE(Real(p) + Real(error) == Real(a) * Real(b));
    const double k = std::floor(std::fabs(a) / std::fabs(b));
    if (k >= 1 && k < 0x1p53) {
      const double rest = SplitProduct::remainder(std::fabs(a), k, std::fabs(b));
      REQUIRE(rest == HardwareFma::remainder(std::fabs(a), k, std::fabs(b)));
      REQUIRE(Real(rest) == abs(Real(a)) - Real(k) * abs(Real(b)));
    }
  }
}

TEST_CASE("Double-double operations keep their bounds", "[engines][double_double]") {
  CHECK(worst([](auto a, auto b) { return a + b; }, [](Real a, Real b) { return Real(a + b); }) <= 3.01);
  CHECK(worst([](auto a, auto b) { return a * b; }, [](Real a, Real b) { return Real(a * b); }) <= 5);
  CHECK(worst([](auto a, auto b) { return a / b; }, [](Real a, Real b) { return Real(a / b); }) <= 15.01);
  CHECK(worst([](auto a, auto b) { return a * b.hi + decltype(a)(b.lo) * 0.0; },
              [](Real a, Real b) { return Real(a * Real(static_cast<double>(b))); }) <= 6.1);
  CHECK(worst([](auto a, auto) { return sqrt(a.hi < 0 ? -a : a); },
              [](Real a, Real) { return Real(sqrt(abs(a))); }) <= 3.126);
}

TEST_CASE("Sums and products of binary64 are exact as double-doubles", "[engines][double_double]") {
  Draw draw(13);
  for (int i = 0; i < 100'000; ++i) {
    const double a = draw.tiny(-60, 60), b = draw.tiny(-60, 60);
    REQUIRE(exact(Wide::sum(a, b)) == Real(a) + Real(b));
    REQUIRE(exact(Wide::product(a, b)) == Real(a) * Real(b));
  }
}
