// Drawn queries: uniform in the free part of a cell, with isotropic directions.
#pragma once

#include <cstdint>
#include <vector>

#include "oracle.hpp"
#include "problem.hpp"

namespace lorentz::cli {

inline constexpr std::uint64_t kDefaultSeed = 20161115;

/// Random numbers that depend on (seed, index) only (SplitMix64 started at a mix of both), so that a query is
/// the same whoever draws it, and in whatever order. The same bits on every machine: nothing but integer
/// arithmetic, exact conversions and square roots is used.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index);
  std::uint64_t bits();
  double uniform();              ///< [0, 1), a multiple of 2^-53
  Vec direction(int dimension);  ///< isotropic, of unit length up to rounding

 private:
  std::uint64_t state_;
};

/// `count` queries; of a superposition, in a box of 1000 cells of the first lattice. Throws InputError if the
/// obstacles leave no free part to be found.
std::vector<Query> draw_queries(const Scene& scene, const oracle::Oracle& oracle, std::uint64_t seed,
                                std::size_t count);

/// `count` flights of a particle that leaves the ball at the origin of a unit scene: uniform on its surface,
/// directions by the cosine law (which is the flux of a gas in equilibrium), `from` that ball.
std::vector<Query> draw_leaving_queries(int dimension, double radius, std::uint64_t seed, std::size_t count);

}  // namespace lorentz::cli
