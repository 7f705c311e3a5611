// Kernels that draw starts, fly them and count, each thread one flight after the other. Compiled by clang for
// graphics cards, each kind of scene (LORENTZ_KIND) by itself, and for the processor, where tests run them.
#include "src/engines/gpu/device.hpp"

#if !defined(LORENTZ_EMULATED_DEVICE)
#pragma clang force_cuda_host_device begin
#endif
#include "src/engines/gpu/flight.hpp"
#include "statistics/gpu/drawn.hpp"
#include "statistics/gpu/natural_log.hpp"

namespace lorentz::gpu {

LORENTZ_EACH std::array<double, 2> quarter_turn(std::uint64_t bits) {
  const bool odd = bits & 1, beyond = bits & 2;
  return {odd ? 0.0 : beyond ? -1.0 : 1.0, odd ? beyond ? -1.0 : 1.0 : 0.0};
}

#include "question/starts/direction-inl.hpp"

// The words of one start, as cases::Random has them: Philox4x64-10, two blocks. No word is indexed at run
// time, so that all stay in registers.
class Words {
 public:
  LORENTZ_EACH Words(const DrawnFlights& flights, std::uint64_t index, std::uint64_t attempt, bool two) {
    make_block(flights, index, attempt, 0, &words_[0]);
    if (two) make_block(flights, index, attempt, 1, &words_[4]);
  }

  LORENTZ_EACH std::uint64_t bits() {
    const std::uint64_t next = words_[0];
    for (int i = 0; i < 7; ++i) words_[i] = words_[i + 1];
    return next;
  }
  LORENTZ_EACH double uniform() { return share_of(bits()); }
  static LORENTZ_EACH double share_of(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
  }

 private:
  static LORENTZ_EACH void make_block(const DrawnFlights& flights, std::uint64_t index, std::uint64_t attempt,
                                      std::uint64_t block, std::uint64_t* c) {
    __extension__ using Product = unsigned __int128;
    std::uint64_t k0 = flights.seed, k1 = flights.series;
    c[0] = index, c[1] = 0, c[2] = block, c[3] = attempt;
#pragma GCC unroll 10
    for (int round = 0; round < 10; ++round) {
      const Product a = static_cast<Product>(0xD2E7470EE14C6C93) * c[0],
                    b = static_cast<Product>(0xCA5A826395121157) * c[2];
      c[0] = static_cast<std::uint64_t>(b >> 64) ^ c[1] ^ k0, c[1] = static_cast<std::uint64_t>(b);
      c[2] = static_cast<std::uint64_t>(a >> 64) ^ c[3] ^ k1, c[3] = static_cast<std::uint64_t>(a);
      k0 += 0x9E3779B97F4A7C15, k1 += 0xBB67AE8584CAA73B;
    }
  }

  std::uint64_t words_[8];
};

template <int D>
LORENTZ_EACH void draw(const DrawnFlights& flights, std::uint64_t index, std::uint64_t attempt,
                       double (&x)[D], double (&v)[D]) {
  Words words(flights, index, attempt, D == 3);
  for (int k = 0; k < D; ++k) x[k] = flights.corner[k];
  for (int i = 0; i < D; ++i) {
    const double share = flights.cells[i] * words.uniform();
    for (int k = 0; k < D; ++k) x[k] += share * flights.vectors[i][k];
  }
  const auto drawn = direction(words, D);
  for (int k = 0; k < D; ++k) v[k] = drawn[k];
}

// A sum like flights::ExactSum. Each thread adds to 128 bits of its own around 2^middle; what does not fit is
// added to the digits of all.
class Sum {
  __extension__ using Bits = unsigned __int128;
  static constexpr int kRoom = 40;  // 53 bits shifted by up to 40, and 2^31 of them

 public:
  LORENTZ_EACH Sum(DigitSums& all, int middle) : all_(all), lowest_(middle - 52 - kRoom / 2), sum_(0) {}

  LORENTZ_EACH void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1075, shift = exponent - lowest_;
    const std::uint64_t integer = (bits & 0xfffffffffffff) | 0x10000000000000;
    if (shift >= 0 && shift <= kRoom) {
      const Bits summand = static_cast<Bits>(integer) << shift;
      sum_ += bits >> 63 ? -summand : summand;
    } else if (x != 0) {
      add_digits(bits >> 63 ? -static_cast<Bits>(integer) : static_cast<Bits>(integer), exponent,
                 [](std::uint64_t* to, std::uint64_t n) { device::add(to, n); });
    }
  }

  // To be called by all threads of a warp.
  LORENTZ_EACH void finish() {
    add_digits(sum_, lowest_, [](std::uint64_t* to, std::uint64_t n) { device::add_of_warp(to, n); });
  }

