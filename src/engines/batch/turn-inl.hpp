// The symmetry of the unit lattices of balls that brings each lane's velocity into the first octant: Octant
// of src/engines/reduction/offset.hpp. Private to the batch engine.

template <int D, bool kTurned>
struct Turn {  // nothing is turned
  HWY_INLINE explicit Turn(const V (&)[D]) {}
  HWY_INLINE void apply(const V (&here)[D], V (&there)[D]) const {
    for (int k = 0; k < D; ++k) there[k] = here[k];
  }
  HWY_INLINE void undo(const V (&there)[D], V (&here)[D]) const { apply(there, here); }
};

template <>
struct Turn<2, true> {
  M keeps;  ///< the first axis stays the first
  V sign[2];

  HWY_INLINE explicit Turn(const V (&v)[2])
      : keeps(Abs(v[0]) >= Abs(v[1])), sign{sign_of(v[0]), sign_of(v[1])} {}
  HWY_INLINE void apply(const V (&here)[2], V (&there)[2]) const {
    const V a = Xor(here[0], sign[0]), b = Xor(here[1], sign[1]);
    there[0] = select(keeps, a, b), there[1] = select(keeps, b, a);
  }
  HWY_INLINE void undo(const V (&there)[2], V (&here)[2]) const {
    here[0] = Xor(select(keeps, there[0], there[1]), sign[0]);
    here[1] = Xor(select(keeps, there[1], there[0]), sign[1]);
  }
};

template <>
struct Turn<3, true> {
  M first[3], last[3];  ///< axis k comes first, or last; otherwise in the middle
  V sign[3];

  HWY_INLINE explicit Turn(const V (&v)[3]) : sign{sign_of(v[0]), sign_of(v[1]), sign_of(v[2])} {
    const V a = Abs(v[0]), b = Abs(v[1]), c = Abs(v[2]);
    const M ab = a < b, ac = a < c, bc = b < c;
    first[0] = Not(Or(ab, ac)), last[0] = And(ab, ac);
    first[1] = AndNot(bc, ab), last[1] = AndNot(ab, bc);
    first[2] = And(ac, bc), last[2] = Not(Or(ac, bc));
  }
  HWY_INLINE void apply(const V (&here)[3], V (&there)[3]) const {
    V a[3];
    for (int k = 0; k < 3; ++k) a[k] = Xor(here[k], sign[k]);
    there[0] = select(first[0], a[0], select(first[1], a[1], a[2]));
    there[2] = select(last[0], a[0], select(last[1], a[1], a[2]));
    const M middle0 = Not(Or(first[0], last[0])), middle1 = Not(Or(first[1], last[1]));
    there[1] = select(middle0, a[0], select(middle1, a[1], a[2]));
  }
  HWY_INLINE void undo(const V (&there)[3], V (&here)[3]) const {
    for (int k = 0; k < 3; ++k)
      here[k] = Xor(select(first[k], there[0], select(last[k], there[2], there[1])), sign[k]);
  }
};
