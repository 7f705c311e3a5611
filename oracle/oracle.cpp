#include <lorentz/oracle.hpp>

#include <limits>
#include <string>
#include <variant>

#include <lorentz/errors.hpp>

#include "oracle/first_hit/first_entry.hpp"

namespace lorentz::oracle {
namespace {

// (p - q sqrt(d)) / denominator.
Quadratic surd(const Z& p, const Z& q, const Z& d, const Z& denominator, long exponent) {
  return {p, q > 0 ? -1 : +1, q * q * d, denominator, exponent};
}

// Makes the direction p - sqrt(d) q a unit vector. The square of a component of the unit vector is
//   (p_i - sqrt(d) q_i)^2 / |p - sqrt(d) q|^2 = (a - b sqrt(d)) / (e - f sqrt(d)).
// Multiplying numerator and denominator by e + f sqrt(d) gives a quadratic number again. That factor is not
// zero, because e + f sqrt(d) = |p + sqrt(d) q|^2 belongs to the point where the line leaves the obstacle,
// and there is a normal there, too.
template <std::size_t D>
void set_unit_vector(const ZVec<D>& p, const ZVec<D>& q, const Z& d, Vec& unit) {
  const Z e = dot(p, p) + d * dot(q, q), f = 2 * dot(p, q);
  const Z denominator = e * e - f * f * d;
  for (std::size_t i = 0; i < D; ++i) {
    const Z a = p[i] * p[i] + d * q[i] * q[i], b = 2 * p[i] * q[i];
    const int sign = sign_of(p[i], q[i] > 0 ? -1 : 1, q[i] * q[i] * d);
    unit[i] = round_root_to_binary64(surd(a * e - b * f * d, b * e - a * f, d, denominator, 0), sign);
  }
}

// The collision in the scene's own coordinates. Relative to the centre c of the obstacle, the point x + t v
// is w = t v - c. With v2 t = s - sqrt(d) this is v2 w = (s v - v2 c) - sqrt(d) v. The normal is along w for
// a ball, and along adj(A)^T adj(A) w for an ellipsoid.
template <std::size_t D>
Detail detail_of(const ExactScene<D>& scene, const ExactQuery<D>& query, const ExactEntry<D>& entry) {
  const ZVec<D>& v = query.velocity.v;
  const ZVec<D> c = centre_of(scene, entry.lattice, entry.atom, entry.n, query.x, query.length_exponent);
  const ExactAtom<D>& atom = scene.lattices[entry.lattice].atoms[entry.atom];
  Detail detail;
  ZVec<D> p, q = v;
  for (std::size_t i = 0; i < D; ++i) {
    p[i] = entry.s * v[i] - entry.v2 * c[i];
    detail.point[i] = round_to_binary64(
        surd(entry.s * v[i] + entry.v2 * query.x[i], v[i], entry.d, entry.v2, query.length_exponent));
  }
  if (atom.frame) {
    const ZMatrix<D>& to_ball = atom.frame->to_ball;
    p = transposed(to_ball) * (to_ball * p);
    q = transposed(to_ball) * (to_ball * q);
  }
  set_unit_vector(p, q, entry.d, detail.normal);
  const Z& v2 = query.velocity.v2;
  const Z along = dot(v, c), across2 = v2 * dot(c, c) - along * along;  // (impact parameter)^2 v^2
  detail.impact_parameter = round_to_binary64(Quadratic{0, +1, across2 * v2, v2, query.length_exponent});
  return detail;
}

template <std::size_t D>
class Problem {
 public:
  explicit Problem(const Scene& scene) : scene_(scene) {}

  Answer first_hit(const Query& query, const Request& request) const {
    const ExactQuery<D> exact(scene_, query);
    const Sighting<D> seen = first_entry(scene_, exact);
    if (seen.around) return Answer::inside(*seen.around);
    return answer_to(exact, seen.earliest, request);
  }

  bool is_free(const Query& query) const { return !smallest_around(scene_, ExactQuery<D>(scene_, query)); }

 private:
  Answer answer_to(const ExactQuery<D>& exact, const Earliest<D>& earliest, const Request& request) const {
    if (!earliest.found()) return request.max_time ? Answer::later() : Answer::never();
    const ExactEntry<D>& entry = earliest.entry();
    const Quadratic time = exact.time_of(entry);
    if (request.max_time && compare(time, *request.max_time) >= 0) return Answer::later();
    Answer answer = Answer::hit({entry.lattice, entry.atom, to_cell(entry.n)}, round_to_binary64(time));
    if (request.digits > 0) answer.time_decimal = round_to_decimal(time, request.digits);
    if (request.detail) answer.detail = detail_of(scene_, exact, entry);
    return answer;
  }

  ExactScene<D> scene_;
};

}  // namespace

struct Oracle::Impl {
  Scene scene;
  std::variant<Problem<2>, Problem<3>> problem;
};

Oracle::Oracle(const Scene& scene) {
  using Exact = std::variant<Problem<2>, Problem<3>>;
  impl_ = std::make_unique<const Impl>(
      Impl{scene, scene.dimension == 2 ? Exact(Problem<2>(scene)) : Exact(Problem<3>(scene))});
}

Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;
Oracle::~Oracle() = default;

Answer Oracle::first_hit(const Query& query, const Request& request) const {
  if (request.digits < 0 || request.digits > kMostDigits)
    throw InputError("digits: needs from 0 to " + std::to_string(kMostDigits));
  const double max_time = request.max_time.value_or(std::numeric_limits<double>::infinity());
  if (auto flaw = flaw_of(query, impl_->scene, max_time)) return Answer::error(*flaw);
  return std::visit([&](const auto& problem) { return problem.first_hit(query, request); }, impl_->problem);
}

bool Oracle::is_free(const Vec& x) const {
  const Query query{x, {1, 0, 0}, {}};
  checked(query, impl_->scene);
  return std::visit([&](const auto& problem) { return problem.is_free(query); }, impl_->problem);
}

std::string oracle_libraries() {
  return std::string("GMP ") + gmp_version;
}

}  // namespace lorentz::oracle
