#include "oracle/horizon/shadow.hpp"

#include <algorithm>

#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {
namespace {

// The points offset + i b1 + j b2 with |.|^2 <= radius2.
template <class Visit>
void visit_disc(const std::array<LatticePoint<3>, 2>& basis, const ZVec<3>& along, const ZVec<3>& offset,
                const Z& radius2, Visit visit) {
  const ZVec<3>& b1 = basis[0].p;
  const ZVec<3> across = cross(along, b1);
  const Z b11 = dot(b1, b1), gap = dot(across, basis[1].p), level = dot(across, offset);
  const Z bound = floor_sqrt(radius2 * dot(across, across)), width = abs(gap);
  const Z start = gap > 0 ? level : Z(-level);
  for (Z j = ceil_div(-bound - start, width), last_j = floor_div(bound - start, width); j <= last_j; ++j) {
    const ZVec<3> row = offset + j * basis[1].p;
    const Z middle = dot(row, b1), disc = middle * middle - b11 * (dot(row, row) - radius2);
    if (disc < 0) continue;
    const Z first = -floor_surd(middle, 1, disc, b11), last = floor_surd(-middle, 1, disc, b11);
    for (Z i = first; i <= last; ++i) visit(row + i * b1);
  }
}

// A point P on the circle of a disc: P - centre = (a + sign sqrt(delta) b) / q.
struct CirclePoint {
  ZVec<3> a, b;
  int sign = 1;
  Z delta, q;
};

// Sign of u + v sign sqrt(delta).
int sign_at(const CirclePoint& p, const Z& u, const Z& v) {
  return sign_of(u, p.sign * (sgn(v) < 0 ? -1 : 1), v * v * p.delta);
}

ZVec<3> rounded_quotient(ZVec<3> a, const Z& q) {
  for (Z& component : a) component = round_div(component, q);
  return a;
}

HolePoint fixed_point(std::size_t disc, const CirclePoint& p, unsigned long bits) {
  const Z root = p.sign * floor_sqrt(shifted_left(p.delta, 2 * bits));
  return {disc, rounded_quotient(shifted_left(1, bits) * p.a + root * p.b, p.q), bits};
}

// The circle of one disc, and the discs of its neighbours. Centres are relative to the centre of the circle.
class Circle {
 public:
  Circle(const Shadow& shadow, std::size_t index, std::size_t& work)
      : shadow_(shadow),
        index_(index),
        own2_(shadow.discs[index].radius * shadow.discs[index].radius * shadow.along2),
        neighbours_(shadow.discs_around(shadow.discs[index].centre, shadow.discs[index].radius, true)),
        work_(work) {}

  // A point of the circle that borders on a hole, if there is one.
  std::optional<HolePoint> border(unsigned long bits) {
    const Z& own = shadow_.discs[index_].radius;
    std::vector<std::size_t> meeting;
    for (std::size_t j = 0; j < neighbours_.size(); ++j) {
      const Disc& disc = neighbours_[j];
      const Z distance2 = dot(disc.centre, disc.centre), difference = disc.radius - own;
      if (distance2 == 0 && difference == 0) continue;  // the disc itself, or another ball in the same line
      if (distance2 < difference * difference * shadow_.along2) {
        if (difference > 0) return std::nullopt;  // the whole circle is inside that disc
        continue;                                 // that disc is inside this one
      }
      meeting.push_back(j);
    }
    if (meeting.empty()) return fixed_point(index_, anywhere(), bits);
    for (std::size_t j = 0; j < neighbours_.size(); ++j) order_.push_back(j);
    for (std::size_t j : meeting)
      for (int sign : {1, -1}) {
        const CirclePoint point = intersection(neighbours_[j], sign);
        if (borders_on_hole(point)) return fixed_point(index_, point, bits);
      }
    return std::nullopt;
  }

 private:
  CirclePoint anywhere() const {
    const ZVec<3>& b1 = shadow_.basis[0].p;
    const Z b11 = dot(b1, b1);
    return {{}, b1, 1, own2_ * b11, b11};
  }

  // With E the centre of the other disc and t = E^2 + R^2 - R_other^2, the points are
  //   P = t E / (2 E^2) +- sqrt(4 E^2 R^2 - t^2) (g cross E) / (2 E^2 |g|).
  CirclePoint intersection(const Disc& other, int sign) const {
    const ZVec<3>& e = other.centre;
    const Z& g2 = shadow_.along2;
    const Z e2 = dot(e, e), t = e2 + own2_ - other.radius * other.radius * g2;
    return {t * g2 * e, cross(shadow_.along, e), sign, (4 * e2 * own2_ - t * t) * g2, 2 * e2 * g2};
  }

