// Places on a flight's line are integers in a unit far smaller than that of the scene's numbers. The
// obstacles around them are enumerated exactly.
#include <lorentz/surroundings.hpp>

#include <cmath>
#include <initializer_list>
#include <variant>

#include <lorentz/errors.hpp>

#include "oracle/exact/exact_query.hpp"
#include "oracle/exact/inside.hpp"
#include "oracle/exact/real.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kFiner = 64;  // roundings to integers are this many bits below the scene's numbers
constexpr double kHuge = 1e300;

double rounded(const Real& a) {
  return a < 0 ? -to_double(-a, kHuge) : to_double(a, kHuge);
}

template <std::size_t D>
class SightLine {
 public:
  SightLine(const ExactScene<D>& scene, const Query& query) : scene_(scene), query_(scene, query, kFiner) {}

  double way(const PlaceOnLine& from, const PlaceOnLine& to) const {
    const Real length = (time_of(to) - time_of(from)) * sqrt(real(query_.velocity.v2));
    return rounded(in_own_units(length));
  }

  Vec centre(const PlaceOnLine& seen_from, const ObstacleId& id) const {
    return rounded_vector(
        centre_of<D>(scene_, id.lattice, id.atom, to_zvec<D>(id.cell), point(seen_from), exponent()));
  }

  Neighbourhood around(const PlaceOnLine& place, double reach, std::size_t most) const {
    Neighbourhood found;
    const ZVec<D> middle = point(place);
    const Z radius = ceiling(times_power_of_two(Real(reach), -exponent()));
    for_each_atom(scene_, [&](int l, int a) { visit(l, a, middle, radius * radius, most, found); });
    return found;
  }

 private:
  long exponent() const { return query_.length_exponent; }
  Real in_own_units(const Real& length) const { return times_power_of_two(length, exponent()); }

  // In the units of the exact query, in which x + t v is also a place.
  Real time_of(const PlaceOnLine& place) const {
    const Real beyond = times_power_of_two(Real(place.beyond), -exponent());
    return mark_of(place) + beyond / sqrt(real(query_.velocity.v2));
  }

  // The time without the distance beyond it.
  Real mark_of(const PlaceOnLine& place) const {
    if (!place.obstacle) return times_power_of_two(Real(place.time), -query_.time_exponent());
    const ExactEntry<D> entry = query_.meeting(scene_, *place.obstacle);
    const Real s = real(entry.s);
    return (entry.d > 0 ? s - sqrt(real(entry.d)) : s) / real(entry.v2);
  }

  ZVec<D> point(const PlaceOnLine& place) const {
    const Real time = time_of(place);
    ZVec<D> result = query_.x;
    for (std::size_t k = 0; k < D; ++k) result[k] += ceiling(time * real(query_.velocity.v[k]));
    return result;
  }

  Vec rounded_vector(const ZVec<D>& a) const {
    Vec result{};
    for (std::size_t k = 0; k < D; ++k) result[k] = rounded(in_own_units(real(a[k])));
    return result;
  }

  // Uses the lattice in space, whatever the shape of the obstacles, because a ball around the place is a ball
  // in space.
  void visit(int l, int a, const ZVec<D>& middle, const Z& radius2, std::size_t most,
             Neighbourhood& found) const {
    Basis<D> basis = scene_.lattices[l].reduced;
    const Z unit = shifted_left(1, static_cast<unsigned long>(scene_.exponent - exponent()));
    for (auto& b : basis) b.p = unit * b.p;
    LatticePoint<D> offset;
    offset.p = centre_of<D>(scene_, l, a, offset.n, middle, exponent());
    // The completing vectors are made so long that no copy is in the ball.
    const std::size_t rank = scene_.lattices[l].rank;
    const Z far = ceil_sqrt(radius2) + ceil_sqrt(dot(offset.p, offset.p)) + 1;
    for (std::size_t i = rank; i < D; ++i) basis[i].p = far * basis[i].p;
    const ZVec<D> coordinates = cramer(basis, offset.p);
    const Z det = determinant<D>(basis);
    for (std::size_t i = 0; i < D; ++i) offset.add_multiple(-floor_div(coordinates[i], det), basis[i]);
    std::size_t count = 0;
    const RowVisitor<D> row = [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
      LatticePoint<D> point = first;
      for (Z k = 0; k <= last && count <= most; ++k, point.add_multiple(1, step))
        if (!is_copy(point.n, rank) && ++count <= most)
          found.obstacles.push_back({{l, a, to_cell<D>(point.n)}, rounded_vector(point.p)});
      return count > most;
    };
    if (visit_ball<D>(basis, offset, radius2, row)) found.complete = false;
  }

  const ExactScene<D>& scene_;
  const ExactQuery<D> query_;
};

}  // namespace

struct Surroundings::Impl {
  Scene given;
  AnyExactScene scene;

  template <class Work>
  auto with(const Query& query, const std::initializer_list<PlaceOnLine>& places, const Work& work) const {
    checked(query, given);
    for (const PlaceOnLine& place : places) {
      if (place.obstacle) checked(*place.obstacle, given);
      if (!std::isfinite(place.time) || !std::isfinite(place.beyond))
        throw InputError("place: is not finite");
    }
    return std::visit(
        [&]<std::size_t D>(const ExactScene<D>& exact) { return work(SightLine<D>(exact, query)); }, scene);
  }
};

Surroundings::Surroundings(const Scene& scene)
    : impl_(std::make_unique<const Impl>(Impl{scene, any_exact_scene(scene)})) {}
Surroundings::Surroundings(Surroundings&&) noexcept = default;
Surroundings& Surroundings::operator=(Surroundings&&) noexcept = default;
Surroundings::~Surroundings() = default;

double Surroundings::way(const Query& query, const PlaceOnLine& from, const PlaceOnLine& to) const {
  return impl_->with(query, {from, to}, [&](const auto& sight) { return sight.way(from, to); });
}

Vec Surroundings::centre(const Query& query, const PlaceOnLine& seen_from, const ObstacleId& obstacle) const {
  checked(obstacle, impl_->given);
  return impl_->with(query, {seen_from},
                     [&](const auto& sight) { return sight.centre(seen_from, obstacle); });
}

Neighbourhood Surroundings::around(const Query& query, const PlaceOnLine& place, double reach,
                                   std::size_t most) const {
  if (!(reach > 0 && std::isfinite(reach))) throw InputError("reach: must be above zero and finite");
  return impl_->with(query, {place}, [&](const auto& sight) { return sight.around(place, reach, most); });
}

}  // namespace lorentz::oracle
