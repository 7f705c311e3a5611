#include "oracle/exact/exact_problem.hpp"

#include <algorithm>

#include <lorentz/geometry.hpp>
#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {

template <>
Z determinant<2>(const Basis<2>& basis) {
  return cross(basis[0].p, basis[1].p);
}

template <>
Z determinant<3>(const Basis<3>& basis) {
  return dot(cross(basis[0].p, basis[1].p), basis[2].p);
}

ZMatrix<2> adjugate(const ZMatrix<2>& columns) {
  const auto& [a, b] = columns;
  return {ZVec<2>{b[1], -b[0]}, ZVec<2>{-a[1], a[0]}};
}

ZMatrix<3> adjugate(const ZMatrix<3>& columns) {
  const auto& [a, b, c] = columns;
  return {cross(b, c), cross(c, a), cross(a, b)};
}

namespace {

template <std::size_t D>
Basis<D> mapped(const ZMatrix<D>& map, Basis<D> basis) {
  for (auto& b : basis) b.p = map * b.p;
  return basis;
}

}  // namespace

template <>
void complete<2>(Basis<2>& basis, std::size_t rank) {
  if (rank == 0) basis[0].p = {1, 0};
  if (rank <= 1) basis[1].p = {Z(-basis[0].p[1]), basis[0].p[0]};
  for (std::size_t i = rank; i < 2; ++i) basis[i].n = {}, basis[i].n[i] = 1;
}

template <>
void complete<3>(Basis<3>& basis, std::size_t rank) {
  if (rank == 0) basis[0].p = {1, 0, 0};
  if (rank <= 1) {
    const ZVec<3>& a = basis[0].p;
    basis[1].p = a[0] == 0 && a[1] == 0 ? ZVec<3>{1, 0, 0} : ZVec<3>{Z(-a[1]), a[0], 0};
  }
  if (rank <= 2) basis[2].p = cross(basis[0].p, basis[1].p);
  for (std::size_t i = rank; i < 3; ++i) basis[i].n = {}, basis[i].n[i] = 1;
}

template <std::size_t D>
DualBasis<D>::DualBasis(const Basis<D>& basis, const Z& r)
    : dual(dual_of(basis)), det(determinant<D>(basis)) {
  if (det < 0) {
    det = -det;
    for (ZVec<D>& row : dual)
      for (Z& component : row) component = -component;
  }
  for (std::size_t i = 0; i < D; ++i) reach[i] = ceil_sqrt(r * r * dot(dual[i], dual[i]));
}

namespace {

// A short basis of the first `rank` vectors, completed.
template <std::size_t D>
void shorten(Basis<D>& basis, std::size_t rank) {
  if (rank == D) return reduce(basis, euclidean_form);
  if (rank == 2) {
    std::array<LatticePoint<D>, 2> pair{std::move(basis[0]), std::move(basis[1])};
    reduce(pair, euclidean_form);
    basis[0] = std::move(pair[0]), basis[1] = std::move(pair[1]);
  }
  complete<D>(basis, rank);
}

template <std::size_t D>
ExactAtom<D> exact_atom(const typename IntegerScene<D>::Atom& atom, const Basis<D>& reduced,
                        std::size_t rank) {
  ExactAtom<D> exact;
  exact.position = atom.position;
  if (!atom.semiaxes) {
    exact.radius = atom.radius;
    exact.home = DualBasis<D>(reduced, exact.radius);
    return exact;
  }
  BallFrame<D> frame{adjugate(*atom.semiaxes), {}};
  exact.radius = abs(dot(frame.to_ball[0], (*atom.semiaxes)[0]));
  frame.reduced = mapped(frame.to_ball, reduced);
  shorten<D>(frame.reduced, rank);
  exact.home = DualBasis<D>(frame.reduced, exact.radius);
  exact.frame = std::move(frame);
  return exact;
}

}  // namespace

CommonExponent common_exponent(const Scene& scene, double other) {
  CommonExponent common;
  common.see(other);
  const auto see = [&](const Vec& a) {
    for (const double component : a) common.see(component);
  };
  for (const Lattice& lattice : scene.lattices) {
    for (const Vec& u : lattice.vectors) see(u);
    for (const Atom& atom : lattice.atoms) {
      see(atom.position);
      for (const Vec& axis : semiaxes_of(atom, scene.dimension)) see(axis);
    }
  }
  return common;
}

template <std::size_t D>
IntegerScene<D> integer_scene(const Scene& scene, double other) {
  const long exponent = common_exponent(scene, other).get();
  auto exact = in_integers<D>(scene, [exponent](double value) { return scaled(value, exponent); });
  exact.exponent = exponent;
  return exact;
}

template <std::size_t D>
ExactScene<D>::ExactScene(const IntegerScene<D>& scene) : exponent(scene.exponent) {
  for (const auto& lattice : scene.lattices) {
    ExactLattice<D>& exact = lattices.emplace_back();
    exact.rank = lattice.rank;
    exact.primitive = basis_of(lattice.vectors);
    exact.reduced = exact.primitive;
    shorten<D>(exact.reduced, exact.rank);
    for (const auto& atom : lattice.atoms)
      exact.atoms.push_back(exact_atom<D>(atom, exact.reduced, exact.rank));
  }
}

