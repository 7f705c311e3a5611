// A scene and a query as integers: all lengths are multiplied by one power of two, the velocity by another.
// Private to oracle/.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <lorentz/scene.hpp>
#include "oracle/integers/dyadic.hpp"
#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// Returns the scene if it is valid and its vectors are independent; else throws InputError, which names the
/// place.
const Scene& checked_exactly(const Scene& scene);

/// A lattice vector or point: p in Cartesian coordinates, and n, its coordinates in the scene's primitive
/// vectors.
template <std::size_t D>
struct LatticePoint {
  ZVec<D> p;
  ZVec<D> n;

  void add_multiple(const Z& k, const LatticePoint& other) {
    for (std::size_t i = 0; i < D; ++i) {
      p[i].add_product(k, other.p[i]);
      n[i].add_product(k, other.n[i]);
    }
  }
  void negate() {
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = -p[i];
      n[i] = -n[i];
    }
  }
};

template <std::size_t D>
using Basis = std::array<LatticePoint<D>, D>;

/// Vectors as a basis, with coordinates n in themselves.
template <std::size_t D>
Basis<D> basis_of(const std::array<ZVec<D>, D>& vectors) {
  Basis<D> basis;
  for (std::size_t i = 0; i < D; ++i) {
    basis[i].p = vectors[i];
    basis[i].n[i] = 1;
  }
  return basis;
}

/// A lattice of fewer than D vectors is completed by vectors that are perpendicular to its own and to each
/// other. Their coordinates n come after the lattice's own. A point at which one of these coordinates is not
/// 0 is not an obstacle but a copy of one. A view makes the completing vectors so long that a flight meets no
/// copy before it has met or missed every obstacle. So if the first hit is a copy, the flight hits no
/// obstacle.
template <std::size_t D>
void complete(Basis<D>& basis, std::size_t rank);

/// True for the coordinates of a copy.
template <std::size_t D>
bool is_copy(const ZVec<D>& n, std::size_t rank) {
  for (std::size_t i = rank; i < D; ++i)
    if (n[i] != 0) return true;
  return false;
}

template <std::size_t D>
ZVec<D> operator+(const ZVec<D>& a, const ZVec<D>& b) {
  ZVec<D> sum;
  for (std::size_t i = 0; i < D; ++i) sum[i] = a[i] + b[i];
  return sum;
}

template <std::size_t D>
ZVec<D> operator*(const Z& factor, const ZVec<D>& a) {
  ZVec<D> product;
  for (std::size_t i = 0; i < D; ++i) product[i] = factor * a[i];
  return product;
}

template <std::size_t D>
ZVec<D> operator-(const ZVec<D>& a, const ZVec<D>& b) {
  ZVec<D> difference;
  for (std::size_t i = 0; i < D; ++i) difference[i] = a[i] - b[i];
  return difference;
}

/// The shortest integer vector parallel to a, which is not 0.
template <std::size_t D>
ZVec<D> primitive(ZVec<D> a) {
  Z divisor = 0;
  for (const Z& component : a) divisor = gcd(divisor, component);
  for (Z& component : a) component /= divisor;
  return a;
}

/// A linear map, as its rows.
template <std::size_t D>
using ZMatrix = std::array<ZVec<D>, D>;

template <std::size_t D>
ZVec<D> operator*(const ZMatrix<D>& map, const ZVec<D>& a) {
  ZVec<D> image;
  for (std::size_t i = 0; i < D; ++i) image[i] = dot(map[i], a);
  return image;
}

/// det(A) A^-1, as rows, of the matrix A with these columns.
ZMatrix<2> adjugate(const ZMatrix<2>& columns);
ZMatrix<3> adjugate(const ZMatrix<3>& columns);

template <std::size_t D>
ZMatrix<D> transposed(const ZMatrix<D>& map) {
  ZMatrix<D> result;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) result[i][k] = map[k][i];
  return result;
}

/// Coordinates in which an atom's ellipsoids { p + A y : |y| < 1 } are balls of radius |det A|: space is
/// mapped by adj(A) = det(A) A^-1, an integer matrix like A. A linear map preserves lines, lattices and
/// times, so in these coordinates an ellipsoid is just another scene of balls, and nothing is rounded.
template <std::size_t D>
struct BallFrame {
  ZMatrix<D> to_ball;  ///< adj(A)
  Basis<D> reduced;    ///< a short basis of the lattice there, completed
};

/// The coordinates of p in a basis: dual p / det.
template <std::size_t D>
struct DualBasis {
  ZMatrix<D> dual;
  Z det;  ///< > 0
  /// Smallest integers >= r |dual_i|. The dual coordinates of a point within r of p differ from those of p by
  /// less than that.
  ZVec<D> reach;

  DualBasis() = default;
  DualBasis(const Basis<D>& basis, const Z& r);
};

template <std::size_t D>
struct ExactAtom {
  ZVec<D> position;
  Z radius;                           ///< in the frame's coordinates, if there is a frame
  std::optional<BallFrame<D>> frame;  ///< present for an ellipsoid
  DualBasis<D> home;                  ///< of the short basis of the lattice, in the same coordinates
};

