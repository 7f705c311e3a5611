// How lanes compute: exact products, pairs of twice the precision, and what lanes share with single flights.
// Needs vectors V and masks M. Private to the batch engine, and the one on graphics cards.
//
// Code that rarely runs is a function of its own (HWY_NOINLINE) and gets copies of its arguments, because the
// compiler keeps in registers only objects whose address no function has.
//
// The engine for one flight (src/engines/reduction) and this one share code: the files *-inl.hpp there. Code
// that exists only in this folder does, lane by lane, the operations of a single flight, one by one and in
// their order. So the bounds of bounds.hpp hold, and both give the same bits. A branch there is a mask here.

/// How exact products are made in lanes; fma.hpp has this for one flight.
struct LaneFma {
  using Number = V;
  using Mask = M;
  using Apart = LaneFma;
  static constexpr bool kOne = false;
  static constexpr bool kInRegisters = kLanes == 1;  ///< objects that are copied cost nothing

  static HWY_INLINE V product_error(V a, V b, V p) { return MulSub(a, b, p); }
  static HWY_INLINE V remainder(V a, V k, V b) { return NegMulAdd(k, b, a); }
};

#define LORENTZ_INLINE HWY_INLINE
#define LORENTZ_RARE HWY_INLINE
#define LORENTZ_NOINLINE HWY_NOINLINE
#include "src/engines/base/double_double-inl.hpp"

#include "src/engines/reduction/formulas-inl.hpp"

#include "src/engines/reduction/shared-inl.hpp"
#undef LORENTZ_NOINLINE
#undef LORENTZ_RARE
#undef LORENTZ_INLINE

using Pair = DoubleDouble<LaneFma>;

/// The lanes that are still flying. Flights that lanes cannot decide are left to the engine for one flight.
struct Lanes {
  M active;

  HWY_INLINE explicit Lanes(M asked) : active(asked) {}
  HWY_INLINE void leave(M m) { active = AndNot(m, active); }
  HWY_INLINE void leave_unless(M m) { active = And(m, active); }
};
