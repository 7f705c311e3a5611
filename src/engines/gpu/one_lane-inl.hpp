// Vectors of one number, for the code of src/engines/batch, in place of native-inl.hpp, twin-inl.hpp and
// lanes-inl.hpp there. Needs the operations of src/engines/base/numbers.hpp. Private to the engine on
// graphics cards.

using V = double;
using M = bool;
constexpr std::size_t kLanes = 1;

HWY_INLINE V none() {
  return 0;
}
HWY_INLINE V infinite() {
  return HUGE_VAL;
}
HWY_INLINE M no_lane() {
  return false;
}
HWY_INLINE M select(M m, M yes, M no) {
  return m ? yes : no;
}
HWY_INLINE V select(M m, V yes, V no) {
  return m ? yes : no;
}
HWY_INLINE V Sqrt(V a) {
  return sqrt(a);
}
HWY_INLINE V MulAdd(V a, V b, V c) {
  return __builtin_fma(a, b, c);
}
HWY_INLINE V MulSub(V a, V b, V c) {
  return __builtin_fma(a, b, -c);
}
HWY_INLINE V NegMulAdd(V a, V b, V c) {
  return __builtin_fma(-a, b, c);
}
HWY_INLINE V sign_of(V a) {
  return CopySign(0, a);
}
HWY_INLINE V Xor(V a, V b) {
  return std::bit_cast<V>(std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b));
}
HWY_INLINE V inverse_power_of(V a) {
  return std::bit_cast<V>((std::uint64_t{2046} - (std::bit_cast<std::uint64_t>(a) >> 52)) << 52);
}
HWY_INLINE void exchange(M m, V& a, V& b) {
  lorentz::exchange(m, a, b);
}
