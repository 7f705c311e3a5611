#include <lorentz/continued_fraction.hpp>

#include <boost/multiprecision/gmp.hpp>
#include <catch2/catch.hpp>

#include "tests/support/support.hpp"

using namespace lorentz;
using Quotient = boost::multiprecision::mpq_rational;
using Whole = boost::multiprecision::mpz_int;

namespace {

std::vector<std::string> quotients(double rise, double run) {
  std::vector<std::string> a;
  for (const auto& c : oracle::convergents(rise, run, 10000)) a.push_back(c.a.decimal());
  return a;
}

using Strings = std::vector<std::string>;

}  // namespace

TEST_CASE("Continued fractions known by heart", "[oracle][continued_fraction]") {
  CHECK(quotients(3, 2) == Strings{"1", "2"});
  CHECK(quotients(2, 3) == Strings{"0", "1", "2"});
  CHECK(quotients(-3, 2) == Strings{"-2", "2"});
  CHECK(quotients(3, -2) == Strings{"-2", "2"});
  CHECK(quotients(0, 1) == Strings{"0"});
  CHECK(quotients(7, 1) == Strings{"7"});
  CHECK(quotients(1, 0x1p70) == Strings{"0", "1180591620717411303424"});
  const auto pi = oracle::convergents(3.141592653589793, 1, 100);
  CHECK(pi[0].a == Integer(3));
  CHECK(pi[1].a == Integer(7));
  CHECK(pi[2].a == Integer(15));
  CHECK(pi[3].a == Integer(1));
  CHECK(pi[4].a == Integer(292));
  CHECK(pi[3].p == Integer(355));
  CHECK(pi[3].q == Integer(113));
  CHECK(pi.back().remainder == 0);
  CHECK(pi.back().remainder_exact == "0");
}

TEST_CASE("Convergents satisfy their identities, exactly", "[oracle][continued_fraction]") {
  {
    test::Draw draw(91);
    INFO("seed 91");
    for (int i = 0; i < 300; ++i) {
      const double rise = draw.tiny(-60, 60), run = draw.tiny(-60, 60);
      const Quotient m = Quotient(rise) / Quotient(run);
      const auto all = oracle::convergents(rise, run, 10000);
      Whole p_before = 1, q_before = 0;
      for (std::size_t n = 0; n < all.size(); ++n) {
        const Whole p(all[n].p.decimal()), q(all[n].q.decimal());
        INFO(rise << " / " << run << " at " << n);
        // p q' - p' q = +-1, alternating; the remainder q m - p changes sign and shrinks.
        REQUIRE(p * q_before - p_before * q == (n % 2 == 0 ? -1 : 1));
        const Quotient remainder = Quotient(q) * m - Quotient(p);
        REQUIRE(Quotient(all[n].remainder_exact) == remainder);
        REQUIRE(all[n].remainder == Approx(remainder.convert_to<double>()).epsilon(1e-15));
        if (n + 1 < all.size()) REQUIRE((n % 2 == 0 ? remainder > 0 : remainder < 0));
        p_before = p, q_before = q;
      }
      REQUIRE(Quotient(p_before) / Quotient(q_before) == m);
    }
  }
}

TEST_CASE("The number of terms can be limited", "[oracle][continued_fraction]") {
  CHECK(oracle::convergents(0.1, 1, 3).size() == 3);
}
