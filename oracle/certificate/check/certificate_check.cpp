// Checks proofs of answers in integers alone. Notation as in docs/certificates.md: a line x + t v, an
// obstacle's centre w = c - x relative to the start, s = v.w along, h = v x w across. Every atom has
// coordinates of its own, in which it is a ball. All numbers are in the largest power of two that they are
// multiples of: integers from here on, the same as in other checkers, so that these count the same steps.
#include <lorentz/certificate_check.hpp>

#include <tuple>

#include "oracle/certificate/check/certificate_time.hpp"
#include "oracle/certificate/check/certificate_view.hpp"

namespace lorentz::oracle {
namespace {

using namespace certificate;

/// Integers from lo to hi; none if lo > hi.
struct TimeRange {
  Z lo, hi;

  bool empty() const { return lo > hi; }
  Z size() const { return hi - lo + 1; }  ///< of one that is not empty
  bool contains(const Z& a) const { return lo <= a && a <= hi; }
};

TimeRange intersection(const TimeRange& a, const TimeRange& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The range that factor * a + offset, +- slack, lies in for a in a non-empty range.
TimeRange image(const Z& factor, const TimeRange& a, const Z& offset, const Z& slack) {
  const Z one = factor * a.lo, other = factor * a.hi;
  return {Z(std::min(one, other) + offset - slack), Z(std::max(one, other) + offset + slack)};
}

/// The k with k * divisor + offset in the range, divisor != 0.
TimeRange quotients(const TimeRange& a, const Z& offset, const Z& divisor) {
  const Z low = a.lo - offset, high = a.hi - offset;
  if (divisor > 0) return {ceil_div(low, divisor), floor_div(high, divisor)};
  return {ceil_div(high, divisor), floor_div(low, divisor)};
}

/// The k with a k^2 + 2 b k + c < 0, for a > 0: times a this is (a k + b)^2 < b^2 - a c.
TimeRange below_zero(const Z& a, const Z& b, const Z& c) {
  const Z square = b * b - a * c;
  if (square <= 0) return {1, 0};
  const Z root = root_below(square);
  return {ceil_div(-b - root, a), floor_div(root - b, a)};
}

/// Thrown where a proof takes more steps than are allowed, right or not.
struct TooLong : Refuted {};

/// The steps (docs/certificates.md) that may still be spent on a certificate.
class Budget {
 public:
  Budget(long most, std::size_t pieces) : most_(most), left_(most) {
    constexpr long kStepsOfPiece = 10;
    spend(kStepsOfPiece * Z(static_cast<long>(pieces)));
  }

  void spend(const Z& steps) {
    if (steps > left_) throw TooLong{{"takes more than " + std::to_string(most_) + " steps"}};
    left_ -= steps.get_si();
  }

 private:
  long most_, left_;
};

template <std::size_t D>
struct Obstacle {
  int lattice, atom;
  ZVec<D> n;

  auto key() const { return std::tie(lattice, atom, n); }
  std::string name() const { return name_of(lattice, atom, n); }
};

/// What is claimed: `hit` at a time, `inside`, or `never`.
template <std::size_t D>
struct Claim {
  Outcome outcome;
  Obstacle<D> obstacle;
  std::optional<Obstacle<D>> from;
  ProofTime time{};  // of `inside`: 0

  bool is_from(const Obstacle<D>& other) const { return from && from->key() == other.key(); }

  /// Refutes if an obstacle that is met, with d = r^2 v^2 - |h|^2 > 0, contradicts the claim. It contains x
  /// iff v^2 w^2 = s^2 + |h|^2 < r^2 v^2, that is s^2 < d; else the ray enters it iff s > 0.
  template <class CellOf>
  void hold_against(const CertificateView<D>& view, const Z& s, const Z& d, const CellOf& cell_of) const {
    if (outcome == Outcome::never) refute("the line meets " + name_of(view.lattice, view.atom, cell_of()));
    const bool contains_x = s * s < d, hit = outcome == Outcome::hit;
    int order = -1;
    if (!contains_x) {
      if (!hit || s <= 0) return;
      order = compare(ProofTime{s, d, view.v2}, time);
      if (order > 0) return;
    }
    const Obstacle<D> other{view.lattice, view.atom, cell_of()};
    if (is_from(other)) return;
    if (hit && contains_x) refute(other.name() + " contains x");
    if (hit && order < 0) refute(other.name() + " is entered earlier");
    if (other.key() < obstacle.key())
      refute(other.name() + (hit ? " is entered at the same time" : " contains x, too,") +
             " and comes first");
  }
};

// ---- Windows

/// Finds all obstacles w = w_0 + k_1 b_1 + .. + k_d b_d of a window that are met, those with s in a range and
/// |h|^2 <= H = r^2 v^2 - 1, and holds them against the claim.
template <std::size_t D>
class WindowSearch {
 public:
  WindowSearch(const CertificateView<D>& view, const Basis<D>& basis, const TimeRange& s,
               const Claim<D>& claim, Budget& budget)
      : view_(view), basis_(basis), b_(basis.b), window_(s), claim_(claim), budget_(budget) {
    most_h2_ = view.rho2 - 1;
    s1_ = dot(view.v, b_[0]), s2_ = dot(view.v, b_[1]);
    h11_ = view.across(b_[0], s1_, b_[0], s1_);
    h12_ = view.across(b_[0], s1_, b_[1], s2_);
    h22_ = view.across(b_[1], s2_, b_[1], s2_);
  }

  void run();

 private:
  /// The obstacles w + k_1 b_1 + k_2 b_2 with s in the window and k_2 in the range.
  void search_plane(const ZVec<D>& w, const Z& k3, const TimeRange& k2) {
    if (k2.empty()) return;
    budget_.spend(k2.size());
    const Z s0 = dot(view_.v, w), h01 = view_.across(w, s0, b_[0], s1_),
            h02 = view_.across(w, s0, b_[1], s2_);
    const Z c0 = view_.across(w, s0, w, s0) - view_.rho2;
    for (Z k = k2.lo; k <= k2.hi; ++k)
      search_row(s0 + k * s2_, h01 + k * h12_, c0 + k * (2 * h02 + k * h22_), k, k3);
  }

  /// The obstacles at w + k_1 b_1, with s0 = v.w, b = h.h_1 and c = |h|^2 - r^2 v^2, which are met iff
  /// h_1^2 k_1^2 + 2 b k_1 + c < 0. If b_1 is parallel to v then h_1 = 0 and b = 0, and all or none are met.
  /// h_1 and s_1 are not both 0.
  void search_row(const Z& s0, const Z& b, const Z& c, const Z& k2, const Z& k3) {
    TimeRange k;
    if (h11_ == 0) {
      if (c >= 0) return;
      k = quotients(window_, s0, s1_);
    } else {
      k = below_zero(h11_, b, c);
      if (s1_ != 0)
        k = intersection(k, quotients(window_, s0, s1_));
      else if (!window_.contains(s0))
        return;
    }
    if (k.empty()) return;
    budget_.spend(k.size());
    for (Z k1 = k.lo; k1 <= k.hi; ++k1)
      claim_.hold_against(view_, s0 + k1 * s1_, -c - k1 * (2 * b + k1 * h11_), [&] {
        ZVec<D> coefficients{k1, k2};
        if constexpr (D == 3) coefficients[2] = k3;
        return combination(coefficients, basis_.n);
      });
  }

  TimeRange rows_in_plane(const ZVec<3>& w, const ZVec<3>& normal, const ZVec<3>& e) const;

  const CertificateView<D>& view_;
  const Basis<D>& basis_;
  const ZMatrix<D>& b_;
  const TimeRange& window_;
  const Claim<D>& claim_;
  Budget& budget_;
  Z most_h2_;                    // H
  Z s1_, s2_, h11_, h12_, h22_;  // s_i = v.b_i, h_ij = (v x b_i).(v x b_j)
};

/// With v' = v turned by a right angle, v^2 w = s v + h v'; cross(b_1, v') = b_1.v = s_1, so
/// v^2 cross(b_1, w) = s cross(b_1, v) + h s_1.
template <>
void WindowSearch<2>::run() {
  budget_.spend(1);  // the plane
  const Z slack = floor_sqrt(most_h2_ * s1_ * s1_);
  const TimeRange bounds = image(cross(b_[0], view_.v), window_, 0, slack);
  search_plane(view_.w0, 0,
               quotients(bounds, view_.v2 * cross(b_[0], view_.w0), view_.v2 * cross(b_[0], b_[1])));
}

/// The k_2 in the plane through w, with L = N.w:
///   v^2 (e.w)^2 + (s (N.v) - v^2 L)^2 = e^2 |h|^2 <= e^2 H,
/// so v^2 (e.w)^2 <= e^2 H - m^2 for the smallest m = |s (N.v) - v^2 L| in the window. The two equations
///   e.w' = e.w + k_1 (e.b_1) + k_2 (e.b_2),  s' = s + k_1 (v.b_1) + k_2 (v.b_2)
/// have the determinant (e.b_1)(v.b_2) - (e.b_2)(v.b_1) = (e x v).N = e^2, so by Cramer's rule
///   e^2 k_2 = (e.b_1)(s' - s) - (v.b_1)(e.w' - e.w), here times v^2.
/// And (h_1.w')^2 v^2 <= h_1^2 H, for h_1.v = 0; h_1.b_1 = 0 and h_1.b_2 = N.v. Not both of e and N.v are 0.
template <>
TimeRange WindowSearch<3>::rows_in_plane(const ZVec<3>& w, const ZVec<3>& normal, const ZVec<3>& e) const {
  const Z along = dot(normal, view_.v), e2 = dot(e, e);
  const Z most = floor_sqrt(h11_ * most_h2_ / view_.v2);  // |h_1.w'|
  const ZVec<3> h1 = cross(view_.v, b_[0]);
  if (e2 == 0) return quotients({Z(-most), most}, dot(h1, w), along);
  const TimeRange off = image(along, window_, -(view_.v2 * dot(normal, w)), 0);
  const Z m = off.contains(0) ? Z(0) : std::min(Z(abs(off.lo)), Z(abs(off.hi)));
  const Z square = e2 * most_h2_ - m * m;  // of a plane that is looked at, not below 0
  const Z e1 = dot(e, b_[0]), at_w = e1 * dot(view_.v, w) - s1_ * dot(e, w);
  const TimeRange bounds = image(e1 * view_.v2, window_, 0, floor_sqrt(s1_ * s1_ * view_.v2 * square));
  const TimeRange k2 = quotients(bounds, view_.v2 * at_w, view_.v2 * e2);
  return along == 0 ? k2 : intersection(k2, quotients({Z(-most), most}, dot(h1, w), along));
}

/// With N = b_1 x b_2 and e = v x N: (v^2 N.w - s (N.v))^2 <= e^2 H, and N.w = N.w_0 + k_3 N.b_3.
template <>
void WindowSearch<3>::run() {
  const ZVec<3> normal = cross(b_[0], b_[1]), e = cross(view_.v, normal);
  const TimeRange bounds = image(dot(normal, view_.v), window_, 0, floor_sqrt(most_h2_ * dot(e, e)));
  const TimeRange k3 = quotients(bounds, view_.v2 * dot(normal, view_.w0), view_.v2 * dot(normal, b_[2]));
  if (k3.empty()) return;
  budget_.spend(k3.size());
  for (Z k = k3.lo; k <= k3.hi; ++k) {
    const ZVec<3> w = sum(view_.w0, k, b_[2]);
    search_plane(w, k, rows_in_plane(w, normal, e));
  }
}

/// An end of a window: n / 2^bits.
struct End {
  Z n;
  unsigned long bits = 0;

  explicit End(const WindowEnd& end) {
    constexpr long kMost = WindowEnd::kMostExponent;
    if (end.exponent > kMost || end.exponent < -kMost)
      refute("an end has an exponent beyond " + std::to_string(kMost));
    constexpr std::size_t kDecimals = kLongestText * 5 / 4;  // of as many hexadecimal digits
    n = shifted_left(read_integer(end.mantissa, kDecimals),
                     static_cast<unsigned long>(std::max(end.exponent, 0L)));
    bits = static_cast<unsigned long>(std::max(-end.exponent, 0L));
  }

  friend bool operator>(const End& a, const End& b) {
    return shifted_left(a.n, b.bits) > shifted_left(b.n, a.bits);
  }
};

// ---- The check

template <std::size_t D>
class Check {
 public:
  Check(const Scene& scene, long most_steps) : most_steps_(most_steps) {
    CommonExponent exponent;
    for (const Lattice& lattice : scene.lattices) {
      for (std::size_t i = 0; i < D; ++i) see<D>(exponent, lattice.vectors[i]);
      for (const Atom& atom : lattice.atoms) {
        see<D>(exponent, atom.position);
        if (atom.is_ball()) exponent.see(atom.radius);
        for (const Vec& axis : atom.semiaxes) see<D>(exponent, axis);
      }
    }
    exponent_ = exponent.get();
    for (const Lattice& lattice : scene.lattices) {
      bodies_.emplace_back();
      for (const Atom& atom : lattice.atoms) bodies_.back().emplace_back(lattice, atom, exponent_);
    }
  }

  void check(const Query& query, const Answer& answer, const Certificate& certificate) const {
    const Flight flight = flight_of(query);
    if (answer.outcome == Outcome::never) return check_never(flight, certificate);
    if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside)
      refute("only hit, inside and never have proofs");
    if (!certificate.rows.empty()) refute("rows prove `never` only");
    check_windows(claim_of(query, answer, flight), flight, certificate.windows);
  }

 private:
  /// A query in integers: as each atom sees it.
  using Flight = std::vector<std::vector<CertificateView<D>>>;

  Flight flight_of(const Query& query) const;
  bool has(int lattice, int atom) const {
    const auto l = static_cast<std::size_t>(lattice), a = static_cast<std::size_t>(atom);  // huge if negative
    return l < bodies_.size() && a < bodies_[l].size();
  }
  Claim<D> claim_of(const Query& query, const Answer& answer, const Flight& flight) const;
  void check_never(const Flight& flight, const Certificate& certificate) const;
  void check_windows(const Claim<D>& claim, const Flight& flight, const std::vector<Window>& windows) const;

  long most_steps_, exponent_ = 0;
  std::vector<std::vector<Body<D>>> bodies_;
};

template <std::size_t D>
typename Check<D>::Flight Check<D>::flight_of(const Query& query) const {
  for (std::size_t i = D; i < 3; ++i)
    if (query.x[i] != 0 || query.v[i] != 0) refute("the query has a third coordinate in two dimensions");
  CommonExponent of_query;
  see<D>(of_query, query.x), see<D>(of_query, query.v);
  const long unit = std::min(exponent_, of_query.get());
  const auto shift = static_cast<unsigned long>(exponent_ - unit);
  const ZVec<D> x = scaled_vec<D>(query.x, unit), v = scaled_vec<D>(query.v, unit);
  Flight flight;
  for (std::size_t l = 0; l < bodies_.size(); ++l) {
    flight.emplace_back();
    for (std::size_t a = 0; a < bodies_[l].size(); ++a) {
      const Body<D>& body = bodies_[l][a];
      const unsigned long bits = body.bits_of_coordinates(unit);
      CertificateView<D> view{static_cast<int>(l), static_cast<int>(a), {}, {}, {}, {}, {}};
      view.v = shifted(body.in_own_coordinates(v), bits);
      for (std::size_t i = 0; i < D; ++i) view.u[i] = shifted(body.u[i], bits + shift);
      view.w0 = sum(shifted(body.p, bits + shift), -1, shifted(body.in_own_coordinates(x), bits));
      view.v2 = dot(view.v, view.v);
      view.rho2 = shifted_left(body.r * body.r, 2 * body.bits_of_radius(unit)) * view.v2;
      flight.back().push_back(std::move(view));
    }
  }
  return flight;
}

/// The claim about the answer's obstacle itself: it is no `from`, and is entered at this time, or contains x.
template <std::size_t D>
Claim<D> Check<D>::claim_of(const Query& query, const Answer& answer, const Flight& flight) const {
  const auto& [lattice, atom, cell] = answer.obstacle;
  if (!has(lattice, atom)) refute("the answer's " + name_of(lattice, atom) + " does not exist");
  Claim<D> claim{answer.outcome, {lattice, atom, {}}, {}};
  try {
    claim.obstacle.n = read_cell<D>(cell);
    if (query.from)
      claim.from = Obstacle<D>{query.from->lattice, query.from->atom, read_cell<D>(query.from->cell)};
  } catch (const Refuted& refuted) {
    refute("a cell " + refuted.why);
  }
  const std::string name = "the answer's " + claim.obstacle.name();
  if (claim.is_from(claim.obstacle)) refute(name + " is `from`");
  const CertificateView<D>& view = flight[lattice][atom];
  const ZVec<D> w = sum(view.w0, 1, combination(claim.obstacle.n, view.u));
  const Z s = dot(view.v, w), d = view.rho2 - view.across(w, s, w, s);
  if (d <= 0) refute(name + " is not met by the line");
  const bool contains_x = s * s < d;
  if (contains_x != (answer.outcome == Outcome::inside))
    refute(name + (contains_x ? " contains x" : " does not contain x"));
  if (contains_x) return claim;
  if (s <= 0) refute(name + " lies behind");
  claim.time = {s, d, view.v2};
  const ScaledTime exact{claim.time, 0};
  if (!answer.time || !rounds_to(exact, *answer.time)) refute(name + " is not entered at the time given");
  if (!answer.time_decimal.empty() && !rounds_to(exact, answer.time_decimal))
    refute(name + " is not entered at the time given in decimal");
  return claim;
}

/// How far an atom's windows, in the order in which they are listed, leave no gap.
class Coverage {
 public:
  /// T = n / 2^bits <= -r/|v| iff n v^2 <= -2^bits r |v|.
  template <std::size_t D>
  void add(const CertificateView<D>& view, const End& from, const End& to) {
    if (from > to) refute("ends before it begins");
    const Z unit = shifted_left(1, from.bits);
    const bool begins_late = sign_of(-from.n * view.v2, 0, unit * unit * view.rho2) < 0;
    if (begins_late && !reached_) refute("begins too late");
    if (begins_late && from > *reached_) refute("a gap before it");
    if (!reached_ || to > *reached_) reached_ = to;
  }