 private:
  // Adds a signed integer in units of 2^exponent, a normal number's: 32 bits to each digit, the sign to the
  // last.
  template <class Add>
  LORENTZ_EACH void add_digits(Bits n, int exponent, const Add& add) {
    const int place = exponent - DigitSums::kLowest, digit = place / 32;
    const bool negative = n >> 127 != 0;
    const Bits size = negative ? -n : n;
    const Bits low = static_cast<Bits>(static_cast<std::uint64_t>(size)) << place % 32,
               high = static_cast<Bits>(static_cast<std::uint64_t>(size >> 64)) << place % 32;
    const std::uint64_t parts[5] = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32),
                                    static_cast<std::uint64_t>(low >> 64) + static_cast<std::uint32_t>(high),
                                    static_cast<std::uint32_t>(high >> 32),
                                    static_cast<std::uint64_t>(high >> 64)};
    for (int i = 0; i < 5; ++i)
      if (digit + i < DigitSums::kDigits) add(&all_.digits[digit + i], negative ? -parts[i] : parts[i]);
  }

  DigitSums& all_;
  int lowest_;
  Bits sum_;
};

// FlightTally::count_hit.
class HitCounts {
 public:
  LORENTZ_EACH HitCounts(DrawnTally& tally, int exponent)
      : tally_(tally),
        time_(tally.time, exponent),
        square_(tally.square, 2 * exponent),
        log_(tally.log, 0),
        logarithmic_(tally.logarithmic),
        linear_(tally.linear),
        first_bin_(static_cast<std::int64_t>(1023 + exponent - 40) << 3),
        per_bin_(std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 4 - exponent) << 52)) {}

  LORENTZ_EACH void count(double t) {
    ++hits_;
    time_.add(t);
    square_.add(t * t);
    if (t > 0)
      log_.add(natural_log(t));
    else
      ++zeros_;
    const auto bits = std::bit_cast<std::uint64_t>(t);
    longest_ = longest_ < bits ? bits : longest_, shortest_ = shortest_ < ~bits ? ~bits : shortest_;
    const std::int64_t bin = static_cast<std::int64_t>(bits >> 49) - first_bin_ + 1;
    logarithmic_.count(bin < 0 ? 0 : bin > kLogarithmic - 1 ? kLogarithmic - 1 : static_cast<unsigned>(bin));
    const double i = t * per_bin_;
    linear_.count(i < kLinear - 1 ? static_cast<unsigned>(i) : kLinear - 1);
  }

  LORENTZ_EACH void finish() {
    device::add_of_warp(&tally_.hits, hits_), device::add_of_warp(&tally_.zeros, zeros_);
    device::raise(&tally_.longest, longest_), device::raise(&tally_.shortest, shortest_);
    time_.finish(), square_.finish(), log_.finish();
    logarithmic_.finish(), linear_.finish();
  }

 private:
  DrawnTally& tally_;
  Sum time_, square_, log_;
  device::Counts<kLogarithmic> logarithmic_;
  device::Counts<kLinear> linear_;
  std::int64_t first_bin_;
  double per_bin_;
  std::uint64_t hits_ = 0, zeros_ = 0, longest_ = 0, shortest_ = 0;
};

template <int D, bool kUnit, bool kBall, bool kOneAtom>
LORENTZ_EACH void fly_drawn(const DrawnFlights& flights, DrawnTally& tally, LeftStart* left) {
  constexpr std::uint64_t kMostAttempts = 64;  // more are left to the processor
  const device::Atoms<kOneAtom> atoms{flights.atoms, flights.atom_count, flights.unit, flights.inverse_unit};
  const device::Plain<D, kUnit, kBall> asked;
  HitCounts hits(tally, flights.bins_exponent);
  std::uint64_t never = 0, inside = 0, attempt = 0;
  // A start in an obstacle is drawn again in the next turn, so that the other threads of the warp need not
  // wait.
  for (std::uint64_t i = device::thread(); i < flights.count;) {
    const std::uint64_t index = flights.first + i / kPiece * flights.every * kPiece + i % kPiece;
    double x[D], v[D];
    draw<D>(flights, index, attempt, x, v);
    if (flights.hard) make_hard(x, v, D);
    device::OneFlight<D, kUnit, kBall, kOneAtom> flight(atoms, asked, true, x, v);
    flight.run();
    if (flight.inside && attempt < kMostAttempts) {
      ++inside, ++attempt;
      continue;
    }
    if (flight.found && flight.rounded) {
      hits.count(flight.time);
    } else if (flight.lanes.active && !flight.found) {
      ++never;
    } else {
      const std::uint64_t place = device::add(&tally.left, 1);
      if (place < kMostLeft) left[place] = {index, attempt};
    }
    i += device::threads(), attempt = 0;
  }
  hits.finish();
  device::add_of_warp(&tally.never, never), device::add_of_warp(&tally.inside, inside);
}

}  // namespace lorentz::gpu

#if !defined(LORENTZ_EMULATED_DEVICE)
#pragma clang force_cuda_host_device end
#endif

// Kernels, by name: the dimension, and the scenes. `flights` and `tally` are in the card's memory; behind the
// tally is the list of starts that are left.
#define LORENTZ_KIND(name, ...)                                                                      \
  LORENTZ_KERNEL(name)(const lorentz::gpu::DrawnFlights* flights, lorentz::gpu::DrawnTally* tally) { \
    lorentz::gpu::fly_drawn<__VA_ARGS__>(*flights, *tally,                                           \
                                         reinterpret_cast<lorentz::gpu::LeftStart*>(tally + 1));     \
  }
#ifdef LORENTZ_ONE_KIND
LORENTZ_ONE_KIND
#else
#include "src/engines/gpu/kinds.inc"
#endif
