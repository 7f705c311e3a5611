// Random numbers that are the same on every machine, in whatever order they are drawn.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <lorentz/vec.hpp>

namespace lorentz::cases {

/// The uses of random numbers. Each has numbers of its own, however many the others take.
enum class Use : std::uint64_t { cases, scenes, variants, rewordings, reworded_scenes };

/// The name of a series of random numbers, hashed once (FNV-1a), for callers that draw from it 10^8 times.
struct Series {
  explicit constexpr Series(std::string_view name) {
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  std::uint64_t hash = 0xcbf29ce484222325;
};

/// Random numbers by Philox4x64-10, a bijection of 256-bit counters under a 128-bit key (Salmon, Moraes,
/// Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", 2011; here Random123's). The key is
/// (seed, FNV-1a of the name), the counter (index, use, block, attempt). The numbers depend on these only, so
/// a query is the same in whatever program, order or thread, and on whatever machine, it is drawn. A block is
/// four words. The only operations are integer arithmetic, exact conversions, single roundings and square
/// roots.
class Random {
 public:
  Random(std::uint64_t seed, Series series, std::uint64_t index, Use use = Use::cases,
         std::uint64_t attempt = 0)
      : key_{seed, series.hash}, counter_{index, static_cast<std::uint64_t>(use), 0, attempt} {}
  Random(std::uint64_t seed, std::string_view name, std::uint64_t index, Use use = Use::cases)
      : Random(seed, Series(name), index, use) {}

  std::uint64_t bits() {
    if (taken_ == block_.size()) next_block();
    return block_[taken_++];
  }
  double uniform() { return share_of(bits()); }  ///< [0, 1), a multiple of 2^-53
  static double share_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }
  Vec direction(int dimension);              ///< isotropic, of unit length up to rounding
  Vec vector(int dimension, double length);  ///< isotropic, of this length

  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  std::int64_t integer(std::int64_t low, std::int64_t high);  ///< low to high, both included
  // The same as an int and as a binary64; and one of the axes.
  int exponent(std::int64_t low, std::int64_t high) { return static_cast<int>(integer(low, high)); }
  double whole(std::int64_t low, std::int64_t high) { return static_cast<double>(integer(low, high)); }
  int axis(int dimension) { return static_cast<int>(below(static_cast<std::uint64_t>(dimension))); }
  double between(double low, double high);
  double sign();                     ///< +1 or -1
  double octave(int low, int high);  ///< 2^k (1 + u), k from low to high - 1: about log-uniform, above 0

 private:
  void next_block();

  std::array<std::uint64_t, 2> key_;
  std::array<std::uint64_t, 4> counter_, block_{};
  std::size_t taken_ = 4;  ///< words of the block that are used up
};

}  // namespace lorentz::cases