  // Sign of |P - E|^2 - R_other^2.
  int side_of(const CirclePoint& p, const Disc& other) const {
    const ZVec<3>& e = other.centre;
    const Z rest = own2_ + dot(e, e) - other.radius * other.radius * shadow_.along2;
    return sign_at(p, rest * p.q - 2 * dot(p.a, e), -2 * dot(p.b, e));
  }

  // True if P is in no open disc, and the discs with P on their boundaries leave a direction v in which one
  // can leave P: v.(P - C) >= 0 for all their centres C. (= 0 is enough. The discs curve away, also from each
  // other where two touch: between three discs that touch each other there is a hole.) A point without such a
  // v is a single free point.
  bool borders_on_hole(const CirclePoint& p) {
    std::vector<ZVec<3>> centres;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      ++work_;
      const Disc& other = neighbours_[order_[i]];
      const int side = side_of(p, other);
      if (side < 0) {
        std::swap(order_[i], order_[i / 2]);  // a disc that covers one point is likely to cover the next
        return false;
      }
      if (side == 0) centres.push_back(other.centre);
    }
    // Such a v exists iff all P - C are within half a turn, to the left of one of them.
    return std::any_of(centres.begin(), centres.end(), [&](const ZVec<3>& c) {
      return std::all_of(centres.begin(), centres.end(),
                         [&](const ZVec<3>& other) { return turn(p, c, other) >= 0; });
    });
  }

  // Sign of g.((P - c) cross (P - d)) = g.(P cross (c - d) + c cross d).
  int turn(const CirclePoint& p, const ZVec<3>& c, const ZVec<3>& d) const {
    const ZVec<3> apart = c - d;
    const ZVec<3>& g = shadow_.along;
    return sign_at(p, dot(g, cross(p.a, apart)) + p.q * dot(g, cross(c, d)), dot(g, cross(p.b, apart)));
  }

  const Shadow& shadow_;
  std::size_t index_;
  Z own2_;  ///< squared radius in the plane
  std::vector<Disc> neighbours_;
  std::vector<std::size_t> order_;  ///< the order in which the neighbours are tried
  std::size_t& work_;
};

}  // namespace

Shadow::Shadow(const ObstacleLattice<3>& lattice, const ZVec<3>& g, const ZVec<3>& e1, const ZVec<3>& e2)
    : along(g),
      along2(dot(g, g)),
      basis{LatticePoint<3>{cross(e1, g), {}}, LatticePoint<3>{cross(e2, g), {}}} {
  reduce(basis, euclidean_form);
  see(lattice, 1);
}

void Shadow::see(const ObstacleLattice<3>& lattice, std::size_t count) {
  while (discs.size() < count) {
    const Obstacle<3>& ball = lattice.obstacles[discs.size()];
    discs.push_back({cross(ball.position, along), ball.axes[0][0]});
  }
}

std::vector<Disc> Shadow::discs_around(const ZVec<3>& point, const Z& reach, bool add_radius) const {
  std::vector<Disc> around;
  for (const Disc& disc : discs) {
    const Z distance = add_radius ? Z(reach + disc.radius) : reach;
    visit_disc(basis, along, disc.centre - point, distance * distance * along2, [&](const ZVec<3>& centre) {
      around.push_back({centre, disc.radius});
    });
  }
  return around;
}

// In a reduced basis with b1.b2 >= 0 the triangle 0, b1, b2 has no obtuse angle, so the centre of its
// circumcircle is furthest from all lattice points.
std::optional<HolePoint> hole_of_largest(const Shadow& shadow, unsigned long bits) {
  const ZVec<3>& b1 = shadow.basis[0].p;
  ZVec<3> b2 = shadow.basis[1].p;
  if (dot(b1, b2) < 0) b2 = -1 * b2;
  const Z g11 = dot(b1, b1), g12 = dot(b1, b2), g22 = dot(b2, b2), g33 = g11 + g22 - 2 * g12;
  const Z area2 = g11 * g22 - g12 * g12, r = shadow.discs[0].radius;
  if (g11 * g22 * g33 <= 4 * area2 * r * r * shadow.along2) return std::nullopt;
  const Z k1 = g22 * (g11 - g12), k2 = g11 * (g22 - g12);
  return HolePoint{0, rounded_quotient(shifted_left(1, bits) * (k1 * b1 + k2 * b2), 2 * area2), bits};
}

std::optional<HolePoint> hole_of_all(const Shadow& shadow, std::size_t& work, unsigned long bits) {
  for (std::size_t i = 0; i < shadow.discs.size(); ++i) {
    work += shadow.discs.size();
    if (auto point = Circle(shadow, i, work).border(bits)) return point;
  }
  return std::nullopt;
}

}  // namespace lorentz::oracle