  /// T >= t + r/|v| for the time t = (s - sqrt(d)) / q, times q: n v^2 q >= 2^bits (v^2 (s - sqrt(d)) + q r
  /// |v|).
  template <std::size_t D>
  bool reaches(const CertificateView<D>& view, const ProofTime& time) const {
    if (!reached_) return false;
    const Z unit = shifted_left(1, reached_->bits), factor = unit * view.v2, other = unit * time.q;
    return sign_of(reached_->n * view.v2 * time.q - factor * time.s, factor * factor * time.d,
                   other * other * view.rho2) >= 0;
  }

 private:
  std::optional<End> reached_;
};

template <std::size_t D>
void Check<D>::check_windows(const Claim<D>& claim, const Flight& flight,
                             const std::vector<Window>& windows) const {
  Budget budget(most_steps_, windows.size());
  std::vector<std::vector<Coverage>> coverage;
  for (const auto& views : flight) coverage.emplace_back(views.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto& [lattice, atom, from_end, to_end, of_basis] = windows[i];
    try {
      if (!has(lattice, atom)) refute("no such atom");
      const CertificateView<D>& view = flight[lattice][atom];
      const End from(from_end), to(to_end);
      coverage[lattice][atom].add(view, from, to);
      const TimeRange s{Z(-(-(from.n * view.v2) >> from.bits)), Z(to.n * view.v2 >> to.bits)};
      const Basis<D> basis = read_basis(of_basis, view);
      WindowSearch<D>(view, basis, s, claim, budget).run();
    } catch (Refuted& refuted) {
      refuted.why = "window " + std::to_string(i) + " (" + name_of(lattice, atom) + "): " + refuted.why;
      throw;
    }
  }
  const auto last = std::tie(claim.obstacle.lattice, claim.obstacle.atom);
  for (const auto& views : flight)
    for (const CertificateView<D>& view : views)
      if ((claim.outcome == Outcome::hit || std::tie(view.lattice, view.atom) <= last) &&
          !coverage[view.lattice][view.atom].reaches(view, claim.time))
        refute(name_of(view.lattice, view.atom) + ": no window, or its windows end too early");
}

/// Of a row along v that is met, obstacles b_1 apart are: one has 0 <= s <= |s_1|.
template <std::size_t D>
void Check<D>::check_never(const Flight& flight, const Certificate& certificate) const {
  if (!certificate.windows.empty()) refute("windows do not prove `never`");
  Budget budget(most_steps_, certificate.rows.size());
  std::vector<std::vector<bool>> seen;
  for (const auto& views : flight) seen.emplace_back(views.size());
  for (std::size_t i = 0; i < certificate.rows.size(); ++i) {
    const auto& [lattice, atom, of_basis] = certificate.rows[i];
    try {
      if (!has(lattice, atom)) refute("no such atom");
      if (seen[lattice][atom]) refute("the atom's second");
      seen[lattice][atom] = true;
      const CertificateView<D>& view = flight[lattice][atom];
      const Basis<D> basis = read_basis(of_basis, view);
      const Z s1 = dot(view.v, basis.b[0]);
      if (view.across(basis.b[0], s1, basis.b[0], s1) != 0) refute("b_1 is not parallel to v");
      WindowSearch<D>(view, basis, {0, Z(abs(s1))}, Claim<D>{Outcome::never, {}, {}}, budget).run();
    } catch (Refuted& refuted) {
      refuted.why = "rows " + std::to_string(i) + " (" + name_of(lattice, atom) + "): " + refuted.why;
      throw;
    }
  }
  for (std::size_t l = 0; l < seen.size(); ++l)
    for (std::size_t a = 0; a < seen[l].size(); ++a)
      if (!seen[l][a]) refute(name_of(static_cast<int>(l), static_cast<int>(a)) + ": no rows");
}

}  // namespace

struct CertificateCheck::Impl {
  Scene scene;
  std::string flaw;  // of the scene: then there is no check
  std::optional<Check<2>> flat;
  std::optional<Check<3>> solid;
};

CertificateCheck::CertificateCheck(const Scene& scene, long most_steps) {
  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->flaw = flaw_of(scene).value_or("");
  if (impl->flaw.empty()) try {
      if (scene.dimension == 2) impl->flat.emplace(scene, most_steps);
      if (scene.dimension == 3) impl->solid.emplace(scene, most_steps);
    } catch (const Refuted& refuted) {
      impl->flaw = refuted.why;
    }
  impl_ = std::move(impl);
}

CertificateCheck::CertificateCheck(CertificateCheck&&) noexcept = default;
CertificateCheck& CertificateCheck::operator=(CertificateCheck&&) noexcept = default;
CertificateCheck::~CertificateCheck() = default;

std::optional<std::string> CertificateCheck::refutation(const Query& query, const Answer& answer,
                                                        const Certificate& certificate,
                                                        bool* too_long) const {
  if (too_long) *too_long = false;
  if (!impl_->flaw.empty()) return "scene: " + impl_->flaw;
  if (const auto flaw = flaw_of(query, impl_->scene)) return "query: " + *flaw;
  try {
    if (impl_->flat) impl_->flat->check(query, answer, certificate);
    if (impl_->solid) impl_->solid->check(query, answer, certificate);
  } catch (const TooLong& refuted) {
    if (too_long) *too_long = true;
    return refuted.why;
  } catch (const Refuted& refuted) {
    return refuted.why;
  }
  return std::nullopt;
}

}  // namespace lorentz::oracle
