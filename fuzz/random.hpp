// Random numbers that are the same whoever draws them, and on every machine.
#pragma once

#include <cstdint>
#include <string_view>

#include "problem.hpp"

namespace lorentz::fuzz {

/// Random numbers that depend on (seed, index) only (SplitMix64 started at a mix of both), so that a query is
/// the same whoever draws it, and in whatever order. The same bits on every machine: nothing but integer
/// arithmetic, exact conversions, single roundings and square roots is used.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index);
  std::uint64_t bits();
  double uniform();              ///< [0, 1), a multiple of 2^-53
  Vec direction(int dimension);  ///< isotropic, of unit length up to rounding

  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  std::int64_t integer(std::int64_t low, std::int64_t high);  ///< low to high, both included
  double between(double low, double high);
  double sign();                     ///< +1 or -1
  double octave(int low, int high);  ///< 2^k (1 + u), k from low to high - 1: about log-uniform, above 0

 private:
  std::uint64_t state_;
};

/// The seed of a stream of its own for a name.
std::uint64_t seed_for(std::uint64_t seed, std::string_view name);

}  // namespace lorentz::fuzz
