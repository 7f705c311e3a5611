// First hit in 3D, on any lattice.
//
// The flight is cut into windows of s = v.c. A window's piece of the cylinder |h| < rho is made round by
// scaling (4^j |h|^2 + s^2 for a window of about 2^(j+1) rho), and the basis (b1, b2, b3) is reduced under
// that form. Then
//   1. The planes k3 = const that meet the piece are found from the cylinder's support function. If they are
//      many, the window is cut. If there are none, the flight jumps to the s at which the next plane comes
//      within reach.
//   2. In each plane the section of the cylinder (a strip or an ellipse, however slender) is a 2D problem
//      with windows and a scaling of its own, in rows k2 = const. If they are many, the window is cut.
//   3. Each row is solved exactly and as a whole (RowsInSpace).
// Windows grow while nothing is met, so the work is logarithmic in the length of the flight. The bounds in 1
// and 2 are integers rounded outwards, so no obstacle is left out, whatever basis the reduction finds.
//
// The flight never hits if v is parallel to the planes, and no plane is within reach or all rows in them run
// along v and miss.
#include <lorentz/answer.hpp>

#include "oracle/exact/planes.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/first_hit/first_hit.hpp"
#include "oracle/first_hit/window_basis.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kMany = 8;  // a window with more planes or rows than this surely holds an obstacle

// The number of halvings by which to cut a window with too many rows (dimension 2) or planes (dimension 3):
// `count` of them mean about count^dimension obstacles. If this cuts too much, the windows grow again.
long cut_for(const Z& count, long dimension) {
  return std::max(1L, dimension * (bit_length(count / kMany) - 1));
}

class Solver {
 public:
  explicit Solver(const Search<3>& search) : search_(search), rho_above_(search.rho + 1) {}
  void run();

 private:
  // The cylinder's section by one plane in the window low <= s <= high, and its rows.
  struct Section : PlaneSection {
    PlanePoint step, next;
    Range rows;
    bool along_rows = false;  // the rows run along v, and are all rows of the plane in this window and beyond
  };

  // The planes of b1 and b2, and these two vectors in coordinates of the plane.
  struct PlaneFamily {
    Planes planes;
    std::array<PlanePoint, 2> pair;
    PlaneFamily(const Search<3>& search, const WindowBasis& basis)
        : planes(search.velocity, search.rho2, basis[0], basis[1], basis[2]),
          pair{planes.in_plane(basis[0]), planes.in_plane(basis[1])} {}
  };

  bool solve_plane(const PlaneFamily& family, const Z& k3, Z low, Z high);
  Section section_of(const PlaneFamily& family, const Z& k3, const Z& low, const Z& high) const;
  void solve_rows(const Section& section);
  void solve_many_rows(const Planes& planes, const Section& section);
  Z jump_beyond(const Planes& planes, const Z& high) const;
  Z limited(const Z& high) const {
    return search_.earliest.found() ? std::min(high, search_.earliest.reach(rho_above_, search_.velocity.v2))
                                    : high;
  }

  const Search<3>& search_;
  const Z rho_above_;  // rho rounded up
};

Solver::Section Solver::section_of(const PlaneFamily& family, const Z& k3, const Z& low,
                                   const Z& high) const {
  const Planes& planes = family.planes;
  Section section{planes.section(search_.view.offset, k3, low, high), {}, {}, {}};
  if (section.empty) return section;
  std::array<PlanePoint, 2> pair = family.pair;
  reduce(pair, section.form());
  section.rows = planes.rows(section, pair[0], pair[1]);
  section.along_rows = !planes.head_on && pair[0].y == 0 && planes.a == 0;
  section.step = std::move(pair[0]);
  section.next = std::move(pair[1]);
  return section;
}

void Solver::solve_rows(const Section& section) {
  if (section.rows.empty()) return;
  const RowsInSpace rows(search_, section.step.point);
  LatticePoint<3> row = section.origin;
  row.add_multiple(section.rows.first, section.next.point);
  for (Z k = section.rows.first; k <= section.rows.last; ++k) {
    rows.offer_first(row);
    row.add_multiple(1, section.next.point);
  }
}

// The entry t v^2 = (s - sqrt(d)) / q that a ball at the best real position in the row would have; nothing if
// the row misses the cylinder. With A, B, strip and gg as in exact_line.cpp it is
//   (A s0 - B sg - sqrt(strip gg)) / A.
struct RealEntry {
  Z s, d, q;
};

std::optional<RealEntry> real_entry(const Search<3>& search, const LatticePoint<3>& start,
                                    const LatticePoint<3>& step) {
  const ExactRow<3> row(search.velocity, start, step);
  const Z strip = row.B * row.B - row.A * (row.C - search.rho2);
  if (row.A == 0 || strip <= 0) return std::nullopt;
  return RealEntry{row.A * row.s0 - row.B * row.sg, strip * row.gg, row.A};
}

