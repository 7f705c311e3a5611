// The logarithm of the counts, held against MPFR's.
#include <catch2/catch.hpp>

#include <mpfr.h>

#include <cmath>
#include <limits>

#include "question/cases/random.hpp"
#include "statistics/gpu/natural_log.hpp"

using lorentz::cases::Random;
using lorentz::gpu::natural_log;

TEST_CASE("Logarithms err by less than 2e-16 (1 + |ln x|), from the smallest number to the largest",
          "[flights]") {
  Random random(20261129, "natural log", 0);
  mpfr_t exact;
  mpfr_init2(exact, 120);
  double worst = 0;
  const auto look = [&](double x) {
    mpfr_set_d(exact, x, MPFR_RNDN);
    mpfr_log(exact, exact, MPFR_RNDN);
    const double size = 1 + std::fabs(mpfr_get_d(exact, MPFR_RNDN));
    mpfr_sub_d(exact, exact, natural_log(x), MPFR_RNDN);
    worst = std::max(worst, std::fabs(mpfr_get_d(exact, MPFR_RNDN)) / size);
  };
  for (int i = 0; i < 100'000; ++i) {
    look(random.octave(-1022, 1024));
    look(random.octave(-40, 60));                      // times of flights
    look(1 + random.octave(-53, -1) * random.sign());  // near 1, where the logarithm is near 0
    look(std::ldexp(std::sqrt(2.0), random.exponent(-60, 60)) * (1 + random.between(-1, 1) * 0x1p-40));
  }
  look(std::numeric_limits<double>::max()), look(std::numeric_limits<double>::min());
  look(std::numeric_limits<double>::denorm_min()), look(0x1p-1030);
  mpfr_clear(exact);
  CHECK(worst < 2e-16);
  CHECK(worst > 5e-17);  // as many digits as there are
  CHECK(natural_log(1) == 0);
}
