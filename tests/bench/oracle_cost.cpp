// The cost of a first hit in the oracle: by radius (drawn flights) and by distance (a slow drift out of a
// corridor or a planar channel). Medians with quartiles, in microseconds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <lorentz/oracle.hpp>
#include "question/starts/free_starts.hpp"

using namespace lorentz;

namespace {

struct Spread {
  double low, median, high;
};

Spread cost(const oracle::Oracle& oracle, const std::vector<Query>& queries) {
  std::vector<double> microseconds;
  for (const Query& query : queries) {
    const auto start = std::chrono::steady_clock::now();
    const Answer answer = oracle.first_hit(query);
    microseconds.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    if (answer.outcome == Outcome::undecided) throw answer;  // uses the answer; never happens
  }
  std::sort(microseconds.begin(), microseconds.end());
  const auto at = [&](double share) {
    return microseconds[static_cast<std::size_t>(share * static_cast<double>(microseconds.size() - 1))];
  };
  return {at(0.25), at(0.5), at(0.75)};
}

std::string text(const Spread& spread) {
  return fmt::format("{:6.1f} ({:.1f} to {:.1f})", spread.median, spread.low, spread.high);
}

Spread by_radius(int dimension, double r) {
  const Scene scene = unit_scene(dimension, r);
  const oracle::Oracle oracle(scene);
  return cost(oracle, starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed,
                                          dimension == 2 ? 20000 : 4000));
}

// Starts in the middle of a corridor and drifts out of it at 2^-k: a flight of about 2^k / 3.
Spread by_distance(int dimension, int k) {
  const oracle::Oracle oracle(unit_scene(dimension, 0.1));
  Query query{{0, 0.5, 0}, {1, std::ldexp(1, -k), 0}, {}};
  if (dimension == 3) query = {{0, 0, 0.5}, {1, 0.618, std::ldexp(1, -k)}, {}};
  return cost(oracle, std::vector<Query>(200, query));
}

}  // namespace

int main() {
  fmt::print("drawn flights      2D                          3D\n");
  for (const double r : {0.3, 0.1, 1e-2, 1e-3, 1e-4, 1e-6})
    fmt::print("r = {:<8}       {:<26}  {}\n", r, text(by_radius(2, r)), text(by_radius(3, r)));
  fmt::print("\ndrift 2^-k         2D corridor                 3D plane channel\n");
  for (const int k : {4, 10, 20, 40, 60, 100, 300, 1000})
    fmt::print("k = {:<8}       {:<26}  {}\n", k, text(by_distance(2, k)), text(by_distance(3, k)));
}
