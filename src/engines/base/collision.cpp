#include <lorentz/collision.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>

namespace lorentz {
namespace {

double as_binary64(const Integer& n) {
  return n.fits_int64() ? static_cast<double>(n.int64()) : std::strtod(n.decimal().c_str(), nullptr);
}

Vec centre_of(const Scene& scene, const ObstacleId& id) {
  const Lattice& lattice = scene.lattices[id.lattice];
  Vec centre = lattice.atoms[id.atom].position;
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < scene.dimension; ++k) centre[k] += as_binary64(id.cell[i]) * lattice.vectors[i][k];
  return centre;
}

Vec divided(const Vec& a, double by) {
  return {a[0] / by, a[1] / by, a[2] / by};
}

// The gradient of |A^-1 a|^2 / 2 at a, which is A^-T A^-1 a; for a ball, a itself.
Vec gradient(const Atom& atom, int dimension, const Vec& a) {
  if (atom.is_ball()) return a;
  const std::array<Vec, 3> dual = dual_of(semiaxes_of(atom, dimension), dimension);
  Vec sum{};
  for (int i = 0; i < dimension; ++i) sum = plus(sum, dot(dual[i], a), dual[i]);
  return sum;
}

// The length of a vector of any size. The hypot of standard libraries differs in the last bit; this one is
// GCC's.
double length_of_any(const Vec& a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  return largest > 0 ? largest * length(divided(a, largest)) : largest;
}

// The line of flight and the obstacle that an answer names. `arm`: from its centre to the point of the line where the
// answer's time is, or to x.
class Chord {
 public:
  Chord(const Scene& scene, const Query& query, const Answer& answer)
      : dimension_(scene.dimension), v_(query.v), start_(answer.outcome == Outcome::hit ? answer.time : 0) {
    if (!start_ || (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside))
      throw InputError("answer: needs a hit with a time, or inside");
    checked(answer.obstacle, checked(scene));
    atom_ = &scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
    arm_ = plus(plus(query.x, *start_, v_), -1, centre_of(scene, answer.obstacle));
    is_at_entry_ = answer.outcome == Outcome::hit;
  }

  // The chord's ends are the roots of q(t) = |A^-1 (arm + t v)|^2 - 1. At an entry one root is 0, and the other follows
  // from their sum; from inside it is found in the form in which nothing cancels.
  double exit_time() const {
    const Vec slope = gradient(*atom_, dimension_, v_);
    const double a = dot(v_, slope), b = dot(arm_, slope);
    if (is_at_entry_) return *start_ - 2 * b / a;
    const double size = atom_->is_ball() ? atom_->radius * atom_->radius : 1;
    const double c = dot(arm_, gradient(*atom_, dimension_, arm_)) - size;
    const double root = std::sqrt(b * b - a * c);
    return b > 0 ? -c / (b + root) : (root - b) / a;
  }

  Vec normal_at(double time) const {
    const Vec outward = gradient(*atom_, dimension_, plus(arm_, time - *start_, v_));
    return divided(outward, length_of_any(outward));
  }

  double impact_parameter() const {
    const Vec direction = divided(v_, length_of_any(v_));
    return length_of_any(plus(arm_, -dot(arm_, direction), direction));
  }

 private:
  const int dimension_;
  const Vec v_;
  const std::optional<double> start_;
  const Atom* atom_ = nullptr;
  Vec arm_{};
  bool is_at_entry_ = false;
};

}  // namespace

double exit_time(const Scene& scene, const Query& query, const Answer& answer) {
  return Chord(scene, query, answer).exit_time();
}

Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer) {
  const Chord chord(scene, query, answer);
  const double exit = chord.exit_time();
  Detail detail;
  if (answer.outcome == Outcome::hit) {
    detail.point = plus(query.x, *answer.time, query.v);
    detail.normal = chord.normal_at(*answer.time);
  }
  detail.impact_parameter = chord.impact_parameter();
  detail.exit_point = plus(query.x, exit, query.v);
  detail.exit_normal = chord.normal_at(exit);
  return detail;
}

Vec reflected(const Vec& v, const Vec& normal) {
  return plus(v, -2 * dot(v, normal), normal);
}

}  // namespace lorentz
