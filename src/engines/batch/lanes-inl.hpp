// A number in each lane of a vector (V), yes or no (M), and pairs of twice the precision. Included once for
// each set of instructions (Google Highway's foreach_target). Private to the batch engine.
//
// What is rarely called is a function of its own (HWY_NOINLINE), and is given copies of its arguments: the
// compiler keeps in registers only what no function has the address of.
//
// What is here and in the files beside it does, lane by lane, the operations of the engine for one flight
// (src/engines/reduction), one by one and in their order: then the bounds of bounds.hpp hold, and so does
// the test that both give the same bits. A branch there is a mask here.
#if defined(LORENTZ_BATCH_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_LANES_INL_HPP
#undef LORENTZ_BATCH_LANES_INL_HPP
#else
#define LORENTZ_BATCH_LANES_INL_HPP
#endif

#include "src/engines/batch/single-inl.hpp"
#include "src/engines/batch/twin-inl.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE V none() {
  return all(0);
}
HWY_INLINE V infinite() {
  return all(HUGE_VAL);
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
HWY_INLINE V largest(V a, V b, V c) {
  return Max(Max(a, b), c);
}
HWY_INLINE void exchange(M m, V& a, V& b) {
  const V before = a;
  a = select(m, b, a), b = select(m, before, b);
}

/// DoubleDouble, in lanes.
struct Pair {
  V hi, lo;

  HWY_INLINE V value() const { return hi + lo; }
};

HWY_INLINE Pair pair_of(V a) {
  return {a, none()};
}
HWY_INLINE Pair pair_of(const Wide& a) {
  return {all(a.hi), all(a.lo)};
}
HWY_INLINE Pair sum_of(V a, V b) {
  const V s = a + b, b_part = s - a;
  return {s, (a - (s - b_part)) + (b - b_part)};
}
HWY_INLINE Pair ordered_sum_of(V a, V b) {
  const V s = a + b;
  return {s, b - (s - a)};
}
HWY_INLINE Pair product_of(V a, V b) {
  const V p = a * b;
  return {p, MulSub(a, b, p)};
}
HWY_INLINE Pair operator-(Pair a) {
  return {Neg(a.hi), Neg(a.lo)};
}
HWY_INLINE Pair operator+(Pair x, Pair y) {
  const Pair s = sum_of(x.hi, y.hi), t = sum_of(x.lo, y.lo), v = ordered_sum_of(s.hi, s.lo + t.hi);
  return ordered_sum_of(v.hi, t.lo + v.lo);
}
HWY_INLINE Pair operator-(Pair x, Pair y) {
  return x + -y;
}
HWY_INLINE Pair operator*(Pair x, Pair y) {
  const Pair p = product_of(x.hi, y.hi);
  return ordered_sum_of(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
}
HWY_INLINE Pair operator*(Pair x, V y) {
  const Pair p = product_of(x.hi, y), s = ordered_sum_of(p.hi, x.lo * y);
  return ordered_sum_of(s.hi, s.lo + p.lo);
}
HWY_INLINE Pair operator/(Pair x, Pair y) {
  const V quotient = x.hi / y.hi;
  const Pair r = y * quotient;
  return ordered_sum_of(quotient, ((x.hi - r.hi) + (x.lo - r.lo)) / y.hi);
}
HWY_INLINE Pair root_of(Pair x) {
  const V root = Sqrt(x.hi), square = root * root;
  const V rest = (x.hi - square) - MulSub(root, root, square);
  return ordered_sum_of(root, (x.lo + rest) / (all(2) * root));
}
HWY_INLINE Pair add_product(Pair sum, Pair a, V b) {
  const Pair p = product_of(a.hi, b), s = sum_of(sum.hi, p.hi);
  return ordered_sum_of(s.hi, s.lo + (sum.lo + (p.lo + a.lo * b)));
}
/// add_product to zero.
HWY_INLINE Pair first_product(Pair a, V b) {
  const Pair p = product_of(a.hi, b);
  return ordered_sum_of(p.hi, p.lo + a.lo * b);
}
HWY_INLINE Pair select(M m, Pair yes, Pair no) {
  return {select(m, yes.hi, no.hi), select(m, yes.lo, no.lo)};
}

/// The lanes that have not given up: what is beyond lanes is left to the engine for one flight.
struct Lanes {
  M active;

  HWY_INLINE void leave(M m) { active = AndNot(m, active); }
  HWY_INLINE void leave_unless(M m) { active = And(m, active); }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
