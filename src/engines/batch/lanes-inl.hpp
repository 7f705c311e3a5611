// Vectors with a number in each lane (V), and masks with yes or no in each lane (M). Included once for each
// set of instructions (Google Highway's foreach_target). Private to the batch engine.

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
