// nearly-parallel: velocities so nearly parallel to a lattice vector w that double-double cannot tell the
// difference.
//
// Two vectors of the lattice are full binary64, and in their sum w = (w_0, w_1) the second components cancel
// down to 2^-23. In suitable units w = (W_0, W_1) has about 53 and 30 bits, and v = (V_0, V_1) likewise. For
// any small j Bezout's identity gives a v with v x w = V_0 W_1 - V_1 W_0 = j. That is j 2^-127, but the
// heights v x b of the two vectors are about 1 and keep 2^-107 in double-double. An engine that adds these
// finds zero, and thus a period that does not exist: the flight in the corridor along w ends, after about
// 2^100 cells, and `never` is wrong.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// A v with V_0 W_1 2^22 - V_1 W_0 = j (in binary32 2^10) times their common divisor g. V_0 is not 0:
// u_0 K / g is 1 modulo W_0 / g, so that W_0 / g would divide j; but W_0 is odd, g at most W_1 < 2^30, and
// W_0 / g > 2^22 > j.
Vec nearly_parallel_to(std::int64_t W0, std::int64_t W1, std::int64_t j, NumberFormat precision) {
  const int bits = bits_of(precision), shift = precision == NumberFormat::binary64 ? 22 : 10;
  const std::int64_t K = W1 << shift;
  const IntVec u = bezout({K, W0, 0});
  const Wide V0 = (static_cast<Wide>(j) * u[0] % W0 + W0) % W0;
  const Wide V1 = (V0 * K - static_cast<Wide>(j) * content_of({K, W0, 0})) / W0;
  return {std::ldexp(static_cast<double>(V0), 1 - bits),
          std::ldexp(static_cast<double>(V1), -1 - bits - shift), 0};
}

void make_nearly_parallel(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const bool is_wide = source.is_wide();
  const int bits = bits_of(source.precision), few = is_wide ? 29 : 12;
  const std::int64_t unit = std::int64_t{1} << (bits - 2);
  const std::int64_t X0 = unit + drawn.integer(0, unit / 8), X1 = (unit + drawn.integer(0, unit / 8)) | 1;
  const std::int64_t W0 = X0 + X1 + (X0 % 2 == 0 ? 0 : 1), W1 = drawn.integer(1 << few, (2 << few) - 1) | 1;
  const std::int64_t Y = drawn.integer(3 * unit, 4 * unit - 1);
  const Vec b0{std::ldexp(static_cast<double>(W0 - X1), 2 - bits), std::ldexp(static_cast<double>(Y), -bits),
               0},
      b1{std::ldexp(static_cast<double>(X1), 2 - bits), std::ldexp(static_cast<double>(W1 - Y), -bits), 0};
  const int dimension = drawn.one_in(3) ? 3 : 2;
  const Symmetry symmetry(drawn, dimension);
  const Vec b2 = dimension == 3 ? Vec{0, 0, drawn.between(1, 2)} : Vec{};
  const double r = drawn.octave(-8, -2);
  made.scene = lattice_scene(dimension, {symmetry(b0), symmetry(b1), symmetry(b2)}, r);
  const bool exactly = tagged(made.tags, random.one_in(8), "parallel", "nearly");
  const std::int64_t j = random.integer(1, std::int64_t{1} << random.integer(0, is_wide ? 21 : 9));
  const Vec w = sum(b0, b1), v = exactly ? w : nearly_parallel_to(W0, W1, j, source.precision);
  // The start is in the middle between two rows along w; in space it is near their plane, or no plane is met.
  const double along = random.between(-1, 1), middle = 0.5 + random.between(-0.05, 0.05);
  const Vec x = sum(scaled(b0, middle), scaled(w, along));
  made.query = symmetry(Query{sum(x, Vec{0, 0, dimension == 3 ? r * random.between(-0.9, 0.9) : 0}), v, {}});
}

}  // namespace

Family nearly_parallel() {
  return {"nearly-parallel",
          "Parallel to a lattice vector but for less than double-double can tell, in a corridor.",
          {{"nearly", "v x w is 2^-127 to 2^-106: the flight ends, about 2^100 cells on"},
           {"parallel", "v is w: the flight never ends"}},
          make_nearly_parallel};
}

}  // namespace lorentz::cases
