#include "oracle/margin/perturbed_query.hpp"

#include "oracle/exact/short_basis.hpp"
#include "oracle/first_hit/first_hit.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kFiner = 64;  // the ulps of v are integers in units finer by this many bits

// Combinations of a reduced basis with coefficients up to this size are tried; short vectors are among them.
// Among tiny obstacles (1e-9 and less) dozens of lattice lines run within a few ulps of v, and x lies in the
// corridor of some of them.
template <std::size_t D>
constexpr int kCoefficients = D == 2 ? 16 : 4;

// v and its ulps in integers.
template <std::size_t D>
struct CorridorBox {
  ZVec<D> v, ulp;
  double k;

  CorridorBox(const PerturbedQuery<D>& perturbed, double ulps) : k(ulps) {
    for (std::size_t i = 0; i < D; ++i) {
      v[i] = shifted_left(perturbed.query().velocity.v[i], kFiner);
      ulp[i] = ceiling(times_power_of_two(perturbed.ulps().v[i], kFiner));
    }
  }

  // True if v is within k ulps of f g for some factor f > 0, that is, if g / f is between v - k ulps and
  // v + k ulps.
  bool contains(const ZVec<D>& g) const {
    Real least;  // lower bound of 1 / f
    std::optional<Real> most;
    const auto at_most = [&](const Real& bound) { most = most ? std::min(*most, bound) : bound; };
    for (std::size_t i = 0; i < D; ++i) {
      const Real room = k * real(ulp[i]), low = real(v[i]) - room, high = real(v[i]) + room, gi = real(g[i]);
      if ((low == 0 && gi < 0) || (high == 0 && gi > 0)) return false;
      if (low > 0) at_most(gi / low);
      if (low < 0) least = std::max(least, gi / low);
      if (high > 0) least = std::max(least, gi / high);
      if (high < 0) at_most(gi / high);
    }
    return !most || (least <= *most && *most > 0);
  }

  // A direction normal to G within k ulps of v: v with each component moved by the same share of its ulp.
  std::optional<ZVec<D>> normal_to(const ZVec<D>& G) const {
    Z reach = 0;
    for (std::size_t i = 0; i < D; ++i) reach += abs(G[i]) * ulp[i];
    const Z off = dot(G, v);
    if (off == 0) return v;
    if (reach == 0 || real(Z(abs(off))) > k * real(reach)) return std::nullopt;
    ZVec<D> direction;
    for (std::size_t i = 0; i < D; ++i) direction[i] = v[i] * reach - off * ulp[i] * sgn(G[i]);
    return direction;
  }
};

// A vector of the dual lattice, times the determinant, and its product with v.
template <std::size_t D>
struct DualVector {
  ZVec<D> G;
  Z along;

  void add_multiple(const Z& k, const DualVector& other) {
    for (std::size_t i = 0; i < D; ++i) G[i] += k * other.G[i];
    along += k * other.along;
  }
};

// Calls visit for all combinations of the vectors with small coefficients, one of each pair of opposite
// signs.
template <class Vector, std::size_t D, class Visit>
bool any_combination(const std::array<Vector, D>& basis, const Visit& visit) {
  constexpr int kMost = kCoefficients<D>, kWidth = 2 * kMost + 1;
  int count = 1;
  for (std::size_t i = 0; i < D; ++i) count *= kWidth;
  for (int code = count / 2 + 1; code < count; ++code) {
    Vector sum = basis[0];
    sum.add_multiple(code % kWidth - kMost - 1, basis[0]);
    for (std::size_t i = 1, rest = code / kWidth; i < D; ++i, rest /= kWidth)
      sum.add_multiple(static_cast<long>(rest % kWidth) - kMost, basis[i]);
    if (visit(sum)) return true;
  }
  return false;
}

// The normal, after a linear map M, of the line or plane to which G was normal: det(M) M^-T G. Its matrix is
// the adjugate of M^T, whose columns are the rows of M.
template <std::size_t D>
ZVec<D> mapped_normal(const ZMatrix<D>& map, const ZVec<D>& G) {
  return adjugate(map) * G;
}

template <std::size_t D>
class CorridorSearch {
 public:
  CorridorSearch(const PerturbedQuery<D>& perturbed, double ulps)
      : query_(perturbed), box_(perturbed, ulps), ulps_(ulps) {}