template <std::size_t D>
struct ExactLattice {
  std::size_t rank = D;  ///< the number of vectors that the scene gives; the others complete them
  Basis<D> primitive;    ///< the scene's own vectors
  Basis<D> reduced;      ///< a short basis of the same lattice, shortest vector first
  std::vector<ExactAtom<D>> atoms;
};

/// The common exponent of all lengths in a scene, and of one other length.
CommonExponent common_exponent(const Scene& scene, double other = 0);

template <std::size_t D>
ZVec<D> scaled_vector(const Vec& a, long exponent) {
  ZVec<D> result;
  for (std::size_t k = 0; k < D; ++k) result[k] = scaled(a[k], exponent);
  return result;
}

/// A scene whose numbers are integers times 2^exponent. The lattices are as the scene gives them, not
/// reduced.
template <std::size_t D>
struct IntegerScene {
  struct Atom {
    ZVec<D> position;
    Z radius;
    std::optional<std::array<ZVec<D>, D>> semiaxes;  ///< present for an ellipsoid
  };
  struct Lattice {
    std::size_t rank = D;
    std::array<ZVec<D>, D> vectors;  ///< the first `rank`
    std::vector<Atom> atoms;
  };
  long exponent = 0;
  std::vector<Lattice> lattices;
};

/// A scene, or one of rational numbers, with the integer `number(x)` in place of each number x.
template <std::size_t D, class AnyScene, class Number>
IntegerScene<D> in_integers(const AnyScene& scene, const Number& number) {
  const auto vector = [&](const auto& a) {
    ZVec<D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = number(a[i]);
    return result;
  };
  IntegerScene<D> result;
  for (const auto& lattice : scene.lattices) {
    auto& its = result.lattices.emplace_back();
    its.rank = static_cast<std::size_t>(lattice.rank_in(D));
    for (std::size_t i = 0; i < D; ++i) its.vectors[i] = vector(lattice.vectors[i]);
    for (const auto& atom : lattice.atoms) {
      auto& its_atom = its.atoms.emplace_back();
      its_atom.position = vector(atom.position);
      if (atom.is_ball()) {
        its_atom.radius = number(atom.radius);
        continue;
      }
      its_atom.semiaxes.emplace();
      for (std::size_t i = 0; i < D; ++i) (*its_atom.semiaxes)[i] = vector(atom.semiaxes[i]);
    }
  }
  return result;
}

/// The scene in integers, in a unit so small that `other`, a length, is an integer, too.
template <std::size_t D>
IntegerScene<D> integer_scene(const Scene& scene, double other = 0);

/// The velocity v scaled to integers, and v^2.
template <std::size_t D>
struct ExactVelocity {
  ZVec<D> v;
  Z v2;
};

/// One atom's obstacles seen from the particle, in coordinates in which they are balls. Their centres
/// relative to x are offset + the lattice.
template <std::size_t D>
struct View {
  ExactVelocity<D> velocity;
  Basis<D> basis;  ///< reduced, and completed by vectors far longer than the distance of x from the lattice
  std::size_t rank = D;
  LatticePoint<D> offset;  ///< the centre in the cell near x, with its coordinates n
  bool near = true;        ///< false: no centre was within `radius` of x when the view was made
  long volume_bits = 0;    ///< bit length of |det basis|
  Z radius;
  Z radius2;  ///< radius^2
};

/// The scene with every length multiplied by 2^-exponent, and its lattices reduced.
template <std::size_t D>
struct ExactScene {
  long exponent = 0;
  std::vector<ExactLattice<D>> lattices;

  explicit ExactScene(const IntegerScene<D>& scene);
  explicit ExactScene(const Scene& scene) : ExactScene(integer_scene<D>(checked_exactly(scene))) {}

  /// The view of an atom from x, all lengths multiplied by 2^-own (own at most the scene's exponent and x's).
  View<D> view(int lattice, int atom, const ZVec<D>& x, const ExactVelocity<D>& velocity, long own) const;

  /// The view's lattice in its own primitive vectors in reverse order: the order for lexicographically
  /// smallest answers.
  Basis<D> lexicographic_basis(int lattice, int atom, const View<D>& view, long own) const;
};

/// A scene in the number of dimensions that it says.
using AnyExactScene = std::variant<ExactScene<2>, ExactScene<3>>;

inline AnyExactScene any_exact_scene(const Scene& scene) {
  if (scene.dimension == 2) return ExactScene<2>(scene);
  return ExactScene<3>(scene);
}

/// The centre of the obstacle (lattice, atom, n) relative to x, in the scene's own coordinates.
template <std::size_t D>
ZVec<D> centre_of(const ExactScene<D>& scene, int lattice, int atom, const ZVec<D>& n, const ZVec<D>& x,
                  long exponent);

template <std::size_t D>
Z determinant(const Basis<D>& basis);

/// The dual basis, times the determinant of the basis.
template <std::size_t D>
ZMatrix<D> dual_of(const Basis<D>& basis) {
  ZMatrix<D> columns;
  for (std::size_t i = 0; i < D; ++i) columns[i] = basis[i].p;
  return adjugate(columns);
}

/// The coordinates of p in the basis, times the determinant of the basis.
template <std::size_t D>
ZVec<D> cramer(const Basis<D>& basis, const ZVec<D>& p) {
  return dual_of(basis) * p;
}

}  // namespace lorentz::oracle
