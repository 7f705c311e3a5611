// Vectors with a number in each lane (V), masks with yes or no in each lane (M), and pairs of twice the
// precision. Included once for each set of instructions (Google Highway's foreach_target). Private to the
// batch engine.
//
// Code that rarely runs is a function of its own (HWY_NOINLINE) and gets copies of its arguments, because the
// compiler keeps in registers only objects whose address no function has.
//
// The engine for one flight (src/engines/reduction) and this one share code: the files *-inl.hpp there. Code
// that exists only in this folder does, lane by lane, the operations of a single flight, one by one and in
// their order. So the bounds of bounds.hpp hold, and both give the same bits. A branch there is a mask here.

HWY_INLINE V none() {
  return all(0);
}
HWY_INLINE V infinite() {
  return all(HUGE_VAL);
}
HWY_INLINE M everywhere(bool m) {
  return m ? Not(no_lane()) : no_lane();
}
HWY_INLINE bool any(M m) {
  return !nowhere(m);
}
HWY_INLINE V select(M m, V yes, V no) {
  return IfThenElse(m, yes, no);
}
HWY_INLINE V where(M m, V a) {  ///< a, or zero
  return IfThenElseZero(m, a);
}
HWY_INLINE V sign_of(V a) {  ///< a zero with a's sign, for Xor
  return And(a, all(-0.0));
}
HWY_INLINE V operator-(V a) {
  return Neg(a);
}
HWY_INLINE V sqrt(V a) {
  return Sqrt(a);
}
// A constant on the left, as in the code for one flight.
HWY_INLINE V operator*(double a, V b) {
  return all(a) * b;
}
HWY_INLINE V operator+(double a, V b) {
  return all(a) + b;
}
HWY_INLINE V operator-(double a, V b) {
  return all(a) - b;
}
HWY_INLINE V operator/(double a, V b) {
  return all(a) / b;
}
HWY_INLINE V NegIf(M m, V a) {
  return Xor(a, where(m, all(-0.0)));
}
HWY_INLINE void exchange(M m, V& a, V& b) {
  const V before = a;
  a = select(m, b, a), b = select(m, before, b);
}

/// How exact products are made in lanes; fma.hpp has this for one flight.
struct LaneFma {
  using Number = V;
  using Mask = M;
  using Apart = LaneFma;
  static constexpr bool kOne = false;

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
