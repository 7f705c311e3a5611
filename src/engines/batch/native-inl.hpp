// One of the processor's vectors, with the operations that the batch engine needs. Included once for each set
// of instructions. Private to the batch engine.

using namespace hwy::HWY_NAMESPACE;

using Tag = CappedTag<double, 8>;
using IntegerTag = RebindToSigned<Tag>;
using SmallTag = Rebind<std::int32_t, Tag>;
using N = hwy::HWY_NAMESPACE::Vec<Tag>;    ///< a number in each lane
using NM = hwy::HWY_NAMESPACE::Mask<Tag>;  ///< yes or no in each lane

constexpr Tag kTag{};
constexpr IntegerTag kIntegerTag{};
constexpr std::size_t kNativeLanes = MaxLanes(Tag{});

// For AVX-512 Highway's own versions are instructions on mask registers, one for each operation. As integers,
// masks stay where the compiler uses them, and whole expressions of them cost less.
#if HWY_TARGET == HWY_AVX3
HWY_INLINE NM And(NM x, NM y) {
  return {static_cast<std::uint8_t>(x.raw & y.raw)};
}
HWY_INLINE NM Or(NM x, NM y) {
  return {static_cast<std::uint8_t>(x.raw | y.raw)};
}
HWY_INLINE NM AndNot(NM not_x, NM y) {
  return {static_cast<std::uint8_t>(~not_x.raw & y.raw)};
}
HWY_INLINE NM Not(NM x) {
  return {static_cast<std::uint8_t>(~x.raw)};
}
HWY_INLINE bool AllFalse(Tag, NM x) {
  return x.raw == 0;
}
#endif

HWY_INLINE N load_native(const double* from) {
  return LoadU(kTag, from);
}
HWY_INLINE void store(N a, double* to) {
  StoreU(a, kTag, to);
}

/// Requires integers below 2^51.
HWY_INLINE void store_integers(N a, std::int64_t* to) {
  const N magic = Set(kTag, 0x1.8p52);
  StoreU(BitCast(kIntegerTag, a + magic) - BitCast(kIntegerTag, magic), kIntegerTag, to);
}
HWY_INLINE void store_small_integers(N a, std::int32_t* to) {
  StoreU(DemoteTo(SmallTag{}, a), SmallTag{}, to);
}

/// Stores the lanes of m one after the other, and overwrites the memory behind them. Returns how many lanes
/// were stored.
HWY_INLINE std::size_t store_some(N a, NM m, double* to) {
  return CompressStore(a, m, kTag, to);
}

/// One bit per lane.
HWY_INLINE unsigned bits_of(NM m) {
  std::uint8_t bytes[8] = {};
  StoreMaskBits(kTag, m, bytes);
  return bytes[0] & ((1u << kNativeLanes) - 1);
}

HWY_INLINE NM first_native(std::size_t count) {
  return FirstN(kTag, count);
}

/// As in numbers.hpp.
HWY_INLINE N root_above(N a) {
  constexpr RebindToUnsigned<Tag> kBits{};
  const auto halved = ShiftRight<1>(BitCast(kBits, a)) + Set(kBits, std::uint64_t{1023} << 51);
  return IfThenElse(a < Set(kTag, HUGE_VAL), BitCast(kTag, halved), a);
}

/// 2^-e for a normal number of exponent e.
HWY_INLINE N inverse_power_of(N a) {
  return BitCast(kTag, ShiftLeft<52>(Set(kIntegerTag, 2046) - ShiftRight<52>(BitCast(kIntegerTag, a))));
}
