// The parts that certified itineraries are made of, where a whole journey would not show a fault in them.
#include <catch2/catch.hpp>
#include <cmath>

#include "oracle/itinerary/error_box.hpp"
#include "oracle/itinerary/sight.hpp"

using namespace lorentz;
using namespace lorentz::oracle;

namespace {

// The unit square lattice with discs of radius 1/4, in thousandths.
IntegerScene<2> discs() {
  IntegerScene<2> scene;
  auto& lattice = scene.lattices.emplace_back();
  lattice.vectors = {ZVec<2>{1000, 0}, ZVec<2>{0, 1000}};
  lattice.atoms.push_back({{0, 0}, 250, std::nullopt});
  return scene;
}

// A particle that passes the disc (1, 0) at 10^-7 of its edge.
State<2> grazing() {
  State<2> state;
  const double height = 1000 * ((0.25 + 1e-7) * std::sqrt(1.0004) - 0.01);
  state.y = {Ball(500), Ball(height)};
  state.v = {Ball(1000), Ball(20)};
  return state;
}

std::variant<ObstacleId, Unseen> seen_with(double y_error, double v_error) {
  const ZVec<2> centre;
  const State<2> state = grazing();
  const std::array<Bound, 2> of_y{Bound(y_error), Bound(y_error)}, of_v{Bound(v_error), Bound(v_error)};
  return Sight<2>(discs()).next({centre, state, of_y, of_v, std::nullopt});
}

double width(const ErrorBox<3>& box, int component) {
  return mag_get_d(box.width_of(component).raw());
}

}  // namespace

TEST_CASE("Itinerary: a decision is made where the state allows it, and not where it does not") {
  // The line is 10^-4 units off the disc's edge; it goes on to another one for certain.
  const auto sharp = seen_with(1e-10, 1e-10);
  REQUIRE(std::holds_alternative<ObstacleId>(sharp));
  CHECK(!(std::get<ObstacleId>(sharp).cell[0] == Integer(1)));
  CHECK(std::holds_alternative<Unseen>(seen_with(1e-2, 1e-10)));
  CHECK(std::holds_alternative<Unseen>(seen_with(1e-10, 1e-2)));
}

TEST_CASE("Itinerary: a box of errors grows by every rounding, and by what its map stretches") {
  ErrorBox<3>::Matrix still{}, stretch{};
  for (int i = 0; i < 3; ++i) still[i][i] = stretch[i][i] = Ball(1);
  stretch[0][0] = Ball(8);
  stretch[0][1] = Ball(-8);
  ErrorBox<3> box({Bound(1e-9), Bound(), Bound(1e-12)});
  for (int k = 0; k < 10; ++k) box.advance(still, {Bound(1e-9), Bound(1e-10), Bound(1e-12)});
  CHECK(width(box, 0) >= 11e-9);
  CHECK(width(box, 0) <= 11.1e-9);
  CHECK(width(box, 1) >= 1e-9);
  CHECK(width(box, 2) >= 11e-12);
  // 8 (e0 - e1): a corner of the box comes to that.
  box.advance(stretch, {});
  CHECK(width(box, 0) >= 8 * 12e-9);
  CHECK(width(box, 0) <= 8 * 12.2e-9);
  CHECK(width(box, 1) >= 1e-9);
}

namespace {

// Every component of the state moved by 2^-200, one after another: what the derivative says of it against
// what the collision makes of it.
template <std::size_t D>
void check_derivative(const ExactAtom<D>& atom, const State<D>& state) {
  const Ball::WorkingPrecision precision(600);
  const Form<D> form(atom);
  const auto before = collide(state, form);
  REQUIRE(before);
  const Ball step = scaled(Ball(1), -200);
  for (std::size_t k = 0; k < 2 * D + 1; ++k) {
    State<D> change, moved = state;
    (k < D ? change.y[k] : k < 2 * D ? change.v[k - D] : change.t) = Ball(1);
    (k < D ? moved.y[k] : k < 2 * D ? moved.v[k - D] : moved.t) += step;
    const auto after = collide(moved, form);
    REQUIRE(after);
    const State<D> told = derivative(*before, form, change);
    const auto same = [&](const Ball& a, const Ball& b, const Ball& says) {
      CHECK(((b - a) / step).nearest() == Approx(says.nearest()).margin(1e-12));
    };
    for (std::size_t i = 0; i < D; ++i) {
      same(before->after.y[i], after->after.y[i], told.y[i]);
      same(before->after.v[i], after->after.v[i], told.v[i]);
    }
    same(before->after.t, after->after.t, told.t);
  }
}

}  // namespace

TEST_CASE("Itinerary: the derivative of a collision is what small changes become") {
  IntegerScene<2> plane = discs();
  plane.lattices[0].atoms[0].semiaxes = {ZVec<2>{200, 50}, ZVec<2>{-30, 100}};
  State<2> flat;
  flat.y = {Ball(-700), Ball(-215)};
  flat.v = {Ball(3), Ball(1)};
  check_derivative(ExactScene<2>(discs()).lattices[0].atoms[0], flat);
  check_derivative(ExactScene<2>(plane).lattices[0].atoms[0], flat);
  IntegerScene<3> space;
  auto& lattice = space.lattices.emplace_back();
  lattice.vectors = {ZVec<3>{1000, 0, 0}, ZVec<3>{0, 1000, 0}, ZVec<3>{0, 0, 1000}};
  lattice.atoms.push_back({{0, 0, 0}, 300, std::nullopt});
  lattice.atoms.push_back(
      {{0, 0, 0}, 0, std::array<ZVec<3>, 3>{ZVec<3>{300, 20, 0}, ZVec<3>{0, 200, 10}, ZVec<3>{30, 0, 150}}});
  State<3> state;
  state.y = {Ball(-800), Ball(-60), Ball(90)};
  state.v = {Ball(18), Ball(2), Ball(-1)};
  const ExactScene<3> exact(space);
  for (const auto& atom : exact.lattices[0].atoms) check_derivative(atom, state);
}
