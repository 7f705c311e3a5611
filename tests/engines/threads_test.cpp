// One engine, oracle or judge for all threads: what the public headers promise.
#include <catch2/catch.hpp>

#include <lorentz/certified_batch.hpp>
#include <lorentz/verdict.hpp>
#include <lorentz/walk.hpp>
#include <thread>

#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

struct Answers {
  std::vector<Flight> flights;
  std::vector<Answer> certified, exact, walked;
  std::vector<double> departs;
};

// Everything that may be shared, by one thread.
struct Shared {
  Scene scene;
  std::vector<Query> queries;
  Reduction engine{scene};
  oracle::Certified certified{scene};
  oracle::Oracle oracle{scene};
  oracle::Walk walk{scene, 1000};
  oracle::Judge judge{scene};

  Answers all() const {
    Answers answers;
    for (const Query& query : queries) {
      answers.flights.push_back(engine.fly(query));
      answers.certified.push_back(certified.first_hit(query));
      answers.exact.push_back(oracle.first_hit(query));
      answers.walked.push_back(walk.first_hit(query));
      // Whether there is a corridor nearby takes a thousand times as long as all of the above.
      const bool asks_for_corridor = answers.exact.size() % 16 == 1;
      const Answer other = asks_for_corridor ? Answer::never() : Answer::hit(ObstacleId{}, 1);
      answers.departs.push_back(judge.judge(query, answers.exact.back(), other).departs);
    }
    return answers;
  }
};

bool same_answers(const Answers& a, const Answers& b) {
  bool same = a.departs == b.departs;
  for (std::size_t i = 0; i < a.flights.size(); ++i)
    same = same && same_bits(a.flights[i], b.flights[i]) && test::same(a.certified[i], b.certified[i]) &&
           test::same(a.exact[i], b.exact[i]) && test::same(a.walked[i], b.walked[i]);
  return same;
}

}  // namespace

TEST_CASE("Many threads may ask one engine, oracle, walk and judge", "[engines][threads]") {
  Draw draw(29);
  Scene scene = unit_scene(3, 0.2);
  scene.lattices[0].atoms.push_back(Atom{{0.5, 0.5, 0.5}, 0.1, {}});
  std::vector<Query> queries;
  for (int i = 0; i < 300; ++i) queries.push_back(hard_query(draw, Style::near_grid, scene));
  const Shared shared{scene, queries};
  const Answers alone = shared.all();
  std::vector<Answers> answers(4);
  std::vector<std::thread> threads;
  for (Answers& one : answers) threads.emplace_back([&shared, &one] { one = shared.all(); });
  for (std::thread& thread : threads) thread.join();
  for (const Answers& one : answers) CHECK(same_answers(one, alone));
}

TEST_CASE("Threads share a batch engine", "[engines][threads][batch]") {
  Draw draw(31);
  Scene scene = unit_scene(3, 0.2);
  scene.lattices[0].atoms.push_back(Atom{{0.5, 0.5, 0.5}, 0.1, {}});
  QueryTable table;
  for (int i = 0; i < 5000; ++i) table.push_back(hard_query(draw, Style::near_grid, scene));
  const Batch batch(scene);
  const oracle::CertifiedBatch certified(scene);
  struct Told {
    FlightTable flights, exact;
    std::vector<std::size_t> uncertain;
  };
  const auto ask = [&](Told& told, int jobs) {
    told.flights.resize(table.size()), told.exact.resize(table.size());
    batch.fly(table.columns(), told.flights.columns(), Batch::Time::close, jobs);
    certified.first_hits(table.columns(), told.exact.columns(), told.uncertain, jobs);
  };
  Told alone;
  ask(alone, 1);
  std::vector<Told> told(4);
  std::vector<std::thread> threads;
  for (Told& one : told) threads.emplace_back([&] { ask(one, 2); });
  for (std::thread& thread : threads) thread.join();
  for (const Told& one : told) {
    CHECK(one.uncertain == alone.uncertain);
    bool same_flights = true;
    for (std::size_t i = 0; i < table.size(); ++i)
      same_flights = same_flights && same_bits(one.flights[i], alone.flights[i]) &&
                     same_bits(one.exact[i], alone.exact[i]);
    CHECK(same_flights);
  }
}
