#include <lorentz/oracle.hpp>

#include <limits>
#include <string>

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

// One end of the chord in the scene's own coordinates, for q = v the one where the line enters the obstacle, and for
// q = -v the one where it leaves it. Relative to the centre c of the obstacle, the point x + t v is w = t v - c. With
// v2 t = s -+ sqrt(d) this is v2 w = (s v - v2 c) - sqrt(d) q. The normal is along w for a ball, and along
// adj(A)^T adj(A) w for an ellipsoid.
template <std::size_t D>
void set_end(const ExactScene<D>& scene, const ExactQuery<D>& query, const ExactEntry<D>& entry,
             const ZVec<D>& c, ZVec<D> q, Vec& point, Vec& normal) {
  const ZVec<D>& v = query.velocity.v;
  ZVec<D> p;
  for (std::size_t i = 0; i < D; ++i) {
    p[i] = entry.s * v[i] - entry.v2 * c[i];
    point[i] = round_to_binary64(
        surd(entry.s * v[i] + entry.v2 * query.x[i], q[i], entry.d, entry.v2, query.length_exponent));
  }
  if (const auto& frame = scene.lattices[entry.lattice].atoms[entry.atom].frame) {
    p = transposed(frame->to_ball) * (frame->to_ball * p);
    q = transposed(frame->to_ball) * (frame->to_ball * q);
  }
  set_unit_vector(p, q, entry.d, normal);
}

// `entry`: where the line meets the obstacle that the answer names.
template <std::size_t D>
void add_detail(const ExactScene<D>& scene, const ExactQuery<D>& query, const ExactEntry<D>& entry,
                Answer& answer) {
  const ZVec<D>& v = query.velocity.v;
  const ZVec<D> c = centre_of(scene, entry.lattice, entry.atom, entry.n, query.x, query.length_exponent);
  ZVec<D> back;
  for (std::size_t i = 0; i < D; ++i) back[i] = -v[i];
  answer.exit_time = round_to_binary64(query.exit_time_of(entry));
  Detail& detail = answer.detail.emplace();
  if (answer.outcome == Outcome::hit) set_end(scene, query, entry, c, v, detail.point, detail.normal);
  set_end(scene, query, entry, c, back, detail.exit_point, detail.exit_normal);
  const Z& v2 = query.velocity.v2;
  const Z along = dot(v, c), across2 = v2 * dot(c, c) - along * along;  // (impact parameter)^2 v^2
  detail.impact_parameter = round_to_binary64(Quadratic{0, +1, across2 * v2, v2, query.length_exponent});
}

// By these rules obstacles that contain x are passed one row after another. A radius of very many cells has too many.
template <std::size_t D>
bool is_beyond_rule(const ExactScene<D>& scene, const ExactQuery<D>& query, StartInside rule) {
  if (rule != StartInside::miss && rule != StartInside::exit) return false;
  bool is_dense = false;
  for_each_atom(scene, [&](int lattice, int atom) {
    const View<D> view = query.view(scene, lattice, atom);
    for (const LatticePoint<D>& vector : view.basis)
      is_dense |= view.radius2 > 1'000'000 * dot(vector.p, vector.p);
  });
  return is_dense && smallest_around(scene, query);
}

template <std::size_t D>
Answer hit_of(const ExactEntry<D>& entry, const Quadratic& time, const Request& request) {
  if (request.max_time && compare(time, *request.max_time) >= 0) return Answer::later();
  Answer answer = Answer::hit({entry.lattice, entry.atom, to_cell(entry.n)}, round_to_binary64(time));
  if (request.digits > 0) answer.time_decimal = round_to_decimal(time, request.digits);
  return answer;
}

template <std::size_t D>
Answer first_hit(const ExactScene<D>& scene, const ExactQuery<D>& query, const Request& request) {
  if (is_beyond_rule(scene, query, request.start))
    return Answer::unsupported_because(
        "a start inside obstacles with radii of more than 1000 lattice vectors, by the rule " +
        std::string(name_of(request.start)));
  if (request.start == StartInside::exit)
    if (const auto left = first_left(scene, query)) return hit_of(*left, query.exit_time_of(*left), request);
  const Sighting<D> seen = first_entry(scene, query, request.start == StartInside::miss);
  if (seen.around && request.start == StartInside::zero)
    return hit_of(query.meeting(scene, *seen.around), Quadratic{}, request);
  if (seen.around) {
    Answer inside = Answer::inside(*seen.around);
    if (request.detail) add_detail(scene, query, query.meeting(scene, *seen.around), inside);
    return inside;
  }
  if (!seen.earliest.found()) return limited(Answer::never(), request.max_time.value_or(HUGE_VAL));
  const ExactEntry<D>& entry = seen.earliest.entry();
  Answer answer = hit_of(entry, query.time_of(entry), request);
  if (request.detail && answer.outcome == Outcome::hit) add_detail(scene, query, entry, answer);
  return answer;
}

}  // namespace

struct Oracle::Impl {
  Scene scene;
  AnyExactScene exact_scene;

  /// The result of work(scene, query), both exact.
  template <class Work>
  auto with(const Query& query, const Work& work) const {
    return std::visit(
        [&]<std::size_t D>(const ExactScene<D>& exact) { return work(exact, ExactQuery<D>(exact, query)); },
        exact_scene);
  }
};

Oracle::Oracle(const Scene& scene)
    : impl_(std::make_unique<const Impl>(Impl{scene, any_exact_scene(scene)})) {}

Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;
Oracle::~Oracle() = default;

Answer Oracle::first_hit(const Query& query, const Request& request) const {
  if (request.digits < 0 || request.digits > kMostDigits)
    throw InputError("digits: needs from 0 to " + std::to_string(kMostDigits));
  const double max_time = request.max_time.value_or(std::numeric_limits<double>::infinity());
  if (auto flaw = flaw_of(query, impl_->scene, max_time)) return Answer::error(*flaw);
  return impl_->with(
      query, [&](const auto& scene, const auto& exact) { return oracle::first_hit(scene, exact, request); });
}

bool Oracle::is_free(const Vec& x) const {
  const Query query{x, {1, 0, 0}, {}};
  checked(query, impl_->scene);
  return impl_->with(query,
                     [](const auto& scene, const auto& exact) { return !smallest_around(scene, exact); });
}

std::string oracle_libraries() {
  return std::string("GMP ") + gmp_version;
}

}  // namespace lorentz::oracle
