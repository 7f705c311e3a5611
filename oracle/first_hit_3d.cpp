// First hit in 3D, on any lattice.
//
// The flight is cut into windows of s = v.c. A window's piece of the cylinder |h| < rho is made round by
// scaling (4^j |h|^2 + s^2 for a window of about 2^(j+1) rho), and the basis (b1, b2, b3) is reduced under
// that form. Then
//   1. the planes k3 = const that meet the piece are found from the cylinder's own support: few, or the
//      window is cut; none, and the flight jumps to the s at which the next plane comes within reach;
//   2. in each plane the section of the cylinder (a strip or an ellipse, however slender) is a 2D problem
//      with windows and a scaling of its own: rows k2 = const, few of them, or the window is cut;
//   3. each row is solved exactly and as a whole (offer_first_on_row).
// Windows grow while nothing is met, so the work is logarithmic in the flight. The bounds in 1 and 2 are
// integers rounded outwards, so no obstacle is left out whatever basis the reduction came up with.
//
// Never: v is parallel to the planes, and no plane within reach, or only rows along v that miss.
#include "first_hit.hpp"
#include "short_basis.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kMany = 8;  // so many planes or rows in a window mean that it surely holds an obstacle

// A lattice vector with its s.
struct WindowVector {
  LatticePoint<3> point;
  Z s;

  void add_multiple(const Z& k, const WindowVector& other) {
    point.add_multiple(k, other.point);
    mpz_addmul(s.get_mpz_t(), k.get_mpz_t(), other.s.get_mpz_t());
  }
};

// 4^j |h|^2 + s^2 = 4^j v^2 p.p - (4^j - 1) s^2.
class WindowForm {
 public:
  WindowForm(const Flight<3>& flight, long j)
      : whole_(shifted_left(flight.v2, 2 * j)), along_(shifted_left(1, 2 * j) - 1) {}
  Z operator()(const WindowVector& a, const WindowVector& b) const {
    return whole_ * dot(a.point.p, b.point.p) - along_ * (a.s * b.s);
  }

 private:
  Z whole_, along_;
};

// By how many halvings to cut a window with too many rows (dimension 2) or planes (3): n of them mean some
// n^dimension obstacles. If that is too much, the windows grow again.
long cut_for(const Z& count, long dimension) {
  return std::max(1L, dimension * (bit_length(count / kMany) - 1));
}

// min and max of a and b.
std::pair<Z, Z> ordered(const Z& a, const Z& b) {
  return a <= b ? std::pair(a, b) : std::pair(b, a);
}

struct Range {
  Z first, last;  // empty if first > last
  bool empty() const { return first > last; }
  Z count() const { return last - first + 1; }
};

// The k with low <= k gap <= high, for gap != 0.
Range multiples_between(const Z& low, const Z& high, const Z& gap) {
  return gap > 0 ? Range{ceil_div(low, gap), floor_div(high, gap)}
                 : Range{ceil_div(high, gap), floor_div(low, gap)};
}

// A vector in coordinates of its lattice plane: y across the flight, z along it.
struct PlanePoint {
  LatticePoint<3> point;
  Z y, z;

  void add_multiple(const Z& k, const PlanePoint& other) {
    point.add_multiple(k, other.point);
    y += k * other.y;
    z += k * other.z;
  }
};

// (2^across y)^2 + (2^along z)^2.
struct PlaneForm {
  long across = 0, along = 0;
  Z operator()(const PlanePoint& a, const PlanePoint& b) const {
    return shifted_left(a.y * b.y, 2 * across) + shifted_left(a.z * b.z, 2 * along);
  }
};

