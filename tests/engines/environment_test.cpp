// arithmetic_checks: this machine computes as the engines need it, and broken arithmetic is seen.
#include <catch2/catch.hpp>
#include <cfenv>
#include <string>
#include <utility>
#include <vector>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <lorentz/environment.hpp>

using namespace lorentz;

namespace {

// The checks that fail, by name, and what they found.
std::vector<std::string> broken() {
  std::vector<std::string> names;
  for (const ArithmeticCheck& check : arithmetic_checks())
    if (!check.fit) names.push_back(check.name + ": " + check.found);
  return names;
}

}  // namespace

TEST_CASE("Broken arithmetic is seen, and named", "[environment]") {
  using Names = std::vector<std::string>;
  CHECK(broken() == Names{});
  for (const auto& [mode, name] :
       {std::pair{FE_UPWARD, "upward"}, {FE_DOWNWARD, "downward"}, {FE_TOWARDZERO, "toward zero"}}) {
    std::fesetround(mode);
    const Names found = broken();
    std::fesetround(FE_TONEAREST);
    CHECK(found == Names{std::string("rounding mode: ") + name});
  }
#if defined(__SSE2__)
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x40;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | kFlushToZero);
  const Names flushed = broken();
  _mm_setcsr(before | kDenormalsAreZero);
  const Names taken = broken();
  _mm_setcsr(before);
  CHECK(flushed == Names{"subnormal results: flushed to zero"});
  CHECK(taken == Names{"subnormal operands: taken for zero"});
#endif
}
