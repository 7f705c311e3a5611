// Checks proofs of answers in integers alone. Notation as in docs/certificates.md: a line x + t v, an
// obstacle's centre w = c - x relative to the start, s = v.w along and h = v x w across. Each atom has its
// own coordinates, in which it is a ball. The unit of all numbers is the largest power of two of which they
// are multiples, so they are integers from here on. Other checkers use the same integers, so all of them
// count the same steps.
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
  Z size() const { return hi - lo + 1; }  ///< of a range that is not empty
  bool contains(const Z& a) const { return lo <= a && a <= hi; }
};

TimeRange intersection(const TimeRange& a, const TimeRange& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The range that factor * a + offset +- slack covers for a in a non-empty range.
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

/// The k with a k^2 + 2 b k + c < 0, for a > 0. Multiplied by a, this is (a k + b)^2 < b^2 - a c.
TimeRange below_zero(const Z& a, const Z& b, const Z& c) {
  const Z square = b * b - a * c;
  if (square <= 0) return {1, 0};
  const Z root = root_below(square);
  return {ceil_div(-b - root, a), floor_div(root - b, a)};
}

/// The steps (docs/certificates.md) that are left for a certificate.
class Budget {
 public:
  Budget(long most, std::size_t pieces) : most_(most), left_(most) {
    constexpr long kStepsOfPiece = 10;
    spend(kStepsOfPiece * Z(static_cast<long>(pieces)));
  }

  void spend(const Z& steps) {
    if (steps > left_) throw Refuted{"takes more than " + std::to_string(most_) + " steps", true};
    left_ -= steps.get_si();
  }

 private:
  long most_, left_;
};

struct Obstacle {
  int lattice, atom, rank;
  ZVec3 n;

  auto key() const { return std::tie(lattice, atom, n); }
  std::string name() const {
    return name_of(lattice, atom, std::span(n).first(static_cast<std::size_t>(rank)));
  }
};

/// The claim: `hit` at a time, `inside`, or `never`.
struct Conclusion {
  Outcome outcome;
  Obstacle obstacle{};
  std::optional<Obstacle> from{};
  ProofTime time{};  // 0 for `inside`

  bool is_from(const Obstacle& other) const { return from && from->key() == other.key(); }

  /// Refutes the claim if an obstacle that the line meets, with d = r^2 v^2 - |h|^2 > 0, contradicts it. The
  /// obstacle contains x iff v^2 w^2 = s^2 + |h|^2 < r^2 v^2, that is s^2 < d. Otherwise the ray enters it
  /// iff s > 0.
  template <class CellOf>
  void hold_against(const CertificateView& view, const Z& s, const Z& d, const CellOf& cell_of) const {
    const bool contains_x = s * s < d, hit = outcome == Outcome::hit;
    int order = -1;
    if (!contains_x) {
      if (outcome == Outcome::inside || s <= 0) return;
      if (hit) order = compare(ProofTime{s, d, view.v2}, time);
      if (order > 0) return;
    }
    const Obstacle other{view.lattice, view.atom, view.rank, cell_of()};
    if (is_from(other)) return;
    const std::string what = contains_x ? " contains x" : " is entered";
    if (outcome == Outcome::never) refute(other.name() + what + ": the outcome is not never");
    if (hit && contains_x) refute(other.name() + what);
    if (hit && order < 0) refute(other.name() + " is entered earlier");
    if (other.key() < obstacle.key())
      refute(other.name() + (hit ? " is entered at the same time" : " contains x, too,") +
             " and comes first");
  }
};

// ---- Windows

/// The s of a window, which may have no upper end.
struct WindowRange {
  Z lo;
  std::optional<Z> hi;

  bool contains(const Z& s) const { return lo <= s && (!hi || s <= *hi); }
  /// The k in the range for which k * divisor + offset is in the window, divisor != 0.
  TimeRange of(TimeRange k, const Z& offset, const Z& divisor) const {
    if (hi) return intersection(k, quotients({lo, *hi}, offset, divisor));
    if (divisor > 0)
      k.lo = std::max(k.lo, ceil_div(lo - offset, divisor));
    else
      k.hi = std::min(k.hi, floor_div(lo - offset, divisor));
    return k;
  }
};

/// Finds all obstacles w = w_0 + k_1 b_1 + k_2 b_2 + k_3 b_3, with the first `rank` of the k free, that are
/// met: those with |h|^2 <= H = r^2 v^2 - 1 and s in the window. Calls met(s, d, n()) for each, with
/// d = r^2 v^2 - |h|^2.
template <class Met>
class Search {
 public:
  Search(const CertificateView& view, const Basis& basis, WindowRange window, Budget& budget, Met met)
      : view_(view), n_(basis.n), b_(basis.b), window_(std::move(window)), budget_(budget), met_(met) {
    most_h2_ = view.rho2 - 1;
    s1_ = dot(view.v, b_[0]), s2_ = dot(view.v, b_[1]);
    h11_ = view.across(b_[0], s1_, b_[0], s1_);
    h12_ = view.across(b_[0], s1_, b_[1], s2_);
    h22_ = view.across(b_[1], s2_, b_[1], s2_);
  }

  /// With N = b_1 x b_2 and e = v x N: (v^2 N.w - s (N.v))^2 <= e^2 H, and N.w = N.w_0 + k_3 N.b_3.
  void run() {
    const ZVec3 normal = cross(b_[0], b_[1]), e = cross(view_.v, normal);
    TimeRange k3{0, 0};
    if (view_.rank == 3) {
      const TimeRange bounds = image(dot(normal, view_.v), ends(), 0, floor_sqrt(most_h2_ * dot(e, e)));
      k3 = quotients(bounds, view_.v2 * dot(normal, view_.w0), view_.v2 * dot(normal, b_[2]));
    }
    if (k3.empty()) return;
    budget_.spend(k3.size());
    for (Z k = k3.lo; k <= k3.hi; ++k) {
      const ZVec3 w = sum(view_.w0, k, b_[2]);
      search_plane(w, k, view_.rank < 2 ? TimeRange{0, 0} : rows_in_plane(w, normal, e));
    }
  }

 private:
  /// The ends of the window, for k that have no other bound.
  TimeRange ends() const {
    if (!window_.hi) refute("has no end, and endless obstacles");
    return {window_.lo, *window_.hi};
  }

  /// The k_2 in the plane through w, with L = N.w:
  ///   v^2 (e.w)^2 + (s (N.v) - v^2 L)^2 = e^2 |h|^2 <= e^2 H,
  /// so v^2 (e.w)^2 <= e^2 H - m^2 for the smallest m = |s (N.v) - v^2 L| in the window. The two equations
  ///   e.w' = e.w + k_1 (e.b_1) + k_2 (e.b_2),  s' = s + k_1 (v.b_1) + k_2 (v.b_2)
  /// have the determinant (e.b_1)(v.b_2) - (e.b_2)(v.b_1) = (e x v).N = e^2, so by Cramer's rule
  ///   e^2 k_2 = (e.b_1)(s' - s) - (v.b_1)(e.w' - e.w), here times v^2.
  /// A second bound is (h_1.w')^2 v^2 <= h_1^2 H, which holds because h_1.v = 0; h_1.b_1 = 0 and
  /// h_1.b_2 = N.v. At least one of e and N.v is not 0.
  TimeRange rows_in_plane(const ZVec3& w, const ZVec3& normal, const ZVec3& e) const {
    const Z along = dot(normal, view_.v), e2 = dot(e, e);
    std::optional<TimeRange> k2;
    if (along != 0) {
      const Z most = floor_sqrt(h11_ * most_h2_ / view_.v2);  // |h_1.w'|
      k2 = quotients({Z(-most), most}, dot(cross(view_.v, b_[0]), w), along);
    }
    if (e2 == 0 || (k2 && !window_.hi)) return *k2;
    const TimeRange off = image(along, ends(), -(view_.v2 * dot(normal, w)), 0);
    const Z m = off.contains(0) ? Z(0) : std::min(Z(abs(off.lo)), Z(abs(off.hi)));
    const Z square = e2 * most_h2_ - m * m;
    if (square < 0) return {1, 0};  // the plane is not reached
    const Z e1 = dot(e, b_[0]), at_w = e1 * dot(view_.v, w) - s1_ * dot(e, w);
    const TimeRange bounds = image(e1 * view_.v2, ends(), 0, floor_sqrt(s1_ * s1_ * view_.v2 * square));
    const TimeRange by_cramer = quotients(bounds, view_.v2 * at_w, view_.v2 * e2);
    return k2 ? intersection(*k2, by_cramer) : by_cramer;
  }

  /// The obstacles w + k_1 b_1 + k_2 b_2 with s in the window and k_2 in the range.
  void search_plane(const ZVec3& w, const Z& k3, const TimeRange& k2) {
    if (k2.empty()) return;
    budget_.spend(k2.size());
    const Z s0 = dot(view_.v, w), h01 = view_.across(w, s0, b_[0], s1_),
            h02 = view_.across(w, s0, b_[1], s2_);
    const Z c0 = view_.across(w, s0, w, s0) - view_.rho2;
    for (Z k = k2.lo; k <= k2.hi; ++k)
      search_row(s0 + k * s2_, h01 + k * h12_, c0 + k * (2 * h02 + k * h22_), k, k3);
  }

  /// The obstacles at w + k_1 b_1, with s0 = v.w, b = h.h_1 and c = |h|^2 - r^2 v^2. They are met iff
  /// h_1^2 k_1^2 + 2 b k_1 + c < 0.
  void search_row(const Z& s0, const Z& b, const Z& c, const Z& k2, const Z& k3) {
    const TimeRange k = obstacles_in_row(s0, b, c);
    if (k.empty()) return;
    budget_.spend(k.size());
    for (Z k1 = k.lo; k1 <= k.hi; ++k1)
      met_(s0 + k1 * s1_, Z(-c - k1 * (2 * b + k1 * h11_)), [&] { return combination({k1, k2, k3}, n_); });
  }

  /// If b_1 is parallel to v, then h_1 = 0 and b = 0, and all are met or none. At least one of h_1 and s_1 is
  /// not 0.
  TimeRange obstacles_in_row(const Z& s0, const Z& b, const Z& c) const {
    const TimeRange none{1, 0};
    if (view_.rank == 0) return c < 0 && window_.contains(s0) ? TimeRange{0, 0} : none;
    if (h11_ == 0) {
      const TimeRange s = ends();
      return c < 0 ? quotients(s, s0, s1_) : none;
    }
    const TimeRange k = below_zero(h11_, b, c);
    if (s1_ != 0) return window_.of(k, s0, s1_);
    return window_.contains(s0) ? k : none;
  }

  const CertificateView& view_;
  const ZMatrix &n_, &b_;
  const WindowRange window_;
  Budget& budget_;
  const Met met_;
  Z most_h2_;                    // H
  Z s1_, s2_, h11_, h12_, h22_;  // s_i = v.b_i, h_ij = (v x b_i).(v x b_j)
};

/// An end of a window: n / 2^bits.
struct End {
  Z n;
  unsigned long bits = 0;

  explicit End(const WindowEnd& end) {
    constexpr long kMost = WindowEnd::kMostExponent;
    if (end.exponent > kMost || end.exponent < -kMost)
      refute("an end has an exponent beyond " + std::to_string(kMost));
    constexpr std::size_t kDecimals = kLongestText * 5 / 4;  // for as many hexadecimal digits
    n = shifted_left(read_integer(end.mantissa, kDecimals),
                     static_cast<unsigned long>(std::max(end.exponent, 0L)));
    bits = static_cast<unsigned long>(std::max(-end.exponent, 0L));
  }

  friend bool operator>(const End& a, const End& b) {
    return shifted_left(a.n, b.bits) > shifted_left(b.n, a.bits);
  }
};

/// How far an atom's windows, in the order in which they are listed, cover the flight without a gap.
class Coverage {
 public:
  /// T = n / 2^bits <= -r/|v| iff n v^2 <= -2^bits r |v|.
  void add(const CertificateView& view, const End& from, const std::optional<End>& to) {
    if (to && from > *to) refute("ends before it begins");
    const Z unit = shifted_left(1, from.bits);
    const bool begins_late = sign_of(-from.n * view.v2, 0, unit * unit * view.rho2) < 0;
    if (begins_late && !reached_ && !endless_) refute("begins too late");
    if (begins_late && !endless_ && from > *reached_) refute("a gap before it");
    endless_ |= !to;
    if (to && (!reached_ || *to > *reached_)) reached_ = to;
  }

  /// Rows cover the flight by themselves; no windows may stand beside them.
  void add_rows() {
    if (endless_ || reached_) refute("the atom has other rows, or windows");
    endless_ = true;
  }

  /// T >= t + r/|v| for the time t = (s - sqrt(d)) / q. Multiplied by q this is
  ///   n v^2 q >= 2^bits (v^2 (s - sqrt(d)) + q r |v|).
  bool reaches(const CertificateView& view, const ProofTime& time) const {
    if (endless_ || !reached_) return endless_;
    const Z unit = shifted_left(1, reached_->bits), factor = unit * view.v2, other = unit * time.q;
    return sign_of(reached_->n * view.v2 * time.q - factor * time.s, factor * factor * time.d,
                   other * other * view.rho2) >= 0;
  }

  bool endless() const { return endless_; }

 private:
  std::optional<End> reached_;
  bool endless_ = false;
};

// ---- The check

class Check {
 public:
  Check(const Scene& scene, long most_steps) : most_steps_(most_steps) {
    CommonExponent exponent;
    for (const Lattice& lattice : scene.lattices) {
      for (const Vec& vector : lattice.vectors) see(exponent, vector);
      for (const Atom& atom : lattice.atoms) {
        see(exponent, atom.position);
        if (atom.is_ball()) exponent.see(atom.radius);
        for (const Vec& axis : atom.semiaxes) see(exponent, axis);
      }
    }
    exponent_ = exponent.get();
    for (const Lattice& lattice : scene.lattices) {
      bodies_.emplace_back();
      for (const Atom& atom : lattice.atoms)
        bodies_.back().emplace_back(scene.dimension, lattice, atom, exponent_);
    }
  }

  void check(const Query& query, const Answer& answer, const Certificate& certificate) const {
    const bool never = answer.outcome == Outcome::never;
    if (!never && answer.outcome != Outcome::hit && answer.outcome != Outcome::inside)
      refute("only hit, inside and never have proofs");
    if (!never && !certificate.rows.empty()) refute("rows prove `never` only");
    const Flight flight = flight_of(query);
    const Conclusion claim = claim_of(query, answer, flight);
    std::vector<std::vector<Coverage>> coverage;
    for (const auto& views : flight) coverage.emplace_back(views.size());
    Budget budget(most_steps_, certificate.windows.size() + certificate.rows.size());
    check_pieces("window ", flight, certificate.windows,
                 [&](const CertificateView& view, const Window& window) {
                   check_window(claim, view, window, coverage[view.lattice][view.atom], budget);
                 });
    check_pieces("rows ", flight, certificate.rows, [&](const CertificateView& view, const Rows& rows) {
      check_rows(view, rows, coverage[view.lattice][view.atom], budget);
    });
    for (const auto& views : flight)
      for (const CertificateView& view : views)
        if (!covered(claim, view, coverage[view.lattice][view.atom]))
          refute(name_of(view.lattice, view.atom) + (never ? ": no rows, and no windows without an end"
                                                           : ": no window, or its windows end too early"));
  }

 private:
  /// A query in integers, as each atom sees it.
  using Flight = std::vector<std::vector<CertificateView>>;

  Flight flight_of(const Query& query) const {
    CommonExponent of_query;
    see(of_query, query.x), see(of_query, query.v);
    const long unit = std::min(exponent_, of_query.get());
    const ZVec3 x = scaled_vec(query.x, unit), v = scaled_vec(query.v, unit);
    Flight flight(bodies_.size());
    for (std::size_t l = 0; l < bodies_.size(); ++l)
      for (std::size_t a = 0; a < bodies_[l].size(); ++a)
        flight[l].push_back(view_of(static_cast<int>(l), static_cast<int>(a), x, v, unit));
    return flight;
  }

  CertificateView view_of(int lattice, int atom, const ZVec3& x, const ZVec3& v, long unit) const {
    const Body& body = bodies_[lattice][atom];
    const unsigned long bits = body.bits_of_coordinates(unit),
                        shift = static_cast<unsigned long>(exponent_ - unit);
    CertificateView view{lattice, atom, body.rank, {}, {}, {}, {}, {}};
    view.v = shifted(body.in_own_coordinates(v), bits);
    for (std::size_t i = 0; i < 3; ++i) view.u[i] = shifted(body.u[i], bits + shift);
    view.w0 = sum(shifted(body.p, bits + shift), -1, shifted(body.in_own_coordinates(x), bits));
    view.v2 = dot(view.v, view.v);
    view.rho2 = shifted_left(body.r * body.r, 2 * body.bits_of_radius(unit)) * view.v2;
    return view;
  }

  bool has(int lattice, int atom) const {
    const auto l = static_cast<std::size_t>(lattice), a = static_cast<std::size_t>(atom);  // huge if negative
    return l < bodies_.size() && a < bodies_[l].size();
  }

  Obstacle read_obstacle(const ObstacleId& id) const {
    const int rank = has(id.lattice, id.atom) ? bodies_[id.lattice][id.atom].rank : 3;
    try {
      return {id.lattice, id.atom, rank, read_cell(id.cell, rank)};
    } catch (const Refuted& refuted) {
      refute("a cell " + refuted.why);
    }
  }

  /// Reads the claim, and checks it for the answer's obstacle itself: the obstacle is not `from`, it is
  /// entered at this time or contains x, and it is left at the exit_time, if there is one.
  Conclusion claim_of(const Query& query, const Answer& answer, const Flight& flight) const {
    Conclusion claim{answer.outcome};
    if (query.from) claim.from = read_obstacle(*query.from);
    if (answer.outcome == Outcome::never) return claim;
    const auto& [lattice, atom, cell] = answer.obstacle;
    if (!has(lattice, atom)) refute("the answer's " + name_of(lattice, atom) + " does not exist");
    claim.obstacle = read_obstacle(answer.obstacle);
    const std::string name = "the answer's " + claim.obstacle.name();
    if (claim.is_from(claim.obstacle)) refute(name + " is `from`");
    const CertificateView& view = flight[lattice][atom];
    const ZVec3 w = sum(view.w0, 1, combination(claim.obstacle.n, view.u));
    const Z s = dot(view.v, w), d = view.rho2 - view.across(w, s, w, s);
    if (d <= 0) refute(name + " is not met by the line");
    const bool contains_x = s * s < d;
    if (contains_x != (answer.outcome == Outcome::inside))
      refute(name + (contains_x ? " contains x" : " does not contain x"));
    if (answer.exit_time && !rounds_to(ProofTime{s, d, view.v2, true}, *answer.exit_time))
      refute(name + " is not left at the exit_time given");
    if (contains_x) return claim;
    if (s <= 0) refute(name + " lies behind");
    claim.time = {s, d, view.v2};
    if (!answer.time || !rounds_to(claim.time, *answer.time))
      refute(name + " is not entered at the time given");
    if (!answer.time_decimal.empty() && !rounds_to(claim.time, answer.time_decimal))
      refute(name + " is not entered at the time given in decimal");
    return claim;
  }

  template <class Piece, class Look>
  void check_pieces(const char* kind, const Flight& flight, const std::vector<Piece>& pieces,
                    const Look& look) const {
    for (std::size_t i = 0; i < pieces.size(); ++i) try {
        if (!has(pieces[i].lattice, pieces[i].atom)) refute("no such atom");
        look(flight[pieces[i].lattice][pieces[i].atom], pieces[i]);
      } catch (Refuted& refuted) {
        refuted.why = kind + std::to_string(i) + " (" + name_of(pieces[i].lattice, pieces[i].atom) +
                      "): " + refuted.why;
        throw;
      }
  }

  static void check_window(const Conclusion& claim, const CertificateView& view, const Window& window,
                           Coverage& coverage, Budget& budget) {
    const End from(window.from);
    std::optional<End> to;
    WindowRange range{Z(-(-(from.n * view.v2) >> from.bits)), std::nullopt};
    if (!window.to.infinite) {
      to.emplace(window.to);
      range.hi = Z(to->n * view.v2 >> to->bits);
    }
    coverage.add(view, from, to);
    const Basis basis = read_basis(window.basis, view);
    Search(view, basis, range, budget, [&](const Z& s, const Z& d, const auto& cell_of) {
      claim.hold_against(view, s, d, cell_of);
    }).run();
  }

  /// In a row along v the obstacles are b_1 apart, so if the row is met, one of them has 0 <= s <= |s_1|.
  static void check_rows(const CertificateView& view, const Rows& rows, Coverage& coverage, Budget& budget) {
    coverage.add_rows();
    const Basis basis = read_basis(rows.basis, view);
    const Z s1 = dot(view.v, basis.b[0]);
    if (view.rank == 0 || view.across(basis.b[0], s1, basis.b[0], s1) != 0)
      refute("b_1 is not parallel to v");
    Search(view, basis, WindowRange{0, Z(abs(s1))}, budget, [&](const Z&, const Z&, const auto& cell_of) {
      refute("the line meets " + Obstacle{view.lattice, view.atom, view.rank, cell_of()}.name());
    }).run();
  }

  /// True if every obstacle that could contradict the claim has been looked at.
  static bool covered(const Conclusion& claim, const CertificateView& view, const Coverage& coverage) {
    if (claim.outcome == Outcome::never) return coverage.endless();
    return coverage.reaches(view, claim.time) ||
           (claim.outcome == Outcome::inside &&
            std::tie(view.lattice, view.atom) > std::tie(claim.obstacle.lattice, claim.obstacle.atom));
  }

  long most_steps_, exponent_ = 0;
  std::vector<std::vector<Body>> bodies_;
};

}  // namespace

struct CertificateCheck::Impl {
  Scene scene;
  std::string flaw;  // of the scene; if there is one, there is no check
  std::optional<Check> check;
};

CertificateCheck::CertificateCheck(const Scene& scene, long most_steps) {
  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->flaw = flaw_of(scene).value_or("");
  if (impl->flaw.empty()) try {
      impl->check.emplace(scene, most_steps);
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
    impl_->check->check(query, answer, certificate);
  } catch (const Refuted& refuted) {
    if (too_long) *too_long = refuted.too_long;
    return refuted.why;
  }
  return std::nullopt;
}

}  // namespace lorentz::oracle
