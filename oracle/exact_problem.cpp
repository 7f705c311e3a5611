#include "exact_problem.hpp"

#include "short_basis.hpp"

namespace lorentz::oracle {

template <>
Z determinant<2>(const Basis<2>& basis) {
  return cross(basis[0].p, basis[1].p);
}

template <>
Z determinant<3>(const Basis<3>& basis) {
  return dot(cross(basis[0].p, basis[1].p), basis[2].p);
}

template <std::size_t D>
ExactScene<D>::ExactScene(const Scene& scene) {
  CommonExponent common;
  for (const Lattice& lattice : scene.lattices) {
    for (const Vec& u : lattice.vectors)
      for (double component : u) common.see(component);
    for (const Atom& atom : lattice.atoms) {
      for (double component : atom.position) common.see(component);
      common.see(atom.radius);
    }
  }
  exponent = common.get();
  for (const Lattice& lattice : scene.lattices) {
    ExactLattice<D> exact;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) {
        exact.primitive[i].p[k] = scaled(lattice.vectors[i][k], exponent);
        exact.primitive[i].n[k] = i == k ? 1 : 0;
      }
    exact.reduced = exact.primitive;
    reduce(exact.reduced, EuclideanForm<D>{});
    for (const Atom& atom : lattice.atoms) {
      ExactAtom<D> ball;
      for (std::size_t k = 0; k < D; ++k) ball.position[k] = scaled(atom.position[k], exponent);
      ball.radius = scaled(atom.radius, exponent);
      exact.atoms.push_back(ball);
    }
    lattices.push_back(exact);
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

// Coordinates of p in the basis, times its determinant.
ZVec<2> cramer(const Basis<2>& b, const ZVec<2>& p) {
  return {cross(p, b[1].p), cross(b[0].p, p)};
}

ZVec<3> cramer(const Basis<3>& b, const ZVec<3>& p) {
  return {dot(p, cross(b[1].p, b[2].p)), dot(p, cross(b[2].p, b[0].p)), dot(p, cross(b[0].p, b[1].p))};
}

}  // namespace

template <std::size_t D>
View<D> view_of(const ExactScene<D>& scene, int lattice, int atom, const ZVec<D>& x, long exponent) {
  const auto& exact = scene.lattices[lattice];
  const auto& ball = exact.atoms[atom];
  const long shift = scene.exponent - exponent;
  View<D> view;
  view.basis = scaled_basis<D>(exact.reduced, shift);
  view.radius = shifted_left(ball.radius, shift);
  view.radius2 = view.radius * view.radius;
  for (std::size_t k = 0; k < D; ++k) view.offset.p[k] = shifted_left(ball.position[k], shift) - x[k];
  // Bring the offset home: subtract the lattice vector nearest to it (by rounding; any near one will do).
  const Z det = determinant<D>(view.basis);
  const ZVec<D> coordinates = cramer(view.basis, view.offset.p);
  for (std::size_t i = 0; i < D; ++i) {
    const Z k = det > 0 ? round_div(coordinates[i], det) : round_div(-coordinates[i], -det);
    if (k != 0) view.offset.add_multiple(-k, view.basis[i]);
  }
  return view;
}

template <std::size_t D>
Basis<D> lexicographic_basis(const ExactScene<D>& scene, int lattice, long exponent) {
  Basis<D> basis = scaled_basis<D>(scene.lattices[lattice].primitive, scene.exponent - exponent);
  std::swap(basis.front(), basis.back());
  return basis;
}

template struct ExactScene<2>;
template struct ExactScene<3>;
template View<2> view_of(const ExactScene<2>&, int, int, const ZVec<2>&, long);
template View<3> view_of(const ExactScene<3>&, int, int, const ZVec<3>&, long);
template Basis<2> lexicographic_basis(const ExactScene<2>&, int, long);
template Basis<3> lexicographic_basis(const ExactScene<3>&, int, long);

}  // namespace lorentz::oracle
