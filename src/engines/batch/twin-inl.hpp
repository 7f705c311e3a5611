// Two vectors as one, so that the processor works on one while the other waits for a division or a mask.
// Included once for each set of instructions. Private to the batch engine.

struct V {
  N a, b;
};
struct M {
  NM a, b;
};

constexpr std::size_t kLanes = 2 * kNativeLanes;

#define LORENTZ_ON_BOTH(Result, name, Argument) \
  HWY_INLINE Result name(Argument x) {          \
    return {name(x.a), name(x.b)};              \
  }
#define LORENTZ_ON_BOTH_2(Result, name, First, Second) \
  HWY_INLINE Result name(First x, Second y) {          \
    return {name(x.a, y.a), name(x.b, y.b)};           \
  }
#define LORENTZ_ON_BOTH_3(name, First)                 \
  HWY_INLINE V name(First x, V y, V z) {               \
    return {name(x.a, y.a, z.a), name(x.b, y.b, z.b)}; \
  }
#define LORENTZ_OPERATOR(Result, op)        \
  HWY_INLINE Result operator op(V x, V y) { \
    return {x.a op y.a, x.b op y.b};        \
  }

LORENTZ_OPERATOR(V, +)
LORENTZ_OPERATOR(V, -)
LORENTZ_OPERATOR(V, *)
LORENTZ_OPERATOR(V, /)
LORENTZ_OPERATOR(M, <)
LORENTZ_OPERATOR(M, >)
LORENTZ_OPERATOR(M, <=)
LORENTZ_OPERATOR(M, >=)
LORENTZ_OPERATOR(M, ==)
LORENTZ_OPERATOR(M, !=)
LORENTZ_ON_BOTH(V, Abs, V)
LORENTZ_ON_BOTH(V, Neg, V)
LORENTZ_ON_BOTH(V, Sqrt, V)
LORENTZ_ON_BOTH(V, Floor, V)
LORENTZ_ON_BOTH(V, Ceil, V)
LORENTZ_ON_BOTH(V, Round, V)
LORENTZ_ON_BOTH(V, inverse_power_of, V)
LORENTZ_ON_BOTH(V, root_above, V)
LORENTZ_ON_BOTH(M, Not, M)
LORENTZ_ON_BOTH_2(V, Max, V, V)
LORENTZ_ON_BOTH_2(V, Min, V, V)
LORENTZ_ON_BOTH_2(V, Xor, V, V)
LORENTZ_ON_BOTH_2(V, And, V, V)
LORENTZ_ON_BOTH_2(V, CopySign, V, V)
LORENTZ_ON_BOTH_2(M, And, M, M)
LORENTZ_ON_BOTH_2(M, Or, M, M)
LORENTZ_ON_BOTH_2(M, AndNot, M, M)
LORENTZ_ON_BOTH_2(V, IfThenElseZero, M, V)
LORENTZ_ON_BOTH_2(V, IfThenZeroElse, M, V)
LORENTZ_ON_BOTH_3(MulAdd, V)
LORENTZ_ON_BOTH_3(MulSub, V)
LORENTZ_ON_BOTH_3(NegMulAdd, V)
LORENTZ_ON_BOTH_3(IfThenElse, M)

#undef LORENTZ_ON_BOTH
#undef LORENTZ_ON_BOTH_2
#undef LORENTZ_ON_BOTH_3
#undef LORENTZ_OPERATOR

HWY_INLINE V all(double a) {
  return {Set(kTag, a), Set(kTag, a)};
}
HWY_INLINE M no_lane() {
  return {MaskFromVec(Zero(kTag)), MaskFromVec(Zero(kTag))};
}
HWY_INLINE bool nowhere(M m) {
  return AllFalse(kTag, Or(m.a, m.b));
}
HWY_INLINE M first_lanes(std::size_t count) {
  return {first_native(count), first_native(count > kNativeLanes ? count - kNativeLanes : 0)};
}
HWY_INLINE unsigned bits_of(M m) {
  return bits_of(m.a) | bits_of(m.b) << kNativeLanes;
}
HWY_INLINE V load(const double* from) {
  return {load_native(from), load_native(from + kNativeLanes)};
}
HWY_INLINE void store(V x, double* to) {
  store(x.a, to), store(x.b, to + kNativeLanes);
}
HWY_INLINE void store_integers(V x, std::int64_t* to) {
  store_integers(x.a, to), store_integers(x.b, to + kNativeLanes);
}
HWY_INLINE void store_small_integers(V x, std::int32_t* to) {
  store_small_integers(x.a, to), store_small_integers(x.b, to + kNativeLanes);
}
HWY_INLINE std::size_t store_some(V x, M m, double* to) {
  const std::size_t count = store_some(x.a, m.a, to);
  return count + store_some(x.b, m.b, to + count);
}
