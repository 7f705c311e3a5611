// rounding: times that lie midway between two binary64, exactly or nearly.
//
// Along an axis through the centre of a ball the time is rational: (u - r) / v with u the distance of the
// start. Let r be an odd multiple of 2^-55 q in [1/8, 1/4) q, u a multiple of 2^-54 q, u - r in [1/4, 1/2) q,
// whose last place is 2^-54 q, and v a power of two. Then the time is exactly midway, and ties go to even.
// Beside the axis by y it is later by y^2 / 2r, which decides the rounding however small it is. With v near
// 2^1023 the time is subnormal, and has fewer places.
#include <cmath>

#include "cases/families/family_list.hpp"
#include "cases/symmetry.hpp"

namespace lorentz::cases {
namespace {

void make_rounding(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const bool is_wide = source.is_wide();
  // Integers on a grid of 2^-55.
  const int grid = bits_of(source.precision) + 2;
  const std::int64_t eighth = std::int64_t{1} << (grid - 3);
  const int dimension = drawn.one_in(3) ? 3 : 2, smaller = drawn.exponent(0, 12);
  const std::int64_t r = drawn.integer(eighth, 2 * eighth - 9) | 1;
  made.scene = unit_scene(dimension, std::ldexp(static_cast<double>(r), -grid - smaller));
  const std::int64_t u = 2 * random.integer((r + 2 * eighth + 1) / 2, 2 * eighth - 1);
  const Symmetry symmetry(random, dimension);
  Vec x{std::ldexp(static_cast<double>(-u), -grid - smaller), 0, 0};
  if (tagged(made.tags, random.one_in(3), "beside", "midway"))
    x[1] = random.octave(is_wide ? -200 : -120, is_wide ? -24 : -12) * random.sign();
  const bool subnormal = tagged(made.tags, random.one_in(8), "subnormal");
  const int exponent = subnormal ? (is_wide ? random.exponent(1021, 1023) : random.exponent(125, 127))
                                 : (is_wide ? random.exponent(-60, 60) : random.exponent(-30, 30));
  made.query = symmetry(Query{x, Vec{std::ldexp(1, exponent), 0, 0}, {}});
}

}  // namespace

Family rounding() {
  return {"rounding",
          "Times midway between two binary64, exactly or nearly.",
          {{"midway", "exactly: the last bit of the time is a tie"},
           {"beside", "later than that by a relative 2^-400 to 2^-48"},
           {"subnormal", "at speeds near 2^1023: the time is subnormal"}},
          make_rounding};
}

}  // namespace lorentz::cases
