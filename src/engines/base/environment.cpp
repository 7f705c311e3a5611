#include <lorentz/environment.hpp>

#include <bit>
#include <cfloat>
#include <cstdint>

#include <lorentz/vec.hpp>

namespace lorentz {

// Rotates a vector. GCC's vectorizer turns such pairs of a difference and a sum into fused operations,
// whatever -ffp-contract says. (Not in an unnamed namespace: there the compiler would see the arguments, and
// would not vectorize.)
namespace environment {
[[gnu::noinline]] Vec turned(double cosine, double sine, const Vec& a) {
  return {cosine * a[0] - sine * a[1], cosine * a[1] + sine * a[0], 0};
}
}  // namespace environment

namespace {

// Values that only the running program may know, so that the compiler computes nothing in advance, nor in
// another mode than the one that is set.
using Number = volatile double;

// Tells the mode from the results of sums, because the setting itself is not what counts. Rounded to nearest,
// 1 + 2^-54 and the like give 1.
std::string rounding_found() {
  Number one = 1, little = 0x1p-54;
  const double above = one + little, minus_above = -one - little, below = one - little / 2;
  if (above > 1) return "upward";
  if (minus_above < -1) return "downward";
  if (below < 1) return "toward zero";
  return "to nearest";
}

ArithmeticCheck rounding() {
  const std::string found = rounding_found();
  return {"rounding mode", found == "to nearest", found, "to nearest"};
}

ArithmeticCheck subnormal_results() {
  Number smallest_normal = 0x1p-1022, half = 0.5;
  const double product = smallest_normal * half;
  const bool kept = std::bit_cast<std::uint64_t>(product) != 0;  // a comparison might itself take it for zero
  return {"subnormal results", kept, kept ? "kept" : "flushed to zero", "kept"};
}

ArithmeticCheck subnormal_operands() {
  Number subnormal = 0x1p-1040, large = 0x1p100;
  const double product = subnormal * large;
  const bool kept = product == 0x1p-940;
  return {"subnormal operands", kept, kept ? "kept" : "taken for zero", "kept"};
}

// Compares a sum with the same sum rounded on its way through memory. In a wider register the first keeps
// more digits.
ArithmeticCheck excess_precision() {
  Number large = 0x1p53, one = 1, sum = large + one;
  const bool none = (large + one) - large == sum - large && FLT_EVAL_METHOD == 0;
  return {"precision", none, none ? "binary64" : "wider than binary64", "binary64"};
}

// (1 + 2^-27) (1 - 2^-27) = 1 - 2^-54 has to be rounded before anything is added.
ArithmeticCheck contraction() {
  Number x = 1 + 0x1p-27, y = 1 - 0x1p-27, one = 1, rounded = x * y;
  const Vec turned = environment::turned(y, y, {x, x, 0});
  const bool none = x * y - one == rounded - one && turned[0] == 0;
  return {"a * b + c", none, none ? "two roundings" : "fused", "two roundings"};
}

}  // namespace

std::vector<ArithmeticCheck> arithmetic_checks() {
  return {rounding(), subnormal_results(), subnormal_operands(), excess_precision(), contraction()};
}

}  // namespace lorentz
