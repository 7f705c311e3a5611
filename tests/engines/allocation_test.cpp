// The reduction engine allocates nothing in a query: counted, by replacing the global operator new. (Not
// under the address sanitizer, which has an operator new of its own.)
#ifndef __SANITIZE_ADDRESS__

#include <catch2/catch.hpp>

#include <lorentz/batch.hpp>
#include "tests/support/count_allocations.hpp"

using lorentz::test::allocations;

TEST_CASE("A batch allocates nothing", "[engines][batch][allocation]") {
  using namespace lorentz;
  for (const int dimension : {2, 3}) {
    const Batch batch(unit_scene(dimension, 0.01));
    QueryTable table;
    for (int i = 0; i < 300; ++i)
      table.push_back(
          {{0.3, 0.2, dimension == 3 ? 0.7 : 0}, {0.61 + 0.001 * i, 0.23, dimension == 3 ? 0.3 : 0}, {}});
    FlightTable flights;
    flights.resize(table.size());
    const QueryColumns queries = table.columns();
    const FlightColumns columns = flights.columns();
    const long before = allocations;
    batch.fly(queries, columns, Batch::Time::close);
    batch.fly(queries, columns, Batch::Time::rounded);
    const long after = allocations;
    CHECK(after == before);
    CHECK(flights[299].outcome == Outcome::hit);
  }
}

TEST_CASE("A flight allocates nothing, in any model", "[engines][allocation]") {
  using namespace lorentz;
  for (const int dimension : {2, 3}) {
    Scene scene = unit_scene(dimension, 0.01);
    for (int model = 0; model < 3; ++model) {
      if (model == 1) scene.lattices[0].vectors[0][1] = 0.3;
      if (model == 2) scene.lattices[0].atoms.push_back(Atom{{0.5, 0.4, 0}, 0.02, {}});
      const Reduction engine(scene);
      Query query{{0.3, 0.2, dimension == 3 ? 0.7 : 0}, {0.61, 0.23, dimension == 3 ? 0.37 : 0}, {}};
      const long before = allocations;
      Answer answer;
      for (int i = 0; i < 1000; ++i) {
        query.v[0] += 0.001;
        answer = answer_of(engine.fly(query));
        engine.fly(query, 1e3, Reduction::Time::rounded);
      }
      const long after = allocations;
      CHECK(after == before);
      CHECK(answer.outcome == Outcome::hit);
    }
  }
  const long before = allocations;
  int* volatile one = new int(1);
  const long after = allocations;
  delete one;
  CHECK(after == before + 1);  // it does count
}

#endif
