// A program that is compiled with -ffast-math and without inlining, and uses the public headers' arithmetic:
// of every inline function that is not always inlined it brings a copy of its own, and the linker may take
// that for the library's. The library's answers must be the same all the same.
#include <bit>
#include <cstdint>
#include <cstdio>

#include <lorentz/collision.hpp>
#include <lorentz/environment.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/reduction.hpp>

using namespace lorentz;

int main() {
  volatile double one = 1;
  const Vec a{one, 2 * one, 3 * one}, b{one, one / 3, one / 7};
  const std::array<Vec, 3> dual = dual_of({a, b, cross(a, b)}, 3);
  const double own =
      dot(sum(scaled(a, 2), b), coordinates(dual, a)) + length(b) + *entry_time({-3, 0, 0}, {1, 0, 0}, 1);

  const Scene ellipsoids{3,
                         {{{{{1, 0, 0}, {0.25, 1, 0}, {-0.125, 0.25, 1.125}}},
                           {{{}, 0, {{0.2, 0.2, -0.1}, {-0.07, 0.14, 0.14}, {0.1, -0.05, 0.1}}}}}}};
  const Reduction engine(ellipsoids);
  std::uint64_t numbers = 0;
  for (int i = 1; i <= 1000; ++i) {
    const Query query{{0.5, 0.5, 0.5}, {one, i * 0x1p-10, (1001 - i) * 0x1p-11}, {}};
    const Answer answer = engine.first_hit(query);
    const Vec normal = collision_detail(ellipsoids, query, answer).normal;
    for (const double number : {*answer.time, normal[0], normal[1], normal[2]})
      numbers = numbers * 3 + std::bit_cast<std::uint64_t>(number);
  }
  std::printf("own %.3g, numbers %llx\n", own, static_cast<unsigned long long>(numbers));
  for (const ArithmeticCheck& check : arithmetic_checks())
    if (!check.fit) std::printf("%s: %s\n", check.name.c_str(), check.found.c_str());
}