// An entry in this view's units of time. Another atom's entry may be in other coordinates, with another v^2.
RealEntry as_timed_in(const ExactVelocity<3>& velocity, const ExactEntry<3>& entry) {
  if (entry.v2 == velocity.v2) return {entry.s, entry.d, 1};
  return {entry.s * velocity.v2, entry.d * velocity.v2 * velocity.v2, entry.v2};
}

int compare(const RealEntry& a, const RealEntry& b) {
  return compare_entries(a.s, a.d, a.q, b.s, b.d, b.q);
}

// For a plane so dense with obstacles (r many times their spacing) that even the shortest window has many
// rows. The real entry is convex in the row number. So start where the ball touches the plane, and go both
// ways until the real entry comes after the earliest entry found and grows.
void Solver::solve_many_rows(const Planes& planes, const Section& section) {
  const ExactVelocity<3>& velocity = search_.velocity;
  // The touching point has y = 0, and (for a > 0) s = (level - r |N| v^2) / a + r a / |N|. Rounding costs
  // only time here. But the right row is one of many, and |N| can be a small integer, so its root gets
  // fractional bits.
  Z z = 0;
  if (!planes.head_on) {
    const long bits = 64 + bit_length(section.rows.count());
    const Z root = floor_sqrt(shifted_left(dot(planes.normal, planes.normal), 2 * bits)) + 1;
    const Z level = velocity.v2 * dot(planes.normal, section.origin.p);
    const Z r = search_.view.radius;
    z = floor_div(shifted_left(level, bits) - sgn(planes.a) * r * root * velocity.v2,
                  shifted_left(planes.a, bits)) +
        shifted_left(r * abs(planes.a), bits) / root;
  }
  const PlanePoint &g1 = section.step, &g2 = section.next;
  const PlanePoint start = planes.in_plane(section.origin);
  const Z across = g1.y * (z - start.z) + g1.z * start.y;
  Z centre = floor_div(across, g1.y * g2.z - g1.z * g2.y);
  centre = std::min(std::max(centre, section.rows.first), section.rows.last);
  const RowsInSpace rows(search_, section.step.point);
  for (const int direction : {+1, -1}) {
    std::optional<RealEntry> previous;
    for (Z k = direction > 0 ? centre : Z(centre - 1); k >= section.rows.first && k <= section.rows.last;
         k += direction) {
      LatticePoint<3> row = section.origin;
      row.add_multiple(k, section.next.point);
      const std::optional<RealEntry> entry = real_entry(search_, row, section.step.point);
      if (entry && search_.earliest.found()) {
        const bool after_best = compare(*entry, as_timed_in(velocity, search_.earliest.entry())) > 0;
        if (after_best && previous && compare(*entry, *previous) >= 0) break;
      }
      previous = entry;
      rows.offer_first(row);
    }
  }
}

// Returns true if the plane holds nothing more, at any s.
bool Solver::solve_plane(const PlaneFamily& family, const Z& k3, Z low, Z high) {
  const Planes& planes = family.planes;
  const Z shortest = 2 * rho_above_;
  Z length = high - low;
  while (low <= (high = limited(high))) {
    const Z end = std::min(high, Z(low + length));
    const Section section = section_of(family, k3, low, end);
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
Z Solver::jump_beyond(const Planes& planes, const Z& high) const {
  const Z home = search_.velocity.v2 * dot(planes.normal, search_.view.offset.p);
  const int sign = sgn(planes.a);
  const Z a = abs(planes.a), start = sign * home, gap = abs(planes.gap) * search_.velocity.v2;
  // Planes stand at the levels start + k gap, and level k comes within reach at a s + reach >= level.
  const Z k = ceil_div(a * high + planes.reach + 1 - start, gap);
  return std::max(Z(high + 1), ceil_div(start + k * gap - planes.reach, a));
}

void Solver::run() {
  const ExactVelocity<3>& velocity = search_.velocity;
  const View<3>& view = search_.view;
  WindowBasis basis(velocity, view.basis);
  std::optional<PlaneFamily> family;
  // Start with a window of about one mean free path, volume / (pi r^2).
  long j = std::max(0L, view.volume_bits - 3 * bit_length(view.radius) - 1);
  Z low = 1;
  // After each empty window the next one is longer, by a growing factor. From the edge of a slender section
  // (a plane grazed at a slope of 2^-60) to its first obstacle the distance can be 2^30 times the first
  // window.
  long growth = 1;
  for (;;) {
    const Z high = limited(low + shifted_left(rho_above_, j + 1) + rho_above_);
    if (high < low) return;
    if (basis.shorten(j) || !family) family.emplace(search_, basis);
    const Planes& planes = family->planes;
    const Range levels = planes.levels(view.offset, low, high);
    if (levels.count() > kMany && j > 0) {
      j = std::max(0L, j - cut_for(levels.count(), 3));
      continue;
    }
    if (levels.empty()) {
      if (planes.a == 0) return;
      low = jump_beyond(planes, high);
    } else {
      bool exhausted = planes.a == 0;
      for (Z k3 = levels.first; k3 <= levels.last; ++k3) exhausted &= solve_plane(*family, k3, low, high);
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
