// The limit law against quadrature of its density, which is written out here once more, in 50 digits.
#include "statistics/theory/laws.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using namespace lorentz::flights;

namespace {

using Fine = boost::multiprecision::cpp_bin_float_50;

// (1 - x)^2 ln|1 - x|
Fine part(const Fine& x) {
  if (x == 1) return 0;
  return (1 - x) * (1 - x) * log(abs(1 - x));
}

Fine g(const Fine& s) {
  if (s <= 1) return 1;
  const Fine x = 1 / s;
  return x + 2 * part(x) - part(2 * x) / 2;
}

// The integral of (u - s)^power g(u) from s to infinity. Far out u is 1/x; beyond x = 1e-5, where g has lost
// 10 of its digits, g is taken to be its first two terms.
Fine integral(const Fine& s, int power) {
  static boost::math::quadrature::tanh_sinh<Fine> quadrature(12);
  const Fine precision = 1e-22;
  Fine sum = 0, from = s;
  for (const int to : {1, 2, 4}) {
    if (from >= to) continue;
    sum += quadrature.integrate([&](const Fine& u) -> Fine { return power ? (u - s) * g(u) : g(u); }, from,
                                Fine(to), precision);
    from = to;
  }
  const Fine near = Fine(1) / 100000 / from;
  sum += quadrature.integrate(
      [&](const Fine& x) -> Fine {
        const Fine u = 1 / x;
        return (power ? (u - s) * g(u) : g(u)) * u * u;
      },
      near, 1 / from, precision);
  // g = 2/3 u^-3 + 1/2 u^-4 + 7/15 u^-5 + ..
  const Fine x = near;
  const Fine zeroth = x * x / 3 + x * x * x / 6 + 7 * x * x * x * x / 60,
             first = 2 * x / 3 + x * x / 4 + 7 * x * x * x / 45;
  return sum + (power ? first - s * zeroth : zeroth);
}

double relative(double value, const Fine& exact) {
  return std::fabs(static_cast<double>((value - exact) / exact));
}

const Fine kPi2 = boost::math::constants::pi<Fine>() * boost::math::constants::pi<Fine>();

const std::vector<double> kPlaces{
    0x1p-40,   0.1,   0.5,  0.999999,  1,   1 + 1e-12, 1 + 1e-6, 1.2, 1.5, 1.9, 2 - 1e-9, 2,
    2 + 1e-12, 2.001, 2.25, 2.4999999, 2.5, 2.500001,  3,        7.5, 20,  1e3, 1e6};

}  // namespace

TEST_CASE("Limit law: g has the integrals of a law of mean 1", "[flights][limit_law]") {
  CHECK(relative(1, integral(0, 0) * 6 / kPi2) < 1e-18);
  CHECK(relative(1, integral(0, 1) * 6 / kPi2) < 1e-15);
}

TEST_CASE("Limit law: survivals by quadrature", "[flights][limit_law]") {
  for (const double s : kPlaces) {
    INFO("s = " << s);
    const double surface = relative(limit_survival_from_surface(s), 6 / kPi2 * integral(s, 0)),
                 uniform = relative(limit_survival_from_uniform(s), 6 / kPi2 * integral(s, 1));
    CHECK(surface < 1e-12);
    CHECK(uniform < 1e-12);
  }
}

TEST_CASE("Limit law: far out, and before the start", "[flights][limit_law]") {
  const double pi2 = std::numbers::pi * std::numbers::pi;
  for (const double s : {1e10, 1e50, 1e90}) {
    INFO("s = " << s);
    CHECK(s * s * limit_survival_from_surface(s) == Approx(2 / pi2).epsilon(1e-9));
    CHECK(s * limit_survival_from_uniform(s) == Approx(2 / pi2).epsilon(1e-9));
  }
  CHECK(1e300 * limit_survival_from_uniform(1e300) == Approx(2 / pi2));
  CHECK(limit_survival_from_uniform(1e308) > 0);
  for (const double s : {0.0, -1.0, -1e300}) {
    CHECK(limit_survival_from_uniform(s) == 1);
    CHECK(limit_survival_from_surface(s) == 1);
  }
}

TEST_CASE("Limit law: no step where formulas change", "[flights][limit_law]") {
  for (const double s : {1.0, 2.0, 2.5})
    for (const auto& law : {limit_survival_from_surface, limit_survival_from_uniform}) {
      INFO("s = " << s);
      const double before = law(std::nextafter(s, 0)), after = law(std::nextafter(s, 9));
      CHECK(std::fabs(after - before) < 1e-12 * before);
    }
}

// The table of docs/free_paths.md, `| s | .. |` with Phi and G in the rows beneath.
TEST_CASE("Limit law: the table in the document", "[flights][limit_law]") {
  std::ifstream in(LORENTZ_SOURCE_DIR "/docs/free_paths.md");
  std::vector<double> places;
  std::size_t checked = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string name, number;
    std::getline(cells, name, '|');
    std::getline(cells, name, '|');
    const bool header = name == " s ", phi = name == " Φ(s) ", survival = name == " G(s) ";
    for (std::size_t i = 0; (header || phi || survival) && std::getline(cells, number, '|'); ++i) {
      if (header) {
        places.push_back(std::stod(number));
        continue;
      }
      REQUIRE(i < places.size());
      const double law =
          phi ? limit_survival_from_uniform(places[i]) : limit_survival_from_surface(places[i]);
      INFO(name << places[i]);
      CHECK(std::fabs(std::stod(number) - law) < 0.5000001e-6);
      ++checked;
    }
  }
  CHECK(checked == 24);
}
