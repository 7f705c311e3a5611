// Checks proofs of answers in integers alone. Notation as in docs/certificates.md: a line x + t v, an
// obstacle's centre w = c - x relative to the start, s = v.w along, h = v x w across. Every atom has
// coordinates of its own, in which it is a ball. All lengths are multiples of 2^l, velocities of 2^m, so
// times are multiples of 2^(l-m): integers from here on.
#include <lorentz/certificate_check.hpp>

#include <tuple>

#include "oracle/certificate/check/certificate_time.hpp"
#include "oracle/certificate/check/certificate_view.hpp"

namespace lorentz::oracle {
namespace {

using namespace certificate;

constexpr long kMaxRows = 1'000'000;  // in a window, or of an atom that is never hit

/// Integers from lo to hi; none if lo > hi.
struct Range {
  Z lo, hi;

  bool empty() const { return lo > hi; }
  bool contains(const Z& a) const { return lo <= a && a <= hi; }
};

Range intersection(const Range& a, const Range& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The range that factor * a + offset, +- slack, lies in for a in a non-empty range.
Range image(const Z& factor, const Range& a, const Z& offset, const Z& slack) {
  const Z one = factor * a.lo, other = factor * a.hi;
  return {Z(std::min(one, other) + offset - slack), Z(std::max(one, other) + offset + slack)};
}

/// The k with k * divisor + offset in the range, divisor != 0.
Range quotients(const Range& a, const Z& offset, const Z& divisor) {
  const Z low = a.lo - offset, high = a.hi - offset;
  if (divisor > 0) return {ceil_div(low, divisor), floor_div(high, divisor)};
  return {ceil_div(high, divisor), floor_div(low, divisor)};
}

/// The k with a k^2 + 2 b k + c < 0, for a > 0: times a this is (a k + b)^2 < b^2 - a c.
Range below_zero(const Z& a, const Z& b, const Z& c) {
  const Z square = b * b - a * c;
  if (square <= 0) return {1, 0};
  const Z root = root_below(square);
  return {ceil_div(-b - root, a), floor_div(root - b, a)};
}

/// What may still be spent on a certificate: on windows, planes, rows and obstacles.
class Budget {
 public:
  explicit Budget(long most) : most_(most), left_(most) {}

  void spend(const Z& steps) {
    if (steps > left_)
      refute("more than " + std::to_string(most_) + " rows and obstacles to look at, with those before");
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

/// What is claimed: `hit` at a time, or `inside`.
template <std::size_t D>
struct Claim {
  bool hit;
  Obstacle<D> obstacle;
  std::optional<Obstacle<D>> from;
  Time time;  // of `inside`: 0

  bool is_from(const Obstacle<D>& other) const { return from && from->key() == other.key(); }

  /// Refutes if an obstacle that is met, with d = r^2 v^2 - |h|^2 > 0, contradicts the claim. It contains x
  /// iff v^2 w^2 = s^2 + |h|^2 < r^2 v^2, that is s^2 < d; else the ray enters it iff s > 0.
  template <class CellOf>
  void hold_against(const View<D>& view, const Z& s, const Z& d, const CellOf& cell_of) const {
    const bool contains_x = s * s < d;
    int order = -1;
    if (!contains_x) {
      if (!hit || s <= 0) return;
      order = compare(Time{s, d, view.v2}, time);
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
/// |h|^2 < r^2 v^2, and holds them against the claim.
template <std::size_t D>
class WindowSearch {
 public:
  WindowSearch(const View<D>& view, const Basis<D>& basis, const Range& s, const Claim<D>& claim,
               Budget& budget)
      : view_(view), basis_(basis), b_(basis.b), window_(s), claim_(claim), budget_(budget) {
    s1_ = dot(view.v, b_[0]), s2_ = dot(view.v, b_[1]);
    h11_ = view.across(b_[0], s1_, b_[0], s1_);
    h12_ = view.across(b_[0], s1_, b_[1], s2_);
    h22_ = view.across(b_[1], s2_, b_[1], s2_);
  }

  void run();

 private:
  void spend_rows(const Range& k) {
    const Z count = k.hi - k.lo + 1;
    rows_ += count;
    if (rows_ > kMaxRows) refute("more than " + std::to_string(kMaxRows) + " rows");
    budget_.spend(count);
  }

  /// The obstacles w + k_1 b_1 + k_2 b_2 with s in the range and k_2 in the other.
  void search_plane(const ZVec<D>& w, const Z& k3, const Range& s, const Range& k2) {
    if (k2.empty()) return;
    spend_rows(k2);
    const Z s0 = dot(view_.v, w), h01 = view_.across(w, s0, b_[0], s1_),
            h02 = view_.across(w, s0, b_[1], s2_);
    const Z c0 = view_.across(w, s0, w, s0) - view_.rho2;
    for (Z k = k2.lo; k <= k2.hi; ++k)
      search_row(s0 + k * s2_, h01 + k * h12_, c0 + k * (2 * h02 + k * h22_), s, k, k3);
  }

  /// The obstacles at w + k_1 b_1, with s0 = v.w, b = h.h_1 and c = |h|^2 - r^2 v^2, which are met iff
  /// h_1^2 k_1^2 + 2 b k_1 + c < 0. If b_1 is parallel to v then h_1 = 0 and b = 0, and all or none are met.
  /// h_1 and s_1 are not both 0.
  void search_row(const Z& s0, const Z& b, const Z& c, const Range& s, const Z& k2, const Z& k3) {
    Range k;
    if (h11_ == 0) {
      if (c >= 0) return;
      k = quotients(s, s0, s1_);
    } else {
      k = below_zero(h11_, b, c);
      if (s1_ != 0)
        k = intersection(k, quotients(s, s0, s1_));
      else if (!s.contains(s0))
        return;
    }
    if (k.empty()) return;
    budget_.spend(k.hi - k.lo + 1);
    for (Z k1 = k.lo; k1 <= k.hi; ++k1)
      claim_.hold_against(view_, s0 + k1 * s1_, -c - k1 * (2 * b + k1 * h11_), [&] {
        ZVec<D> coefficients{k1, k2};
        if constexpr (D == 3) coefficients[2] = k3;
        return combination(coefficients, basis_.n);
      });
  }

  void search_plane_3d(const ZVec<3>& w, const Z& k3, const ZVec<3>& normal, const ZVec<3>& e,
                       const Z& slack);

  const View<D>& view_;
  const Basis<D>& basis_;
  const ZMatrix<D>& b_;
  const Range& window_;
  const Claim<D>& claim_;
  Budget& budget_;
  Z s1_, s2_, h11_, h12_, h22_;  // s_i = v.b_i, h_ij = (v x b_i).(v x b_j)
  Z rows_ = 0;
};

/// With v' = v turned by a right angle, v^2 w = s v + h v'; cross(b_1, v') = b_1.v = s_1, so
/// v^2 cross(b_1, w) = s cross(b_1, v) + h s_1, where |h| <= R, the largest integer below r |v|.
template <>
void WindowSearch<2>::run() {
  const Z slack = root_below(view_.rho2) * abs(s1_);
  const Range bounds = image(cross(b_[0], view_.v), window_, 0, slack);
  const Range k2 = quotients(bounds, view_.v2 * cross(b_[0], view_.w0), view_.v2 * cross(b_[0], b_[1]));
  search_plane(view_.w0, 0, window_, k2);
}

/// The plane through w, with L = N.w. What is met has |s (N.v) - v^2 L| <= slack, which narrows the window;
/// and
///   v^2 (e.w)^2 + (s (N.v) - v^2 L)^2 = e^2 |h|^2 < e^2 r^2 v^2,
/// so v^2 (e.w)^2 < e^2 r^2 v^2 - m^2 for the smallest m = |s (N.v) - v^2 L| in the window. The two equations
///   e.w' = e.w + k_1 (e.b_1) + k_2 (e.b_2),  s' = s + k_1 (v.b_1) + k_2 (v.b_2)
/// have the determinant (e.b_1)(v.b_2) - (e.b_2)(v.b_1) = (e x v).N = e^2, so by Cramer's rule
///   e^2 k_2 = (e.b_1)(s' - s) - (v.b_1)(e.w' - e.w).
template <>
void WindowSearch<3>::search_plane_3d(const ZVec<3>& w, const Z& k3, const ZVec<3>& normal, const ZVec<3>& e,
                                      const Z& slack) {
  const Z along = dot(normal, view_.v), v2_l = view_.v2 * dot(normal, w), e2 = dot(e, e);
  Range s = window_;
  if (along != 0) s = intersection(s, quotients({Z(v2_l - slack), Z(v2_l + slack)}, 0, along));
  if (s.empty()) return;
  const Range off = image(along, s, -v2_l, 0);
  const Z m = off.contains(0) ? Z(0) : std::min(Z(abs(off.lo)), Z(abs(off.hi)));
  const Z square = e2 * view_.rho2 - m * m;         // above 0, for m <= slack
  const Z y = floor_sqrt((square - 1) / view_.v2);  // the largest |e.w'|
  const Z e1 = dot(e, b_[0]);
  const Z offset = s1_ * dot(e, w) - e1 * dot(view_.v, w);
  search_plane(w, k3, s, quotients(image(e1, s, offset, abs(s1_) * y), 0, e2));
}

/// With N = b_1 x b_2 and e = v x N: |v^2 N.w - s (N.v)| < r |v| |e|, and N.w = N.w_0 + k_3 N.b_3.
template <>
void WindowSearch<3>::run() {
  const ZVec<3> normal = cross(b_[0], b_[1]), e = cross(view_.v, normal);
  const Z e2 = dot(e, e);
  if (e2 == 0) refute("b_1 and b_2 are both at right angles to v: another order of the basis is needed");
  const Z slack = root_below(view_.rho2 * e2);
  const Range bounds = image(dot(normal, view_.v), window_, 0, slack);
  const Range k3 = quotients(bounds, view_.v2 * dot(normal, view_.w0), view_.v2 * dot(normal, b_[2]));
  if (k3.empty()) return;
  spend_rows(k3);
  for (Z k = k3.lo; k <= k3.hi; ++k) search_plane_3d(sum(view_.w0, k, b_[2]), k, normal, e, slack);
}

/// The ends of a window, as integer multiples of a time unit common to all windows.
struct Ends {
  Z from, to;
};

/// All windows' ends in the unit 2^(time_exponent - bits), bits >= 0.
struct Timeline {
  std::vector<Ends> windows;
  unsigned long bits = 0;

  Timeline(const std::vector<Window>& given, long time_exponent);

  /// The integers s = T v^2 within the window.
  Range along(const Ends& ends, const Z& v2) const {
    Range s;
    s.lo = -(-(ends.from * v2) >> bits);
    s.hi = ends.to * v2 >> bits;
    return s;
  }
};

std::string place_of(const Window& window, std::size_t index) {
  return "window " + std::to_string(index) + " (" + name_of(window.lattice, window.atom) + "): ";
}

Dyadic read_end(const WindowEnd& end) {
  constexpr long kMost = WindowEnd::kMostExponent;
  if (std::labs(end.exponent) > kMost) refute("an end has an exponent beyond " + std::to_string(kMost));
  return {read_integer(end.mantissa), end.exponent};
}

Timeline::Timeline(const std::vector<Window>& given, long time_exponent) {
  std::vector<std::pair<Dyadic, Dyadic>> ends(given.size());
  long exponent = time_exponent;
  for (std::size_t i = 0; i < given.size(); ++i) try {
      ends[i] = {read_end(given[i].from), read_end(given[i].to)};
      exponent = std::min({exponent, ends[i].first.exponent, ends[i].second.exponent});
    } catch (Refuted& refuted) {
      refute(place_of(given[i], i) + refuted.why);
    }
  bits = static_cast<unsigned long>(time_exponent - exponent);
  for (const auto& [from, to] : ends)
    windows.push_back({shifted_left(from.mantissa, from.exponent - exponent),
                       shifted_left(to.mantissa, to.exponent - exponent)});
}

// ---- The check

template <std::size_t D>
class Check {
 public:
  Check(const Scene& scene, long most_work) : most_work_(most_work) {
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
    const Claim<D> claim = claim_of(query, answer, flight);
    check_windows(claim, flight, certificate.windows);
  }

 private:
  /// A query in integers: as each atom sees it.
  struct Flight {
    long time_exponent;
    std::vector<std::vector<View<D>>> views;
  };

  Flight flight_of(const Query& query) const;
  bool has(int lattice, int atom) const {
    const auto l = static_cast<std::size_t>(lattice), a = static_cast<std::size_t>(atom);  // huge if negative
    return l < bodies_.size() && a < bodies_[l].size();
  }
  Claim<D> claim_of(const Query& query, const Answer& answer, const Flight& flight) const;
  void check_never(const Flight& flight, const Certificate& certificate) const;
  void check_windows(const Claim<D>& claim, const Flight& flight, const std::vector<Window>& windows) const;

  long most_work_, exponent_ = 0;
  std::vector<std::vector<Body<D>>> bodies_;
};

template <std::size_t D>
typename Check<D>::Flight Check<D>::flight_of(const Query& query) const {
  for (std::size_t i = D; i < 3; ++i)
    if (query.x[i] != 0 || query.v[i] != 0) refute("the query has a third coordinate in two dimensions");
  CommonExponent length, velocity;
  see<D>(length, query.x), see<D>(velocity, query.v);
  const long length_exponent = query.x == Vec{} ? exponent_ : std::min(exponent_, length.get());
  const auto shift = static_cast<unsigned long>(exponent_ - length_exponent);
  const ZVec<D> x = scaled_vec<D>(query.x, length_exponent), v = scaled_vec<D>(query.v, velocity.get());
  Flight flight{length_exponent - velocity.get(), {}};
  for (std::size_t l = 0; l < bodies_.size(); ++l) {
    flight.views.emplace_back();
    for (std::size_t a = 0; a < bodies_[l].size(); ++a) {
      const Body<D>& body = bodies_[l][a];
      View<D> view{static_cast<int>(l), static_cast<int>(a), {}, {}, body.in_own_coordinates(v), {}, {}};
      for (std::size_t i = 0; i < D; ++i) view.u[i] = shifted(body.u[i], shift);
      view.w0 = sum(shifted(body.p, shift), -1, body.in_own_coordinates(x));
      view.v2 = dot(view.v, view.v);
      view.rho2 = shifted_left(body.r * body.r, 2 * shift) * view.v2;
      flight.views.back().push_back(std::move(view));
    }
  }
  return flight;
}

/// The claim about the answer's obstacle itself: it is no `from`, and is entered at this time, or contains x.
template <std::size_t D>
Claim<D> Check<D>::claim_of(const Query& query, const Answer& answer, const Flight& flight) const {
  const auto& [lattice, atom, cell] = answer.obstacle;
  if (!has(lattice, atom)) refute("the answer's " + name_of(lattice, atom) + " does not exist");
  Claim<D> claim{answer.outcome == Outcome::hit, {lattice, atom, {}}, {}, {}};
  try {
    claim.obstacle.n = read_cell<D>(cell);
    if (query.from)
      claim.from = Obstacle<D>{query.from->lattice, query.from->atom, read_cell<D>(query.from->cell)};
  } catch (const Refuted& refuted) {
    refute("a cell " + refuted.why);
  }
  const std::string name = "the answer's " + claim.obstacle.name();
  if (claim.is_from(claim.obstacle)) refute(name + " is `from`");
  const View<D>& view = flight.views[lattice][atom];
  const ZVec<D> w = sum(view.w0, 1, combination(claim.obstacle.n, view.u));
  const Z s = dot(view.v, w), d = view.rho2 - view.across(w, s, w, s);
  if (d <= 0) refute(name + " is not met by the line");
  const bool contains_x = s * s < d;
  if (contains_x != (answer.outcome == Outcome::inside))
    refute(name + (contains_x ? " contains x" : " does not contain x"));
  if (!claim.hit) return claim;
  if (s <= 0) refute(name + " lies behind");
  claim.time = {s, d, view.v2};
  const ScaledTime exact{claim.time, flight.time_exponent};
  if (!answer.time || !rounds_to(exact, *answer.time)) refute(name + " is not entered at the time given");
  if (!answer.time_decimal.empty() && !rounds_to(exact, answer.time_decimal))
    refute(name + " is not entered at the time given in decimal");
  return claim;
}

/// Do an atom's windows, in this order, cover -r/|v| <= T <= t + r/|v|, t the claimed time? With T = n /
/// 2^bits and t = (s - sqrt(d)) / q: n v^2 <= -2^bits r |v| at the one end; at the other, times q, n v^2 q >=
/// 2^bits (v^2 (s - sqrt(d)) + q r |v|).
template <std::size_t D>
void check_coverage(const Claim<D>& claim, const View<D>& view, const Timeline& timeline,
                    const std::vector<std::size_t>& windows) {
  const std::string name = name_of(view.lattice, view.atom) + ": ";
  if (windows.empty()) refute(name + "no window");
  const Ends& first = timeline.windows[windows.front()];
  const Z unit = shifted_left(1, timeline.bits);
  if (sign_of(-first.from * view.v2, 0, unit * unit * view.rho2) < 0)
    refute(name + "its first window begins too late");
  Z reached = first.from;
  for (const std::size_t i : windows) {
    const Ends& ends = timeline.windows[i];
    if (ends.from > reached) refute(name + "a gap before window " + std::to_string(i));
    reached = std::max(reached, ends.to);
  }
  const auto& [s, d, q] = claim.time;
  const Z factor = unit * view.v2, other = unit * q;
  if (sign_of(reached * view.v2 * q - factor * s, factor * factor * d, other * other * view.rho2) < 0)
    refute(name + "its windows end too early");
}

template <std::size_t D>
void Check<D>::check_windows(const Claim<D>& claim, const Flight& flight,
                             const std::vector<Window>& windows) const {
  std::vector<std::vector<std::vector<std::size_t>>> of_atom(bodies_.size());
  for (std::size_t l = 0; l < bodies_.size(); ++l) of_atom[l].resize(bodies_[l].size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto& [lattice, atom, from, to, basis] = windows[i];
    if (!has(lattice, atom)) refute(place_of(windows[i], i) + "no such atom");
    of_atom[lattice][atom].push_back(i);
  }
  const Timeline timeline(windows, flight.time_exponent);
  const auto last = std::tie(claim.obstacle.lattice, claim.obstacle.atom);
  for (const auto& views : flight.views)
    for (const View<D>& view : views)
      if (claim.hit || std::tie(view.lattice, view.atom) <= last)
        check_coverage(claim, view, timeline, of_atom[view.lattice][view.atom]);
  Budget budget(most_work_);
  for (std::size_t i = 0; i < windows.size(); ++i) try {
      budget.spend(1);
      const View<D>& view = flight.views[windows[i].lattice][windows[i].atom];
      const Basis<D> basis = read_basis(windows[i].basis, view);
      const Range s = timeline.along(timeline.windows[i], view.v2);
      if (!s.empty()) WindowSearch<D>(view, basis, s, claim, budget).run();
    } catch (const Refuted& refuted) {
      refute(place_of(windows[i], i) + refuted.why);
    }
}

// ---- never

/// The values of k_3 of the rows along v that may lie within r of the line. As b_1 is parallel to v, of all k
/// only k_3 changes q = v.(b_2 x w); and h_2 x h = q v, so v^2 q^2 = |h_2 x h|^2 <= h_2^2 |h|^2 < h_2^2 rho^2
/// with rho = r |v|.
Range planes_near(const View<3>& view, const ZMatrix<3>& b, const Z& h22) {
  const ZVec<3> normal = cross(view.v, b[1]);  // v.(b_2 x w) = (v x b_2).w
  const Z most = floor_sqrt((h22 * view.rho2 - 1) / view.v2);
  return quotients({Z(-most), most}, dot(normal, view.w0), dot(normal, b[2]));
}

Range planes_near(const View<2>&, const ZMatrix<2>&, const Z&) {
  return {0, 0};
}

/// Refutes if the line meets an obstacle of an atom whose lattice has b_1 parallel to v: if
/// |h_0 + k_3 h_3 + k_2 h_2|^2 < r^2 v^2 for any k_2, k_3.
template <std::size_t D>
void check_rows(const Rows& rows, const View<D>& view, Budget& budget) {
  const Basis<D> basis = read_basis(rows.basis, view);
  const ZMatrix<D>& b = basis.b;
  const Z s1 = dot(view.v, b[0]), s2 = dot(view.v, b[1]);
  if (view.across(b[0], s1, b[0], s1) != 0) refute("b_1 is not parallel to v");
  const Z h22 = view.across(b[1], s2, b[1], s2);
  const Range k3 = planes_near(view, b, h22);
  if (k3.hi - k3.lo >= kMaxRows) refute("more than " + std::to_string(kMaxRows) + " rows");
  if (!k3.empty()) budget.spend(k3.hi - k3.lo + 1);
  for (Z k = k3.lo; k <= k3.hi; ++k) {
    const ZVec<D> w = D == 2 ? view.w0 : sum(view.w0, k, b[D - 1]);
    const Z s = dot(view.v, w);
    const Range k2 = below_zero(h22, view.across(w, s, b[1], s2), view.across(w, s, w, s) - view.rho2);
    if (k2.empty()) continue;
    ZVec<D> coefficients{0, k2.lo};
    if constexpr (D == 3) coefficients[2] = k;
    refute("the line meets " + name_of(view.lattice, view.atom, combination(coefficients, basis.n)));
  }
}

template <std::size_t D>
void Check<D>::check_never(const Flight& flight, const Certificate& certificate) const {
  if (!certificate.windows.empty()) refute("windows do not prove `never`");
  Budget budget(most_work_);
  std::vector<std::vector<bool>> seen(bodies_.size());
  for (std::size_t l = 0; l < bodies_.size(); ++l) seen[l].resize(bodies_[l].size());
  for (std::size_t i = 0; i < certificate.rows.size(); ++i) {
    const Rows& rows = certificate.rows[i];
    const std::string name = "rows " + std::to_string(i) + " (" + name_of(rows.lattice, rows.atom) + "): ";
    if (!has(rows.lattice, rows.atom)) refute(name + "no such atom");
    if (seen[rows.lattice][rows.atom]) refute(name + "the atom's second");
    seen[rows.lattice][rows.atom] = true;
    try {
      check_rows(rows, flight.views[rows.lattice][rows.atom], budget);
    } catch (const Refuted& refuted) {
      refute(name + refuted.why);
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

CertificateCheck::CertificateCheck(const Scene& scene, long most_work) {
  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->flaw = flaw_of(scene).value_or("");
  if (impl->flaw.empty()) try {
      if (scene.dimension == 2) impl->flat.emplace(scene, most_work);
      if (scene.dimension == 3) impl->solid.emplace(scene, most_work);
    } catch (const Refuted& refuted) {
      impl->flaw = refuted.why;
    }
  impl_ = std::move(impl);
}

CertificateCheck::CertificateCheck(CertificateCheck&&) noexcept = default;
CertificateCheck& CertificateCheck::operator=(CertificateCheck&&) noexcept = default;
CertificateCheck::~CertificateCheck() = default;

std::optional<std::string> CertificateCheck::refutation(const Query& query, const Answer& answer,
                                                        const Certificate& certificate) const {
  if (!impl_->flaw.empty()) return "scene: " + impl_->flaw;
  if (const auto flaw = flaw_of(query, impl_->scene)) return "query: " + *flaw;
  try {
    if (impl_->flat) impl_->flat->check(query, answer, certificate);
    if (impl_->solid) impl_->solid->check(query, answer, certificate);
  } catch (const Refuted& refuted) {
    return refuted.why;
  }
  return std::nullopt;
}

}  // namespace lorentz::oracle
