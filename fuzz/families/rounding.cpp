// rounding: times that lie midway between two binary64, exactly or nearly.
//
// Along an axis through the centre of a ball the time is rational: (u - r) / v with u the distance of the
// start. Let r be an odd multiple of 2^-55 q in [1/8, 1/4) q, u a multiple of 2^-54 q, u - r in [1/4, 1/2) q,
// whose last place is 2^-54 q, and v a power of two. Then the time is exactly midway, and ties go to even.
// Beside the axis by y it is later by y^2 / 2r, which decides the rounding however small it is. With v near
// 2^1023 the time is subnormal, and has fewer places.
//
// early: times that fall short of midway between two binary64 by less than double-double can tell.
//
// A flight along an axis passes the centre of a ball of radius 5 k at the distance 3 k. It enters the ball
// 4 k before the centre, at the time (u - 4 k) / v, with u the distance along the axis. With k = K 2^-57 and
// K odd, 4 k is an odd multiple of 2^-55. If u is a multiple of 2^-54, v a power of two, and u - 4 k in
// [1/4, 1/2), whose last place is 2^-54, then the time is midway. A flight that is nearer to the centre by d
// is earlier by 3 d / 4, so its time must be rounded down. But a pair of binary64 numbers next to the
// midpoint keeps nothing of a d of 2^-112 or less. The atom, not the start, is 3 k off the axis, because
// 3 k - d is not a binary64. (Times a little late are in `rounding`.)
#include <cmath>

#include "fuzz/families/family.hpp"
#include "question/cases/scenes.hpp"

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

void make_early(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  const bool is_wide = source.is_wide();
  const int grid = bits_of(source.precision) + 2;  // places are whole multiples of 2^-55
  const std::int64_t quarter = std::int64_t{1} << (grid - 2);
  const std::int64_t least = dimension == 2 ? (is_wide ? 20 : 6) : (is_wide ? 36 : 12);
  const std::int64_t K = drawn.integer(1, std::int64_t{1} << drawn.integer(least, grid - 6)) | 1;
  const double k = std::ldexp(static_cast<double>(K), -grid - 2);
  const Symmetry symmetry(drawn, dimension);
  made.scene = unit_scene(dimension, 5 * k);
  made.scene.lattices[0].atoms[0].position = symmetry(Vec{0, 3 * k, 0});
  // u - 4 k from a quarter to a half, u even.
  const std::int64_t u = 2 * random.integer((K + quarter + 1) / 2, (K + 2 * quarter - 1) / 2);
  const bool late = tagged(made.tags, random.one_in(4), "late", "early");
  const double beside = (is_wide ? random.octave(-200, -112) : random.octave(-120, -54)) * (late ? -1 : 1);
  made.query =
      symmetry(Query{Vec{std::ldexp(static_cast<double>(-u), -grid), beside, 0},
                     Vec{std::ldexp(1, random.exponent(is_wide ? -60 : -30, is_wide ? 60 : 30)), 0, 0},
                     {}});
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

Family early() {
  return {"early",
          "Times short of midway between two binary64 by less than double-double can tell.",
          {{"early", "by a relative 2^-200 to 2^-112: to be rounded down"}, {"late", "later by as little"}},
          make_early};
}

}  // namespace lorentz::cases
