#include "oracle.hpp"

#include <variant>

#include "first_hit.hpp"
#include "inside.hpp"

namespace lorentz::oracle {
namespace {

Cell to_cell(const auto& n) {
  Cell cell;
  for (std::size_t i = 0; i < n.size(); ++i) cell[i] = to_integer(n[i]);
  return cell;
}

// One query in integers: lengths times 2^-length_exponent, velocities times 2^-velocity_exponent.
template <std::size_t D>
struct ExactQuery {
  long length_exponent, velocity_exponent;
  ZVec<D> x;
  Flight<D> flight;
  std::optional<ZVec<D>> from;

  ExactQuery(const ExactScene<D>& scene, const Query& query) {
    CommonExponent length, velocity;
    for (std::size_t i = 0; i < D; ++i) {
      length.see(query.x[i]);
      velocity.see(query.v[i]);
    }
    length_exponent = query.x == Vec{} ? scene.exponent : std::min(scene.exponent, length.get());
    velocity_exponent = velocity.get();
    for (std::size_t i = 0; i < D; ++i) {
      x[i] = scaled(query.x[i], length_exponent);
      flight.v[i] = scaled(query.v[i], velocity_exponent);
    }
    flight.v2 = dot(flight.v, flight.v);
    if (query.from) {
      from.emplace();
      for (std::size_t i = 0; i < D; ++i) (*from)[i] = to_z(query.from->cell[i]);
    }
  }

  const ZVec<D>* from_in(const Query& query, int lattice, int atom) const {
    const bool here = from && query.from->lattice == lattice && query.from->atom == atom;
    return here ? &*from : nullptr;
  }

  // t = (s - sqrt(d)) / v^2 in the query's own units.
  Quadratic time_of(const Entry<D>& entry) const {
    return {entry.s, -1, entry.d, flight.v2, length_exponent - velocity_exponent};
  }

  Detail detail_of(const Entry<D>& entry, const Z& radius) const;
};

// component * (s - sqrt(d)) + shift * v^2, over `q`.
Quadratic along_flight(const Z& component, const Z& shift, const Z& s, const Z& d, const Z& q,
                       long exponent) {
  return {component * s + shift, component > 0 ? -1 : +1, component * component * d, q, exponent};
}

template <std::size_t D>
Detail ExactQuery<D>::detail_of(const Entry<D>& entry, const Z& radius) const {
  Detail detail;
  for (std::size_t i = 0; i < D; ++i) {
    const Z& v = flight.v[i];
    const Z relative = -entry.centre.p[i] * flight.v2;  // of x, from the centre
    detail.point[i] =
        round_to_binary64(along_flight(v, x[i] * flight.v2, entry.s, entry.d, flight.v2, length_exponent));
    detail.normal[i] = round_to_binary64(along_flight(v, relative, entry.s, entry.d, flight.v2 * radius, 0));
  }
  const Z across2 = radius * radius * flight.v2 - entry.d;  // |h|^2 = (impact parameter)^2 v^2
  detail.impact_parameter = round_to_binary64({0, +1, across2 * flight.v2, flight.v2, length_exponent});
  return detail;
}

template <std::size_t D>
class Problem {
 public:
  explicit Problem(const Scene& scene) : scene_(scene) {}

  Answer first_hit(const Query& query, const Request& request) const {
    const ExactQuery<D> exact(scene_, query);
    std::vector<View<D>> views;
    if (auto obstacle = smallest_around(exact, query, views)) return Answer::inside(*obstacle);
    Earliest<D> earliest;
    auto view = views.begin();
    for (int l = 0; l < static_cast<int>(scene_.lattices.size()); ++l)
      for (int a = 0; a < static_cast<int>(scene_.lattices[l].atoms.size()); ++a, ++view) {
        const Z rho2 = view->radius2 * exact.flight.v2;
        search_first_hit(Search<D>{exact.flight, *view, l, a, exact.from_in(query, l, a), rho2,
                                   root_below(rho2), earliest});
      }
    return answer_to(exact, earliest, request);
  }

  bool is_free(const Query& query) const {
    std::vector<View<D>> views;
    return !smallest_around(ExactQuery<D>(scene_, query), query, views);
  }

 private:
  // The smallest obstacle that contains x, or nothing and the views of all atoms, in order.
  std::optional<ObstacleId> smallest_around(const ExactQuery<D>& exact, const Query& query,
                                            std::vector<View<D>>& views) const {
    for (int l = 0; l < static_cast<int>(scene_.lattices.size()); ++l)
      for (int a = 0; a < static_cast<int>(scene_.lattices[l].atoms.size()); ++a) {
        views.push_back(view_of<D>(scene_, l, a, exact.x, exact.length_exponent));
        const auto n =
            smallest_inside<D>(scene_, l, views.back(), exact.from_in(query, l, a), exact.length_exponent);
        if (n) return ObstacleId{l, a, to_cell(*n)};
      }
    return std::nullopt;
  }

  Answer answer_to(const ExactQuery<D>& exact, const Earliest<D>& earliest, const Request& request) const {
    if (!earliest.found()) return request.max_time ? Answer::later() : Answer::never();
    const Entry<D>& entry = earliest.entry();
    const Quadratic time = exact.time_of(entry);
    if (request.max_time && compare(time, *request.max_time) >= 0) return Answer::later();
    Answer answer =
        Answer::hit({entry.lattice, entry.atom, to_cell(entry.centre.n)}, round_to_binary64(time));
    if (request.digits > 0) answer.time_decimal = round_to_decimal(time, request.digits);
    if (request.detail) {
      const Z radius = shifted_left(scene_.lattices[entry.lattice].atoms[entry.atom].radius,
                                    scene_.exponent - exact.length_exponent);
      answer.detail = exact.detail_of(entry, radius);
    }
    return answer;
  }

  ExactScene<D> scene_;
};

bool has_semiaxes(const Scene& scene) {
  for (const Lattice& lattice : scene.lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return true;
  return false;
}

}  // namespace

struct Oracle::Impl {
  Scene scene;
  std::variant<std::monostate, Problem<2>, Problem<3>> problem;  // nothing: the scene is not supported
};

Oracle::Oracle(const Scene& scene) {
  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  if (!has_semiaxes(scene)) {
    if (scene.dimension == 2)
      impl->problem.emplace<Problem<2>>(scene);
    else
      impl->problem.emplace<Problem<3>>(scene);
  }
  impl_ = std::move(impl);
}

Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;
Oracle::~Oracle() = default;

Answer Oracle::first_hit(const Query& query, const Request& request) const {
  if (auto flaw = flaw_of(query, impl_->scene)) return Answer::error(*flaw);
  if (const auto* problem = std::get_if<Problem<2>>(&impl_->problem))
    return problem->first_hit(query, request);
  if (const auto* problem = std::get_if<Problem<3>>(&impl_->problem))
    return problem->first_hit(query, request);
  return Answer::unsupported_because("the oracle does not do semiaxes yet; balls (radius) only");
}

bool Oracle::is_free(const Vec& x) const {
  const Query query{x, {1, 0, 0}, {}};
  if (const auto* problem = std::get_if<Problem<2>>(&impl_->problem)) return problem->is_free(query);
  return std::get<Problem<3>>(impl_->problem).is_free(query);
}

std::string oracle_libraries() {
  return std::string("GMP ") + gmp_version;
}

}  // namespace lorentz::oracle
