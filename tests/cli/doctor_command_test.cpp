// lorentz doctor: this machine is fit, and one with broken arithmetic is not.
#include <catch2/catch.hpp>
#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <lorentz/environment.hpp>
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// The names of what is not as it should be.
std::vector<std::string> broken() {
  std::vector<std::string> names;
  for (const ArithmeticCheck& check : arithmetic_checks())
    if (!check.fit) names.push_back(check.name + ": " + check.found);
  return names;
}

}  // namespace

TEST_CASE("lorentz doctor finds this machine fit, and says what it looked at", "[cli][doctor]") {
  const auto [status, out, err] = Folder().lorentz("doctor --json");
  INFO(out << err);
  CHECK(status == 0);
  CHECK(contains(out, R"({"fit":true,)"));
  CHECK(contains(out, R"("not_fit_for":[])"));
  CHECK(contains(out, R"({"name":"digests of seeded flights","fit":true,"found":"all 98 as known"})"));
  CHECK(contains(out, R"("name":"problem 2 of the 100-digit challenge","fit":true)"));
  for (const char* library : {"GMP", "Arb", "CGAL", "Highway", "SQLite", "simdjson"})
    CHECK(contains(out, std::string("\"") + library + ' '));
}

TEST_CASE("lorentz doctor needs no large stack", "[cli][doctor]") {
#ifdef __SANITIZE_ADDRESS__
  const char* kilobytes = "1024";  // its frames are wide
#else
  const char* kilobytes = "128";
#endif
  const std::string command =
      "ulimit -s " + std::string(kilobytes) + "; " + LORENTZ_PROGRAM + " doctor >/dev/null";
  CHECK(std::system(command.c_str()) == 0);
}

TEST_CASE("lorentz doctor calls a machine that rounds otherwise not fit, and says for what",
          "[cli][doctor]") {
  const auto [status, out, err] = Folder().lorentz("doctor --pretend-rounding toward-zero");
  INFO(out << err);
  CHECK(status == 1);
  CHECK(contains(out, "rounding mode                          toward zero; it should be: to nearest"));
  CHECK(contains(out, " of 98 differ, first of them: discs reduction"));
  CHECK(contains(out, "\nNOT FIT for the binary64 engines, paths and starts; "));
}

TEST_CASE("Broken arithmetic is seen, and named", "[cli][doctor]") {
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
