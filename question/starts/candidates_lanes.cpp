// Uniform starts in the lanes of the processor's vectors. Each lane does the operations of a single start, one
// by one and in their order, so it gets the same bits. Compiled for each set of instructions (Google Highway).
#include <Random123/philox.h>

#include "question/starts/candidates.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "question/starts/candidates_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lorentz::starts::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
using namespace hwy::HWY_NAMESPACE;

using NumberTag = CappedTag<double, 8>;
using Words = VFromD<RebindToUnsigned<NumberTag>>;

constexpr NumberTag kNumber{};
constexpr RebindToUnsigned<NumberTag> kWord{};
constexpr Repartition<std::uint32_t, NumberTag> kHalf{};  // two halves of a word

// A number in each lane.
struct NumberLanes {
  VFromD<NumberTag> n;

  HWY_INLINE NumberLanes(VFromD<NumberTag> each) : n(each) {}
  HWY_INLINE NumberLanes(double all) : n(Set(kNumber, all)) {}
  friend HWY_INLINE NumberLanes operator+(NumberLanes a, NumberLanes b) { return a.n + b.n; }
  friend HWY_INLINE NumberLanes operator-(NumberLanes a, NumberLanes b) { return a.n - b.n; }
  friend HWY_INLINE NumberLanes operator*(NumberLanes a, NumberLanes b) { return a.n * b.n; }
  friend HWY_INLINE NumberLanes sqrt(NumberLanes a) { return Sqrt(a.n); }
};

// a times b: the high words and the low ones.
HWY_INLINE void multiply(Words a, std::uint64_t b, Words& high, Words& low) {
  const auto times = [](Words x, std::uint64_t y)
                         HWY_ATTR { return MulEven(BitCast(kHalf, x), BitCast(kHalf, Set(kWord, y))); };
  const std::uint64_t kLow = 0xffffffff;
  const Words a_high = ShiftRight<32>(a), lowest = times(a, b & kLow),
              middle = times(a_high, b & kLow) + ShiftRight<32>(lowest),
              other = times(a, b >> 32) + And(middle, Set(kWord, kLow));
  high = times(a_high, b >> 32) + ShiftRight<32>(middle) + ShiftRight<32>(other);
  low = BitCast(kWord, OddEven(BitCast(kHalf, ShiftLeft<32>(other)), BitCast(kHalf, lowest)));
}

constexpr std::size_t kBlocks = 4;

// Philox, from counters to blocks of four words. They are made together, because each waits for its products.
HWY_INLINE void make_blocks(philox4x64_key_t key, Words (&c)[4 * kBlocks]) {
  for (int round = 0; round < philox4x64_rounds; ++round, key = _philox4x64bumpkey(key))
    for (std::size_t i = 0; i < 4 * kBlocks; i += 4) {
      Words high[2], low[2];
      multiply(c[i], PHILOX_M4x64_0, high[0], low[0]);
      multiply(c[i + 2], PHILOX_M4x64_1, high[1], low[1]);
      c[i] = Xor(high[1], Xor(c[i + 1], Set(kWord, key.v[0]))), c[i + 1] = low[1];
      c[i + 2] = Xor(high[0], Xor(c[i + 3], Set(kWord, key.v[1]))), c[i + 3] = low[0];
    }
}

// As cases::Random, with words that have been drawn.
struct RandomLanes {
  const Words* next;

  HWY_INLINE Words bits() { return *next++; }
  HWY_INLINE NumberLanes uniform() { return share_of(bits()); }
  static HWY_INLINE NumberLanes share_of(Words bits) {
    return ConvertTo(kNumber, ShiftRight<11>(bits)) * Set(kNumber, 0x1p-53);
  }
};

HWY_INLINE std::array<NumberLanes, 2> quarter_turn(Words bits) {
  const Words one = Xor(BitCast(kWord, Set(kNumber, 1)), ShiftLeft<63>(ShiftRight<1>(bits)));  // or -1
  const auto is_odd = TestBit(bits, Set(kWord, 1));
  return {BitCast(kNumber, IfThenZeroElse(is_odd, one)), BitCast(kNumber, IfThenElseZero(is_odd, one))};
}

#include "question/starts/direction-inl.hpp"

template <int kDimension>
std::size_t draw(const cases::Box& box, const philox4x64_key_t& key, std::span<const std::uint64_t> indices,
                 std::uint64_t attempt, QueryRows& rows) {
  // A block has four words; a start takes three words in the plane, five in space.
  constexpr std::size_t kLanes = MaxLanes(kNumber), kEach = kDimension - 1, kVectors = kBlocks / kEach;
  std::size_t done = 0;
  while (done + kVectors * kLanes <= indices.size()) {
    Words words[4 * kBlocks];
    for (std::size_t block = 0; block < kBlocks; ++block) {
      Words* const counter = &words[4 * block];
      counter[0] = LoadU(kWord, &indices[done + block / kEach * kLanes]), counter[1] = Set(kWord, 0);
      counter[2] = Set(kWord, block % kEach), counter[3] = Set(kWord, attempt);
    }
    make_blocks(key, words);
    for (std::size_t vector = 0; vector < kVectors; ++vector, done += kLanes) {
      RandomLanes random{&words[4 * kEach * vector]};
      std::array<NumberLanes, 3> x{box.corner[0], box.corner[1], box.corner[2]};
      for (int i = 0; i < kDimension; ++i) {
        const NumberLanes share = box.cells[i] * random.uniform();
        for (int k = 0; k < kDimension; ++k) x[k] = x[k] + share * box.vectors[i][k];
      }
      const auto v = direction(random, kDimension);
      for (int k = 0; k < kDimension; ++k)
        StoreU(x[k].n, kNumber, &rows.x[k][done]), StoreU(v[k].n, kNumber, &rows.v[k][done]);
    }
  }
  return done;
}

std::size_t draw_uniform(const cases::Box& box, const philox4x64_key_t& key,
                         std::span<const std::uint64_t> indices, std::uint64_t attempt, QueryRows& rows) {
  return (box.dimension == 2 ? draw<2> : draw<3>)(box, key, indices, attempt, rows);
}
#else
std::size_t draw_uniform(const cases::Box&, const philox4x64_key_t&, std::span<const std::uint64_t>,
                         std::uint64_t, QueryRows&) {
  return 0;
}
#endif

}  // namespace lorentz::starts::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lorentz::starts {

HWY_EXPORT(draw_uniform);

std::size_t Candidates::draw_in_lanes(std::span<const std::uint64_t> indices, std::uint64_t attempt,
                                      QueryRows& rows) const {
  return HWY_DYNAMIC_DISPATCH(draw_uniform)(box_, {{seed_, kUniform.hash}}, indices, attempt, rows);
}

}  // namespace lorentz::starts
#endif