// The planes spanned by b1 and b2. N = b1 x b2 is normal to them, e = v x N across the flight within them. In
// the plane N.c = level, a centre at s that is met has |a s - v^2 level| < rho |e|, a = N.v, and more exactly
//   v^2 (e.c)^2 + (a s - v^2 level)^2 < rho^2 |e|^2.
// If v is normal to the planes, e = 0 and s is constant in them; then y and z are two directions at right
// angles, e = b1 and v x b1, and the same inequality holds with z for a s - v^2 level.
struct Planes {
  std::array<WindowVector, 3> basis;
  ZVec<3> normal, e, f;
  Z a, gap;
  Z reach2;           // rho^2 |v x N|^2
  Z reach;            // its root, rounded down: enough for integers that are less
  bool head_on;       // v is normal to the planes
  Z across2, across;  // rho^2 |e|^2 with the e in use, and its root

  Planes(const Search<3>& search, const std::array<WindowVector, 3>& reduced) : basis(reduced) {
    const Flight<3>& flight = search.flight;
    normal = cross(basis[0].point.p, basis[1].point.p);
    a = dot(normal, flight.v);
    gap = dot(normal, basis[2].point.p);
    e = cross(flight.v, normal);
    reach2 = search.rho2 * dot(e, e);
    reach = floor_sqrt(reach2);
    head_on = reach2 == 0;
    if (head_on) {
      e = basis[0].point.p;
      f = cross(flight.v, e);
    }
    across2 = search.rho2 * dot(e, e);
    across = floor_sqrt(across2);
  }
};

class Solver {
 public:
  explicit Solver(const Search<3>& search) : search_(search), rho_above_(search.rho + 1) {}
  void run();

 private:
  // Rows of one plane in the window low <= s <= high.
  struct Section {
    bool empty = true;
    Z low, high;  // where the plane's section of the cylinder lies, within the window
    PlanePoint step, next, start;
    Range rows;
    bool along_rows = false;  // the rows run along v: they are all there is, in this window and beyond
  };

  bool solve_plane(const Planes& planes, const Z& k3, Z low, Z high);
  Section section_of(const Planes& planes, const Z& k3, const Z& low, const Z& high) const;
  void solve_rows(const Section& section);
  void solve_many_rows(const Planes& planes, const Section& section);
  Z jump_beyond(const Planes& planes, const Z& home, const Z& high) const;
  Z limited(const Z& high) const {
    return search_.earliest.found() ? std::min(high, search_.earliest.reach(rho_above_, search_.flight.v2))
                                    : high;
  }

  const Search<3>& search_;
  const Z rho_above_;  // rho rounded up
};

Solver::Section Solver::section_of(const Planes& planes, const Z& k3, const Z& low, const Z& high) const {
  const Flight<3>& flight = search_.flight;
  LatticePoint<3> origin = search_.view.offset;
  origin.add_multiple(k3, planes.basis[2].point);
  const Z level = flight.v2 * dot(planes.normal, origin.p);
  Section section;
  section.low = low;
  section.high = high;
  // Where along the flight |a s - level| <= reach, and the section's half-width there: `room` is
  // rho^2 |e|^2 - (a s - level)^2 at its largest.
  Z room = planes.across2, z_low = -planes.across, z_high = planes.across;
  if (planes.a != 0) {
    const Range s = multiples_between(level - planes.reach, level + planes.reach, planes.a);
    section.low = std::max(low, s.first);
    section.high = std::min(high, s.last);
    if (section.low > section.high) return section;
  }
  if (!planes.head_on) {
    z_low = section.low;
    z_high = section.high;
    const Z at_low = planes.a * z_low - level, at_high = planes.a * z_high - level;
    if (sgn(at_low) * sgn(at_high) > 0) {
      const Z nearest = std::min(abs(at_low), abs(at_high));
      room -= nearest * nearest;
    }
  }
  if (room <= 0) return section;
  const Z half_width = floor_sqrt(floor_div(room, flight.v2));
  const auto in_plane = [&](const LatticePoint<3>& b) {
    return PlanePoint{b, dot(planes.e, b.p), planes.head_on ? dot(planes.f, b.p) : dot(flight.v, b.p)};
  };
  section.start = in_plane(origin);
  const long scale = bit_length(z_high - z_low) - bit_length(half_width) - 1;
  std::array<PlanePoint, 2> pair{in_plane(planes.basis[0].point), in_plane(planes.basis[1].point)};
  reduce(pair, PlaneForm{std::max(scale, 0L), std::max(-scale, 0L)});
  section.step = std::move(pair[0]);
  section.next = std::move(pair[1]);
  // A point at (y, z) stands in row k2 = (y1 (z - z0) - z1 (y - y0)) / (y1 z2 - z1 y2).
  const PlanePoint &g1 = section.step, &g2 = section.next;
  const auto [least, most] = ordered(g1.y * z_low, g1.y * z_high);
  const Z spread = abs(g1.z) * half_width;
  const Z home = g1.y * section.start.z - g1.z * section.start.y;
  section.rows = multiples_between(least - spread - home, most + spread - home, g1.y * g2.z - g1.z * g2.y);
  section.along_rows = !planes.head_on && g1.y == 0 && planes.a == 0;
  section.empty = false;
  return section;
}

