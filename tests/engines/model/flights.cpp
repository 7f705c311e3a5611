// The engine `reduction` on flights among discs on the unit square, for comparing it with its model, to the bit.
// flights COUNT SEED draws flights; flights reads such lines and prints what the engine says and what it computed on
// the way, as the model does (flights.ml).
//
// `make -C oracle/proof same_bits FLIGHTS=1000000` compares the two on a million flights; ./run proof on fewer.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include <lorentz/reduction.hpp>
#include <lorentz/scene.hpp>
#include "src/engines/reduction/atom_direction.hpp"
#include "src/engines/reduction/atom_start.hpp"
#include "src/engines/reduction/search_2d.hpp"

namespace lorentz {
namespace {

// 3 2^-5 is "3/-5".
void show(double a) {
  if (a == 0) return void(std::printf(" 0"));
  int e;
  auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(a, &e), 53));
  for (e -= 53; m % 2 == 0; m /= 2) ++e;
  std::printf(" %" PRId64 "/%d", m, e);
}

struct Way : RowsOf2<SplitProduct, SplitProduct, true, true> {
  using Rows = RowsOf2<SplitProduct, SplitProduct, true, true>;
  Way(const Direction& to, const Bravais& lattice, const Offset<SplitProduct, 2>& offset)
      : Rows(to, lattice, offset) {}
  void print() {
    const auto& to = to_;
    if (!to.usable || !set_anchor(true)) return void(std::printf(" unusable"));
    for (const auto* arm : {&to.R, &to.L}) {
      std::printf(" %.0f %.0f", arm->n[0], arm->n[1]);
      show(arm->D);
    }
    std::printf(to.sigma < 0 ? " -" : " +");
    for (double a : {to.rho, to.R.S, to.L.S, to.inverse_A, to.inverse_S_L, y_, y_error_, s_, s_error_,
                     row_beside_start(), reach_of_rows(), slope_of_rows()})
      show(a);
    if (to.rises) show(to.inverse_D_L);
    std::printf(are_in_order() ? " in order" : " not in order");
  }
};

void fly(const double (&a)[5], const ObstacleId* from) {
  const Scene scene = unit_scene(2, a[4]);
  const Reduction engine(scene);
  Query query;
  query.x = {a[0], a[1], 0}, query.v = {a[2], a[3], 0};
  if (from) query.from = *from;
  const Flight flight = engine.fly(query);
  const PreparedScene prepared = prepare(scene);
  const AtomDirection<2, true, true> to(SplitProduct{}, prepared.atoms[0], query.v);
  AtomStart<2, true, true> start;
  start.set<SplitProduct>(prepared.atoms[0], query.x);
  Offset<SplitProduct, 2> turned;
  to.octant.apply(start.offset.d, turned.d), turned.error = start.offset.error;
  Stage stage = flight.stage;
  Wide leaving[2], there[2];
  if (from && start.find_from(from, leaving) && leaving[0].hi == 0 && leaving[1].hi == 0) {
    // Whether x lies in `from` makes no difference: what counts is the stage of the search.
    const Ray ray{query.x, query.v, from, query.v};
    const Task task{prepared, ray, query.x, HUGE_VAL, HUGE_VAL, Reduction::Time::close};
    Search2<SplitProduct, true, true> search(prepared.atoms[0], to.direction, turned, {task, start});
    to.octant.apply(leaving, there);
    search.run(there, HUGE_VAL);
    stage = search.found.stage;
  }
  if (stage != Stage::binary64 || flight.outcome == Outcome::undecided)
    return void(std::printf("undecided\n"));
  if (flight.outcome == Outcome::hit || flight.outcome == Outcome::inside)
    std::printf("%s %" PRId64 " %" PRId64, flight.outcome == Outcome::hit ? "hit" : "inside", flight.cell[0],
                flight.cell[1]);
  else
    std::printf("never");
  if (flight.outcome != Outcome::inside) {
    std::printf(" |");
    Way(to.direction, prepared.atoms[0], turned).print();
  }
  std::printf("\n");
}

void draw(long count, unsigned seed) {
  std::mt19937_64 random(seed);
  auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (long i = 0; i < count; ++i) {
    const double r = std::exp2(-1 - 14.9 * uniform()), size = std::exp2(40 * uniform() * (random() % 4 == 0));
    double x[2], v[2];
    for (double& c : x) c = (uniform() - 0.5) * 2 * size;
    const double angle = 6.283185307179586 * uniform(), speed = 1 + uniform();
    v[0] = speed, v[1] = speed * std::tan(angle / 8);
    if (random() % 8 == 0) v[1] = v[0] * std::exp2(-60 * uniform());
    if (random() % 8 == 0) v[1] = v[0] * static_cast<double>(random() % 9) / 8;
    if (!(v[1] < 2)) v[1] = 1;
    if (random() % 2) std::swap(v[0], v[1]);
    for (double& c : v)
      if (random() % 2 && c != 0) c = -c;
    const bool leaving = random() % 4 == 0;
    if (leaving) {  // from the surface of the disc 0
      const double at = 6.283185307179586 * uniform();
      x[0] = r * std::cos(at), x[1] = r * std::sin(at);
    }
    std::printf("%a %a %a %a %a %s\n", x[0], x[1], v[0], v[1], r, leaving ? "0 0" : "- -");
  }
}

}  // namespace
}  // namespace lorentz

int main(int count, char** words) {
  if (count == 3) return lorentz::draw(std::atol(words[1]), std::atol(words[2])), 0;
  char line[512], i[32], j[32];
  while (std::fgets(line, sizeof line, stdin)) {
    double a[5];
    if (std::sscanf(line, "%la %la %la %la %la %31s %31s", a, a + 1, a + 2, a + 3, a + 4, i, j) != 7)
      return 2;
    lorentz::ObstacleId from;
    from.cell = {std::atoll(i), std::atoll(j), 0};
    lorentz::fly(a, *i == '-' && i[1] == 0 ? nullptr : &from);
  }
}
