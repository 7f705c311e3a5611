#include <lorentz/prover.hpp>

#include <algorithm>
#include <variant>

#include <lorentz/errors.hpp>

#include "oracle/exact/exact_query.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/exact/stretches.hpp"

namespace lorentz::oracle {
namespace {

// The first `rank` vectors, without those that complete the lattice.
template <std::size_t D>
CertificateBasis certificate_basis(const Basis<D>& basis, std::size_t rank) {
  CertificateBasis result;
  for (std::size_t i = 0; i < rank; ++i) result[i] = to_cell<D>(basis[i].n);
  return result;
}

// s / v^2 2^exponent as the end of a window, rounded outwards by at most a 64th of rho, however long the
// window is: there may be many obstacles just beyond its end.
WindowEnd end_of(const Z& s, bool upwards, const Z& rho, const Z& v2, long exponent) {
  const long unit = bit_length(rho) - bit_length(v2) - 8 + exponent, shift = exponent - unit;
  const Z numerator = shift >= 0 ? shifted_left(s, shift) : s;
  const Z denominator = shift >= 0 ? v2 : shifted_left(v2, -shift);
  const Z mantissa = upwards ? ceil_div(numerator, denominator) : floor_div(numerator, denominator);
  if (mantissa == 0) return {};
  const long zeros = trailing_zeros(mantissa);
  return {to_integer(mantissa >> zeros), unit + zeros};
}

// Bases of Z^d that begin with n, a vector without a common divisor. If the coordinates of n after the first
// `rank` are 0, the first `rank` vectors are a basis of Z^rank.
std::array<ZVec<2>, 2> completed(const ZVec<2>& n) {
  const Bezout one = bezout(n[0], n[1]);
  return {n, ZVec<2>{-one.y, one.x}};
}

std::array<ZVec<3>, 3> completed(const ZVec<3>& n) {
  if (n[2] == 0) {
    const auto [first, second] = completed(ZVec<2>{n[0], n[1]});
    return {n, ZVec<3>{second[0], second[1], 0}, ZVec<3>{0, 0, 1}};
  }
  if (n[0] == 0 && n[1] == 0) return {n, ZVec<3>{1, 0, 0}, ZVec<3>{0, 1, 0}};
  const Bezout pair = bezout(n[0], n[1]), all = bezout(pair.gcd, n[2]);
  const Z a = n[0] / pair.gcd, b = n[1] / pair.gcd;
  return {n, ZVec<3>{-pair.y, pair.x, 0}, ZVec<3>{-all.y * a, -all.y * b, all.x}};
}

// The inner product of the parts of two vectors across v, times v^2.
template <std::size_t D>
Z across(const ExactVelocity<D>& velocity, const LatticePoint<D>& a, const LatticePoint<D>& b) {
  return velocity.v2 * dot(a.p, b.p) - dot(velocity.v, a.p) * dot(velocity.v, b.p);
}

// Makes the vectors `first` and `first` + 1 a short pair.
template <std::size_t D, class Form>
void shorten_pair(Basis<D>& basis, std::size_t first, const Form& form) {
  std::array<LatticePoint<D>, 2> pair{basis[first], basis[first + 1]};
  reduce(pair, form);
  basis[first] = std::move(pair[0]);
  basis[first + 1] = std::move(pair[1]);
}

// A row is the same wherever along v it begins, so the vector b that leads to it may be changed by multiples
// of the step. If the numbers of b would be too long to be checked, beside a step of hundreds of digits, the
// row is made to begin as near as possible.
template <std::size_t D>
void shorten_along(const LatticePoint<D>& step, const ZVec<D>& v, LatticePoint<D>& b) {
  constexpr long kLongBits = 3000;
  if (std::all_of(b.n.begin(), b.n.end(), [](const Z& n) { return bit_length(n) < kLongBits; })) return;
  const Z along = dot(v, step.p), s = dot(v, b.p);
  b.add_multiple(-round_div(along > 0 ? s : Z(-s), abs(along)), step);
}

// An atom's obstacles as the query sees them.
template <std::size_t D>
struct SeenAtom {
  int lattice, atom;
  View<D> view;
  Z rho_above = root_below(view.radius2 * view.velocity.v2) + 1;
};

template <std::size_t D>
class Writer {
 public:
  Writer(const ExactScene<D>& scene, const Query& query) : scene_(scene), query_(scene, query) {}