namespace {

template <std::size_t D>
Basis<D> scaled_basis(Basis<D> basis, long shift) {
  if (shift > 0)
    for (auto& b : basis)
      for (auto& component : b.p) component = shifted_left(component, shift);
  return basis;
}

// Doubles a vector w that completes a lattice until its copies are far: |w| > 8 (height of x + 4 r), where
// the height of x over the lattice is |offset . w| / |w|. Returns the number of doublings.
template <std::size_t D>
long lengthen(ZVec<D>& w, const ZVec<D>& offset, const Z& radius) {
  const Z w2 = dot(w, w), needed = 8 * (abs(dot(offset, w)) + 4 * radius * ceil_sqrt(w2));
  const long bits = std::max(0L, bit_length(needed) - bit_length(w2) + 1);
  for (Z& component : w) component = shifted_left(component, bits);
  return bits;
}

}  // namespace

template <std::size_t D>
View<D> ExactScene<D>::view(int lattice, int atom, const ZVec<D>& x, const ExactVelocity<D>& velocity,
                            long own) const {
  const auto& exact = lattices[lattice];
  const auto& obstacle = exact.atoms[atom];
  const long shift = exponent - own;
  View<D> view;
  view.radius = shifted_left(obstacle.radius, shift);
  view.radius2 = view.radius * view.radius;
  for (std::size_t k = 0; k < D; ++k) view.offset.p[k] = shifted_left(obstacle.position[k], shift) - x[k];
  if (obstacle.frame) {
    const ZMatrix<D>& to_ball = obstacle.frame->to_ball;
    view.basis = scaled_basis<D>(obstacle.frame->reduced, shift);
    view.offset.p = to_ball * view.offset.p;
    view.velocity.v = to_ball * velocity.v;
    view.velocity.v2 = dot(view.velocity.v, view.velocity.v);
  } else {
    view.basis = scaled_basis<D>(exact.reduced, shift);
    view.velocity = velocity;
  }
  view.rank = exact.rank;
  // Bring the offset home: subtract the lattice vector nearest to it. (It is found by rounding; any near one
  // will do.)
  const DualBasis<D>& home = obstacle.home;
  const Z det = shifted_left(home.det, shift);
  view.volume_bits = bit_length(home.det) + static_cast<long>(D) * shift;
  for (std::size_t i = 0; i < D; ++i) {
    Z coordinate = dot(home.dual[i], view.offset.p);
    if (i >= view.rank) {
      const Z reach = shifted_left(home.reach[i], shift);
      if (compare_sizes(coordinate, reach) >= 0) view.near = false;
      view.volume_bits += lengthen(view.basis[i].p, view.offset.p, view.radius);
      continue;
    }
    const Z k = round_div(coordinate, det);
    if (k != 0) {
      view.offset.add_multiple(-k, view.basis[i]);
      coordinate.subtract_product(k, det);
    }
    // The centres are at this coordinate plus multiples of det, so at |coordinate|, at det - |coordinate|, or
    // farther.
    const Z reach = shifted_left(home.reach[i], shift);
    if (compare_sizes(coordinate, reach) >= 0 && det - abs(coordinate) >= reach) view.near = false;
  }
  return view;
}

template <std::size_t D>
Basis<D> ExactScene<D>::lexicographic_basis(int lattice, int atom, const View<D>& view, long own) const {
  const auto& exact = lattices[lattice];
  Basis<D> basis = scaled_basis<D>(exact.primitive, exponent - own);
  if (const auto& frame = exact.atoms[atom].frame) basis = mapped(frame->to_ball, std::move(basis));
  std::copy(view.basis.begin() + view.rank, view.basis.end(), basis.begin() + view.rank);
  std::reverse(basis.begin(), basis.begin() + view.rank);
  return basis;
}

template <std::size_t D>
ZVec<D> centre_of(const ExactScene<D>& scene, int lattice, int atom, const ZVec<D>& n, const ZVec<D>& x,
                  long exponent) {
  const auto& exact = scene.lattices[lattice];
  ZVec<D> centre = exact.atoms[atom].position;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D && i < exact.rank; ++k) centre[k] += n[i] * exact.primitive[i].p[k];
  for (std::size_t k = 0; k < D; ++k) centre[k] = shifted_left(centre[k], scene.exponent - exponent) - x[k];
  return centre;
}

template IntegerScene<2> integer_scene(const Scene&, double);
template IntegerScene<3> integer_scene(const Scene&, double);
template struct ExactScene<2>;
template struct ExactScene<3>;
template ZVec<2> centre_of(const ExactScene<2>&, int, int, const ZVec<2>&, const ZVec<2>&, long);
template ZVec<3> centre_of(const ExactScene<3>&, int, int, const ZVec<3>&, const ZVec<3>&, long);

}  // namespace lorentz::oracle
