#include "corridor.hpp"

#include "first_hit.hpp"
#include "short_basis.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kFiner = 64;  // the ulps of v are integers in units so much finer
constexpr int kCoefficients = 2;

// v and its ulps as integers.
template <std::size_t D>
struct Box {
  ZVec<D> v, ulp;
  double k;

  Box(const Situation<D>& situation, double ulps) : k(ulps) {
    for (std::size_t i = 0; i < D; ++i) {
      v[i] = shifted_left(situation.query().flight.v[i], kFiner);
      ulp[i] = ceiling(times_power_of_two(situation.ulps().v[i], kFiner));
    }
  }

  // Is a multiple of g within k ulps of v?
  bool contains(const ZVec<D>& g) const {
    Real least = 0, most = -1;  // of the factor
    for (std::size_t i = 0; i < D; ++i) {
      if (v[i] == 0 || sgn(g[i]) != sgn(v[i])) {
        if (v[i] != g[i]) return false;
        continue;
      }
      const Real size = abs(real(g[i])), middle = abs(real(v[i])), room = k * real(ulp[i]);
      least = std::max(least, Real((middle - room) / size));
      most = most < 0 ? Real((middle + room) / size) : std::min(most, Real((middle + room) / size));
    }
    return least <= most;
  }

  // A direction normal to G within k ulps of v: v with each component moved by the same share of its ulp.
  std::optional<ZVec<D>> normal_to(const ZVec<D>& G) const {
    Z reach = 0;
    for (std::size_t i = 0; i < D; ++i) reach += abs(G[i]) * ulp[i];
    const Z off = dot(G, v);
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

std::array<ZVec<2>, 2> dual_vectors(const Basis<2>& b) {
  return {ZVec<2>{b[1].p[1], -b[1].p[0]}, ZVec<2>{-b[0].p[1], b[0].p[0]}};
}
std::array<ZVec<3>, 3> dual_vectors(const Basis<3>& b) {
  return {cross(b[1].p, b[2].p), cross(b[2].p, b[0].p), cross(b[0].p, b[1].p)};
}

// Calls visit with all combinations of the vectors with small coefficients, up to the sign.
template <class Vector, std::size_t D, class Visit>
bool any_combination(const std::array<Vector, D>& basis, const Visit& visit) {
  constexpr int kWidth = 2 * kCoefficients + 1;
  int count = 1;
  for (std::size_t i = 0; i < D; ++i) count *= kWidth;
  for (int code = count / 2 + 1; code < count; ++code) {
    Vector sum = basis[0];
    sum.add_multiple(code % kWidth - kCoefficients - 1, basis[0]);
    for (std::size_t i = 1, rest = code / kWidth; i < D; ++i, rest /= kWidth)
      sum.add_multiple(static_cast<long>(rest % kWidth) - kCoefficients, basis[i]);
    if (visit(sum)) return true;
  }
  return false;
}

template <std::size_t D>
class CorridorSearch {
 public:
  CorridorSearch(const Situation<D>& situation, double ulps)
      : situation_(situation), box_(situation, ulps), ulps_(ulps) {}

  bool found() const {
    for (const ExactLattice<D>& lattice : situation_.scene().lattices) {
      if (along_planes(lattice.reduced)) return true;
      if (D == 3 && along_vectors(lattice.reduced)) return true;
    }
    return false;
  }

 private:
  // Nothing is ever hit in this direction; obstacles smaller by what `ulps` ulps of x and r make.
  bool is_open(const ZVec<D>& direction) const {
    const ExactQuery<D>& query = situation_.query();
    const Flight<D> flight{direction, dot(direction, direction)};
    for (const Uncertain<D>& atom : situation_.atoms()) {
      View<D> view =
          view_of<D>(situation_.scene(), atom.lattice(), atom.atom(), query.x, flight, query.length_exponent);
      view.radius -= ceiling(Real(ulps_ * atom.largest_change(0)));
      if (view.radius <= 0) continue;
      view.radius2 = view.radius * view.radius;
      const Z rho2 = view.radius2 * view.flight.v2;
      Earliest<D> earliest;
      search_first_hit(Search<D>{view, view.flight, atom.lattice(), atom.atom(), nullptr, rho2,
                                 root_below(rho2), earliest});
      if (earliest.found()) return false;
    }
    return true;
  }

  // Normal to a short vector of the dual lattice: along lattice lines (2D), within lattice planes (3D).
  bool along_planes(const Basis<D>& basis) const {
    std::array<DualVector<D>, D> dual;
    const auto vectors = dual_vectors(basis);
    for (std::size_t i = 0; i < D; ++i) dual[i] = {vectors[i], dot(vectors[i], box_.v)};
    const Z v2 = dot(box_.v, box_.v);
    reduce(dual, [&](const DualVector<D>& a, const DualVector<D>& b) {
      return shifted_left(a.along * b.along, 2 * kSharp) + v2 * dot(a.G, b.G);
    });
    return any_combination(dual, [&](const DualVector<D>& one) {
      const auto direction = box_.normal_to(one.G);
      return direction && is_open(*direction);
    });
  }

  bool along_vectors(Basis<D> basis) const {
    const Z v2 = dot(box_.v, box_.v);
    reduce(basis, [&](const LatticePoint<D>& a, const LatticePoint<D>& b) {
      const Z along = dot(box_.v, a.p) * dot(box_.v, b.p);
      return shifted_left(v2 * dot(a.p, b.p) - along, 2 * kSharp) + along;
    });
    return any_combination(basis, [&](const LatticePoint<D>& one) {
      ZVec<D> g = one.p;
      if (dot(g, box_.v) < 0)
        for (Z& component : g) component = -component;
      return box_.contains(g) && is_open(g);
    });
  }

  static constexpr long kSharp = 50;  // an angle of 2^-50 counts as much as the length

  const Situation<D>& situation_;
  const Box<D> box_;
  const double ulps_;
};

}  // namespace

template <std::size_t D>
bool open_near(const Situation<D>& situation, double ulps) {
  return CorridorSearch<D>(situation, ulps).found();
}

template bool open_near(const Situation<2>&, double);
template bool open_near(const Situation<3>&, double);

}  // namespace lorentz::oracle
