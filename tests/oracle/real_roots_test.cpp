// Real roots of integer polynomials: isolated, compared, rounded.
#include "oracle/horizon/real_roots.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lorentz::oracle;

namespace {

std::vector<double> rounded_roots(const Polynomial& p) {
  std::vector<double> roots;
  for (const RealRoot& root : real_roots(p)) roots.push_back(round_to_binary64(root));
  return roots;
}

}  // namespace

TEST_CASE("Real roots: as many as there are, in ascending order, correctly rounded", "[oracle][horizon]") {
  using Roots = std::vector<double>;
  CHECK(rounded_roots({}).empty());
  CHECK(rounded_roots({0, 0}).empty());
  CHECK(rounded_roots({7}).empty());
  CHECK(rounded_roots({1, 0, 1}).empty());
  CHECK(rounded_roots({-2, 0, 1}) == Roots{-std::sqrt(2), std::sqrt(2)});
  CHECK(rounded_roots({0, 1, 0, 0}) == Roots{0});
  CHECK(rounded_roots({4, 0, -4, 0, 1}) == Roots{-std::sqrt(2), std::sqrt(2)});  // (x^2 - 2)^2
  CHECK(rounded_roots({0, -2, 3}) == Roots{0, 2.0 / 3});
  CHECK(rounded_roots({-6, 11, -6, 1}) == Roots{1, 2, 3});
  CHECK(rounded_roots({6, -5, -5, 5, -1}).size() == 4);  // -1 and these
  // A tie goes to the even number; a root just beside it is not a tie.
  const Z tie = power(2, 53) + 1;
  CHECK(rounded_roots({-tie, 1}) == Roots{0x1p53});
  CHECK(rounded_roots({-tie - 2, 1}) == Roots{0x1p53 + 4});
  CHECK(rounded_roots({-3 * tie - 1, 3}) == Roots{0x1p53 + 2});
  // Roots 2^-200 apart.
  const Z fine = power(2, 200);
  const Polynomial near{fine * (fine + 1), -(2 * fine + 1), 1};
  CHECK(rounded_roots(near) == Roots{0x1p200, 0x1p200});
  CHECK(rounded_roots({1, -(2 * fine + 1), fine * (fine + 1)}).size() == 2);
}

TEST_CASE("Real roots: equal ones of different polynomials are equal, others are told apart",
          "[oracle][horizon]") {
  RealRoot root = real_roots({-2, 0, 1})[1], same = real_roots({6, -2, -3, 1})[1];  // (x^2 - 2)(x - 3)
  CHECK(compare(root, same) == 0);
  CHECK(compare(root, root) == 0);
  // 2 + 2^-300 below the root.
  const Z one = power(2, 300);
  RealRoot above = real_roots({-2 * one - 1, 0, one})[1];
  CHECK(compare(root, above) < 0);
  CHECK(compare(above, root) > 0);
  RealRoot three = real_roots({-3, 1})[0], half = real_roots({-6, 2})[0];
  CHECK(compare(three, half) == 0);
  CHECK(compare(three, root) > 0);
  // A common root elsewhere: (x - 5)(2^300 x - 1), (x - 5)(2^300 x - 2).
  RealRoot small = real_roots({5, -5 * one - 1, one})[0], twice = real_roots({10, -5 * one - 2, one})[0];
  CHECK(compare(small, twice) < 0);
}