void Solver::solve_rows(const Section& section) {
  for (Z k = section.rows.first; k <= section.rows.last; ++k) {
    LatticePoint<3> row = section.start.point;
    row.add_multiple(k, section.next.point);
    offer_first_on_row(search_, row, section.step.point);
  }
}

// The entry that a ball at the best real place of the row would have, t v^2 = (s - sqrt(d)) / q; nothing if
// the row misses the cylinder. With A, B, M as in exact_line.cpp it is (A s0 - B sg - sqrt(strip M)) / A.
struct RealEntry {
  Z s, d, q;
};

std::optional<RealEntry> real_entry(const Search<3>& search, const LatticePoint<3>& start,
                                    const LatticePoint<3>& step) {
  const Row<3> row(search.flight, start, step);
  const Z strip = row.B * row.B - row.A * (row.C - search.rho2);
  if (row.A == 0 || strip <= 0) return std::nullopt;
  return RealEntry{row.A * row.s0 - row.B * row.sg, strip * search.flight.v2 * row.gg, row.A};
}

int compare(const RealEntry& a, const RealEntry& b) {
  return compare_entries(a.s, a.d, a.q, b.s, b.d, b.q);
}

// A plane so dense with obstacles (r many times their spacing) that even the shortest window has many rows.
// The real entry is convex in the row number, so start where the ball touches the plane and go both ways,
// until it comes after the earliest entry found and grows.
void Solver::solve_many_rows(const Planes& planes, const Section& section) {
  const Flight<3>& flight = search_.flight;
  // The touching point has y = 0, and (for a > 0) s = (level - r |N| v^2) / a + r a / |N|. Rounding here
  // costs time only; but the right row is one of many, and |N| can be a small integer, so its root gets bits
  // behind the point.
  Z z = 0;
  if (!planes.head_on) {
    const long bits = 64 + bit_length(section.rows.count());
    const Z root = floor_sqrt(shifted_left(dot(planes.normal, planes.normal), 2 * bits)) + 1;
    const Z level = flight.v2 * dot(planes.normal, section.start.point.p);
    const Z r = search_.view.radius;
    z = floor_div(shifted_left(level, bits) - sgn(planes.a) * r * root * flight.v2,
                  shifted_left(planes.a, bits)) +
        shifted_left(r * abs(planes.a), bits) / root;
  }
  const PlanePoint &g1 = section.step, &g2 = section.next;
  const Z across = g1.y * (z - section.start.z) + g1.z * section.start.y;
  Z centre = floor_div(across, g1.y * g2.z - g1.z * g2.y);
  centre = std::min(std::max(centre, section.rows.first), section.rows.last);
  for (const int direction : {+1, -1}) {
    std::optional<RealEntry> previous;
    for (Z k = direction > 0 ? centre : Z(centre - 1); k >= section.rows.first && k <= section.rows.last;
         k += direction) {
      LatticePoint<3> row = section.start.point;
      row.add_multiple(k, section.next.point);
      const std::optional<RealEntry> entry = real_entry(search_, row, section.step.point);
      if (entry && search_.earliest.found()) {
        const Entry<3>& best = search_.earliest.entry();
        const bool after_best = compare(*entry, RealEntry{best.s, best.d, 1}) > 0;
        if (after_best && previous && compare(*entry, *previous) >= 0) break;
      }
      previous = entry;
      offer_first_on_row(search_, row, section.step.point);
    }
  }
}

