// A 3D Bravais lattice seen along a velocity.
//
// Coordinates are measured across the line in units of r, and along it in units of a length that grows while
// nothing is met. In these units the cylinder has radius 1 and a window of it has length 1, and if a basis is
// short, few lattice planes and few lattice lines meet the window. A line is solved by one quadratic.

/// Everything that does not depend on the start.
template <class Numbers, bool kUnit, bool kBall, class Integer = typename Numbers::Number>
struct DirectionOf3 : FrameOf3<Numbers, kUnit, kBall> {
  using Frame = FrameOf3<Numbers, kUnit, kBall>;
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;
  using Basis = BasisOf3<Numbers, Integer>;

  Basis basis;

  /// Only the `wanted` directions need to be usable. Requires velocities without tiny components.
  template <class Arch>
  LORENTZ_INLINE void set(const Bravais& lattice, const Number (&velocity)[3], Mask wanted) {
    Frame::template set<Arch>(lattice, velocity);
    basis.length = first_length(lattice);
    const Number along = all(1) / basis.length;
    const auto& form = this->form();
    for (int i = 0; i < 3; ++i) {
      typename Basis::Arm& arm = basis.b[i];
      for (int j = 0; j < 3; ++j) arm.n[j] = Integer(all(i == j ? 1 : 0));
      arm.p[0] = this->scale[0] * form[0][i].hi, arm.p[1] = this->scale[1] * form[1][i].hi;
      arm.z = along * form[2][i].hi;
      arm.cancellation = all(0);
    }
    basis.usable = wanted;
    if constexpr (!Numbers::kInRegisters) shorten<Arch>(basis, wanted);
  }

  /// For another atom of the same lattice, with balls of another radius. Only the scales differ, and the
  /// basis is reduced further from its present state.
  template <class Arch>
  LORENTZ_INLINE void retarget(const Bravais& lattice, Mask wanted) {
    const double before = this->inverse_r;
    const Number length_before = basis.length;
    this->set_radius(lattice);
    basis.length = first_length(lattice);
    const Number wider = all(this->inverse_r / before), longer = length_before / basis.length;
    for (typename Basis::Arm& arm : basis.b)
      arm.p[0] = arm.p[0] * wider, arm.p[1] = arm.p[1] * wider, arm.z = arm.z * longer;
    if constexpr (!Numbers::kInRegisters) shorten<Arch>(basis, wanted);
  }

  /// For a longer window. The basis is reduced further from its present state.
  template <class Arch>
  LORENTZ_INLINE void lengthen(Basis& longer, Number factor, Mask wanted) const {
    longer.length = longer.length * factor;
    for (typename Basis::Arm& arm : longer.b) arm.z = arm.z / factor;
    if constexpr (!Numbers::kInRegisters) shorten<Arch>(longer, wanted);
  }

  /// Reduces to a basis that is short in the window's metric. In registers the search does so, in one place, because
  /// a graphics card has little room for code.
  template <class Arch>
  LORENTZ_INLINE void shorten(Basis& to, Mask wanted) const {
    const Mask is_short = reduce_basis<Arch>(static_cast<const Frame&>(*this), to, wanted);
    to.set_dual();
    to.usable = And(to.usable, is_short);
  }

 private:
  // The length of a window in which two balls are expected.
  LORENTZ_INLINE Number first_length(const Bravais& lattice) const {
    return all(kWindowCells * lattice.volume / (3.14 * lattice.radius * lattice.radius)) * sqrt(this->v2);
  }
};
