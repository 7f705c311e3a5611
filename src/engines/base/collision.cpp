#include <lorentz/collision.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lorentz/engine_base.hpp>
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

// The line of flight and the obstacle that an answer names, in powers of two of its size and of the velocity, for their
// squares may be beyond binary64. `arm`: from its centre to where the line is at the answer's time, or to x.
class Chord {
 public:
  Chord(const Scene& scene, const Query& query, const Answer& answer)
      : is_at_entry_(answer.outcome == Outcome::hit),
        start_(is_at_entry_ ? answer.time : 0),
        velocity_(checked(query, checked(scene)).v) {
    if (!start_ || (!is_at_entry_ && answer.outcome != Outcome::inside))
      throw InputError("answer: needs a hit with a time, or inside");
    checked(answer.obstacle, scene);
    const Atom& atom = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
    std::array<Vec, 3> axes = semiaxes_of(atom, scene.dimension);
    unit_ = mean_exponent(axes, scene.dimension);
    for (Vec& axis : axes) axis = times_power_of_two(axis, -unit_);
    if (!atom.is_ball()) to_ball_ = dual_of(axes, scene.dimension);
    size_ = atom.is_ball() ? axes[0][0] * axes[0][0] : 1;
    const Vec arm = plus(plus(query.x, *start_, query.v), -1, centre_of(scene, answer.obstacle));
    arm_ = times_power_of_two(arm, -unit_);
  }

  // The chord's ends are the roots of q(t) = |A^-1 (arm + t v)|^2 - 1. At an entry one root is 0, and the other follows
  // from their sum; from inside it is found in the form in which nothing cancels.
  double exit_time() const {
    const Vec slope = gradient(velocity_.scaled);
    const double a = dot(velocity_.scaled, slope), b = dot(arm_, slope);
    if (is_at_entry_) return *start_ + std::scalbn(-2 * b / a, unit_ - velocity_.exponent);
    const double c = dot(arm_, gradient(arm_)) - size_;
    const double root = std::sqrt(b * b - a * c);
    return std::scalbn(b > 0 ? -c / (b + root) : (root - b) / a, unit_ - velocity_.exponent);
  }

  Vec normal_at(double time) const {
    const double after = std::scalbn(time - *start_, velocity_.exponent - unit_);
    const Vec outward = gradient(plus(arm_, after, velocity_.scaled));
    return divided(outward, length_of_any(outward));
  }

  double impact_parameter() const {
    const Vec direction = divided(velocity_.scaled, length_of_any(velocity_.scaled));
    return std::scalbn(length_of_any(plus(arm_, -dot(arm_, direction), direction)), unit_);
  }

 private:
  // That of |A^-1 a|^2 / 2 at a, which is A^-T A^-1 a; for a ball, a itself.
  Vec gradient(const Vec& a) const {
    if (!to_ball_) return a;
    Vec sum{};
    for (const Vec& row : *to_ball_) sum = plus(sum, dot(row, a), row);
    return sum;
  }

  const bool is_at_entry_;
  const std::optional<double> start_;
  const ScaledVelocity velocity_;
  int unit_ = 0;  // the exponent of the lengths
  std::optional<std::array<Vec, 3>> to_ball_;
  double size_ = 1;
  Vec arm_{};
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