// Returns true if the plane holds no more than what was found, at any s.
bool Solver::solve_plane(const Planes& planes, const Z& k3, Z low, Z high) {
  const Z shortest = 2 * rho_above_;
  Z length = high - low;
  while (low <= (high = limited(high))) {
    const Z end = std::min(high, Z(low + length));
    const Section section = section_of(planes, k3, low, end);
    const bool few = !section.empty && section.rows.count() <= kMany;
    if (section.empty) {
      if (planes.a == 0) return true;
    } else if (!few && !planes.head_on && section.high - section.low > shortest) {
      low = section.low;
      length = std::max(rho_above_, Z((section.high - section.low) >> cut_for(section.rows.count(), 2)));
      continue;
    } else if (!few && planes.a != 0) {
      solve_many_rows(planes, section);
    } else {
      solve_rows(section);
      if (section.along_rows) return true;
    }
    low = end + 1;
    length *= 2;
  }
  return false;
}

// The first s beyond the window at which a plane comes within reach, for a != 0.
Z Solver::jump_beyond(const Planes& planes, const Z& home, const Z& high) const {
  const int sign = sgn(planes.a);
  const Z a = abs(planes.a), start = sign * home, gap = abs(planes.gap) * search_.flight.v2;
  // Planes stand at the levels start + k gap, and level k comes within reach at a s + reach >= level.
  const Z k = ceil_div(a * high + planes.reach + 1 - start, gap);
  return std::max(Z(high + 1), ceil_div(start + k * gap - planes.reach, a));
}

void Solver::run() {
  const Flight<3>& flight = search_.flight;
  const View<3>& view = search_.view;
  std::array<WindowVector, 3> basis;
  for (int i = 0; i < 3; ++i) basis[i] = {view.basis[i], dot(flight.v, view.basis[i].p)};
  // A window of about one free path, volume / (pi r^2).
  long j = std::max(0L, bit_length(determinant<3>(view.basis)) - 3 * bit_length(view.radius) - 1);
  Z low = 1;
  // After each empty window the next is longer, and by a growing factor: from the edge of a slender section
  // (a plane grazed at a slope of 2^-60) to its first obstacle it can be 2^30 first windows.
  long growth = 1;
  for (;;) {
    const Z high = limited(low + shifted_left(rho_above_, j + 1) + rho_above_);
    if (high < low) return;
    reduce(basis, WindowForm(flight, j));
    const Planes planes(search_, basis);
    const Z home = flight.v2 * dot(planes.normal, view.offset.p);
    const auto [least, most] = ordered(planes.a * low, planes.a * high);
    const Range levels =
        multiples_between(least - planes.reach - home, most + planes.reach - home, planes.gap * flight.v2);
    if (levels.count() > kMany && j > 0) {
      j = std::max(0L, j - cut_for(levels.count(), 3));
      continue;
    }
    if (levels.empty()) {
      if (planes.a == 0) return;
      low = jump_beyond(planes, home, high);
    } else {
      bool exhausted = planes.a == 0;
      for (Z k3 = levels.first; k3 <= levels.last; ++k3) exhausted &= solve_plane(planes, k3, low, high);
      if (exhausted) return;
      low = high + 1;
    }
    j += growth++;
  }
}

}  // namespace

void search_first_hit(const Search<3>& search) {
  Solver(search).run();
}

}  // namespace lorentz::oracle