  Certificate prove(const Answer& exact) {
    if (exact.outcome != Outcome::hit && exact.outcome != Outcome::inside && exact.outcome != Outcome::never)
      return {};
    for_each_atom(scene_, [&](int l, int a) {
      const SeenAtom<D> seen{l, a, query_.view(scene_, l, a)};
      const Z& rho_above = seen.rho_above;
      if (exact.outcome == Outcome::never)
        add_endless(seen);
      else if (exact.outcome == Outcome::hit)
        add_windows(seen, -rho_above, s_of_hit(seen.view, exact.obstacle) + rho_above);
      else if (std::pair(l, a) <= std::pair(exact.obstacle.lattice, exact.obstacle.atom))
        add_windows(seen, -rho_above, rho_above);
    });
    return std::move(certificate_);
  }

 private:
  // t v^2 rounded up, where t is the time of the hit and v belongs to this view.
  Z s_of_hit(const View<D>& view, const ObstacleId& hit) const {
    const ExactEntry<D> entry = query_.meeting(scene_, hit);
    if (entry.d <= 0) throw InputError("the obstacle is not hit: there is nothing to prove");
    return ceil_div((entry.s - floor_sqrt(entry.d)) * view.velocity.v2, entry.v2);
  }

  void add(const SeenAtom<D>& seen, const Z& low, const std::optional<Z>& high, const Basis<D>& basis) {
    const auto end = [&](const Z& s, bool upwards) {
      return end_of(s, upwards, seen.rho_above, seen.view.velocity.v2, query_.time_exponent());
    };
    certificate_.windows.push_back({seen.lattice, seen.atom, end(low, false),
                                    high ? end(*high, true) : WindowEnd(HUGE_VAL),
                                    certificate_basis<D>(basis, seen.view.rank)});
  }

  void add_windows(const SeenAtom<D>& seen, const Z& low, const Z& high) {
    const View<D>& view = seen.view;
    if (view.rank < D) return add_one(seen, low, high);
    Stretches<D>(view, view.radius2 * view.velocity.v2).cut(low, high, [&](const RowStretch<D>& stretch) {
      add(seen, stretch.low, stretch.high, stretch.basis);
      return false;
    });
  }

  // Adds one window, for a lattice of fewer than D vectors. A pair of vectors is made short in it, so that it
  // has few rows.
  void add_one(const SeenAtom<D>& seen, const Z& low, const std::optional<Z>& high) {
    Basis<D> basis = seen.view.basis;
    // The form of a window with an end is scaled so that the window is as long as it is wide.
    const Z wide = 2 * seen.rho_above, length = high ? Z(*high - low) : Z(0);
    const ExactVelocity<D>& velocity = seen.view.velocity;
    const auto form = [&](const LatticePoint<D>& a, const LatticePoint<D>& b) {
      const Z apart = across(velocity, a, b);
      return length > 0
                 ? Z(length * length * apart + wide * wide * dot(velocity.v, a.p) * dot(velocity.v, b.p))
                 : apart;
    };
    if (seen.view.rank == 2) shorten_pair(basis, 0, form);
    add(seen, low, high, basis);
  }

  // Adds rows along v if there are any, else a window without an end.
  void add_endless(const SeenAtom<D>& seen) {
    const View<D>& view = seen.view;
    const ZVec<D> along = cramer(view.basis, view.velocity.v);
    if (is_copy<D>(along, view.rank)) return add_one(seen, -seen.rho_above, std::nullopt);
    const auto n = completed(primitive(along));
    Basis<D> basis;
    for (std::size_t i = 0; i < view.rank; ++i)
      for (std::size_t k = 0; k < view.rank; ++k) basis[i].add_multiple(n[i][k], view.basis[k]);
    if (view.rank == 3)
      shorten_pair(basis, 1, [&](const auto& a, const auto& b) { return across(view.velocity, a, b); });
    for (std::size_t i = 1; i < view.rank; ++i) shorten_along(basis[0], view.velocity.v, basis[i]);
    certificate_.rows.push_back({seen.lattice, seen.atom, certificate_basis<D>(basis, view.rank)});
  }

  const ExactScene<D>& scene_;
  const ExactQuery<D> query_;
  Certificate certificate_;
};

}  // namespace

struct Prover::Impl {
  Scene given;
  AnyExactScene scene;
};

Prover::Prover(const Scene& scene)
    : impl_(std::make_unique<const Impl>(Impl{scene, any_exact_scene(scene)})) {}

Prover::Prover(Prover&&) noexcept = default;
Prover& Prover::operator=(Prover&&) noexcept = default;
Prover::~Prover() = default;

Certificate Prover::prove(const Query& query, const Answer& exact) const {
  checked(query, impl_->given);
  if (exact.outcome == Outcome::hit || exact.outcome == Outcome::inside)
    checked(exact.obstacle, impl_->given);
  return std::visit(
      [&]<std::size_t D>(const ExactScene<D>& scene) { return Writer<D>(scene, query).prove(exact); },
      impl_->scene);
}

}  // namespace lorentz::oracle