  bool found() const {
    for (const ExactLattice<D>& lattice : query_.scene().lattices) {
      if (lattice.rank < D) continue;
      if (along_planes(lattice.reduced)) return true;
      if (D == 3 && along_vectors(lattice.reduced)) return true;
    }
    return false;
  }

 private:
  // True if nothing is ever hit in this direction. The obstacles are made smaller by the change that `ulps`
  // ulps make across the corridor (2D) or the planar channel (3D) with the normal G, if these have any width.
  bool is_open(const ZVec<D>& direction, const ZVec<D>& G) const {
    const ExactQuery<D>& query = query_.query();
    const ExactVelocity<D> velocity{direction, dot(direction, direction)};
    for (const Uncertain<D>& atom : query_.atoms()) {
      const ExactScene<D>& scene = query_.scene();
      View<D> view = scene.view(atom.lattice(), atom.atom(), query.x, velocity, query.length_exponent);
      if (G != ZVec<D>{}) {
        const auto& frame = scene.lattices[atom.lattice()].atoms[atom.atom()].frame;
        const ZVec<D> normal = frame ? mapped_normal(frame->to_ball, G) : G;
        if (leave_gaps(view, normal)) view.radius -= ceiling(ulps_ * atom.change_along(normal));
      }
      if (view.radius <= 0) continue;
      view.radius2 = view.radius * view.radius;
      Earliest<D> earliest;
      search_first_hit<D>(view, atom.lattice(), atom.atom(), nullptr, earliest);
      if (earliest.found()) return false;
    }
    return true;
  }

  // True if there is room between the obstacles of one atom, in lattice lines or planes with this normal. The
  // radius is that of the scene, give or take `ulps` of its ulps. The ulps of x do not count here: far from
  // the origin they are large, and shrinking the obstacles by them could open a way that does not exist.
  bool leave_gaps(const View<D>& view, const ZVec<D>& normal) const {
    Z spacing = 0;  // of the planes, times |normal|
    for (const LatticePoint<D>& vector : view.basis) spacing = gcd(spacing, Z(dot(normal, vector.p)));
    const Real width = 2 * real(view.radius) * (1 - ulps_ * std::ldexp(1.0, 1 - precision_bits()));
    return width <= 0 || width * width * real(dot(normal, normal)) < real(spacing) * real(spacing);
  }

  // Tries directions normal to short vectors of the dual lattice: along lattice lines (2D), within lattice
  // planes (3D).
  bool along_planes(const Basis<D>& basis) const {
    std::array<DualVector<D>, D> dual;
    const auto vectors = dual_of(basis);
    for (std::size_t i = 0; i < D; ++i) dual[i] = {vectors[i], dot(vectors[i], box_.v)};
    const Z v2 = dot(box_.v, box_.v);
    reduce(dual, [&](const DualVector<D>& a, const DualVector<D>& b) -> Z {
      return shifted_left(a.along * b.along, 2 * sharp()) + v2 * dot(a.G, b.G);
    });
    return any_combination(dual, [&](const DualVector<D>& one) {
      const auto direction = box_.normal_to(one.G);
      return direction && is_open(*direction, one.G);
    });
  }

  bool along_vectors(Basis<D> basis) const {
    const Z v2 = dot(box_.v, box_.v);
    reduce(basis, [&](const LatticePoint<D>& a, const LatticePoint<D>& b) -> Z {
      const Z along = dot(box_.v, a.p) * dot(box_.v, b.p);
      return shifted_left(v2 * dot(a.p, b.p) - along, 2 * sharp()) + along;
    });
    return any_combination(basis, [&](const LatticePoint<D>& one) {
      ZVec<D> g = one.p;
      if (dot(g, box_.v) < 0)
        for (Z& component : g) component = -component;
      return box_.contains(g) && is_open(g, {});
    });
  }

  int precision_bits() const { return bits_of(query_.ulps().precision); }
  // An angle of 2^-50 (binary32: 2^-21) counts as much as the length.
  long sharp() const { return precision_bits() - 3; }

  const PerturbedQuery<D>& query_;
  const CorridorBox<D> box_;
  const double ulps_;
};

}  // namespace

template <std::size_t D>
bool open_near(const PerturbedQuery<D>& perturbed, double ulps) {
  return CorridorSearch<D>(perturbed, ulps).found();
}

template bool open_near(const PerturbedQuery<2>&, double);
template bool open_near(const PerturbedQuery<3>&, double);

}  // namespace lorentz::oracle
