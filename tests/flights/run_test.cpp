// Runs: the same counts with any number of threads and shards, and however often they were killed.
#include <catch2/catch.hpp>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include <lorentz/errors.hpp>
#include <lorentz/oracle.hpp>
#include "report/runs/world.hpp"
#include "statistics/flights/run.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using namespace lorentz::flights;
using namespace lorentz::starts;
using test::Folder;

namespace {

FlightsPlan plan_of(Scene scene, std::uint64_t count, Ensemble from = Ensemble::uniform) {
  FlightsPlan plan;
  plan.scene = std::move(scene);
  plan.from = from;
  plan.seed = 7401;
  plan.count = count;
  return plan;
}

Account flown(const FlightsPlan& plan, const FlightBounds& bounds = {}) {
  Account account = Account::begun(plan);
  run(plan, bounds, account);
  return account;
}

Scene fcc_like() {
  return test::one_atom(3, {Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}}, 0.2);
}

}  // namespace

TEST_CASE("Any number of threads and shards counts the same", "[flights]") {
  for (const Ensemble from : {Ensemble::uniform, Ensemble::surface}) {
    const FlightsPlan plan = plan_of(unit_scene(2, 0.3), 5 * kBlock + 321, from);
    const Account one = flown(plan);
    CHECK(one.tally.flights() == plan.count);
    CHECK(one.done.size() == 6);
    CHECK(one.tally.undecided == 0);
    if (from == Ensemble::uniform) CHECK(one.tally.inside > 0);
    CHECK(flown(plan, {.jobs = 3}) == one);
    Account sum = Account::begun(plan);
    for (std::uint64_t shard : {2, 0, 1}) {
      const Account part = flown(plan, {.jobs = 2, .shard = shard, .shards = 3});
      CHECK(part.done.size() == 2);
      sum.add(part);
    }
    CHECK(sum.text() == one.text());
  }
}

TEST_CASE("A tally counts what the oracle says of each start", "[flights]") {
  for (const Scene& scene : {unit_scene(2, 0.2), fcc_like()})
    for (const Ensemble from : {Ensemble::uniform, Ensemble::surface})
      for (const char* engine : {"batch", "certified-batch", "reduction", "certified", "oracle"}) {
        FlightsPlan plan = plan_of(scene, 3000, from);
        plan.engine = engine;
        INFO(engine);
        const Candidates starts(scene, from, plan.seed, plan.cells);
        const oracle::Oracle exact(scene);
        std::uint64_t inside = 0, hits = 0;
        double sum = 0;
        for (std::uint64_t i = 0; i < plan.count; ++i)
          for (std::uint64_t attempt = 0;; ++attempt) {
            Query query;
            starts.draw(i, attempt, query);
            const Answer answer = exact.first_hit(query);
            inside += answer.outcome == Outcome::inside;
            if (answer.outcome == Outcome::inside) continue;
            hits += answer.outcome == Outcome::hit;
            sum += answer.time.value_or(0);
            break;
          }
        const Account account = flown(plan);
        CHECK(account.tally.hits == hits);
        CHECK(account.tally.inside == inside);
        CHECK(account.tally.mean() == Approx(sum / static_cast<double>(hits)).epsilon(1e-12));
      }
}

// The plan takes minutes, so that no run is done before it is killed: it is killed by what it has done.
TEST_CASE("A run killed at any moment is gone on with, and counts the same", "[flights]") {
  const FlightsPlan plan = plan_of(unit_scene(2, 1e-3), 100'000 * kBlock);
  const Folder folder;
  const std::string path = folder.file("store");
  const auto stored = [&] {
    return std::filesystem::exists(path) ? Account::of(folder.read("store")) : Account::begun(plan);
  };
  for (std::uint64_t blocks = 0, kills = 0; kills < 5; ++kills) {
    const pid_t child = fork();
    if (child == 0) {
      Account account = stored();
      run(plan, {.jobs = 2}, account, [&](const Account& so_far) {
        std::ofstream(path + ".new") << so_far.text();
        std::filesystem::rename(path + ".new", path);
      });
      _exit(0);
    }
    while (stored().done.size() < blocks + 5) usleep(1000);
    kill(child, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    blocks = stored().done.size();
  }
  const Account account = stored();
  CHECK(account.done.size() < plan.blocks());
  FlightBounds these{.jobs = 2};  // the same blocks at one go
  for (std::uint64_t block = 0; block < plan.blocks(); ++block)
    if (!contains(account.done, block)) these.done += block;
  CHECK(flown(plan, these).text() == account.text());
}

TEST_CASE("Where obstacles leave no room there is nowhere to start", "[flights]") {
  FlightsPlan plan = plan_of(unit_scene(2, 7.5), 10'000);
  CHECK_THROWS_WITH(flown(plan), Catch::Contains("certified does such scenes"));
  plan = plan_of(unit_scene(2, 0.75), 10'000);
  CHECK_THROWS_WITH(flown(plan), Catch::Contains("no free start in 100000 draws"));
}

TEST_CASE("A run that has time enough is whole", "[flights]") {
  const FlightsPlan plan = plan_of(unit_scene(2, 0.3), 3 * kBlock);
  for (const double seconds : {3600.0, 1e300}) CHECK(flown(plan, {.seconds = seconds}) == flown(plan));
}

TEST_CASE("Two processes or more are several, and need MPI", "[flights]") {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    for (const auto& [size, several] : {std::pair("0", false), {"1", false}, {"2", true}, {"3", true}}) {
      ::setenv(name, size, 1);
      INFO(name << "=" << size);
      if (!several || runs::has_mpi())
        CHECK(runs::are_several("--jobs") == several);
      else
        CHECK_THROWS_WITH(runs::are_several("--jobs"), Catch::EndsWith("--jobs"));
      ::unsetenv(name);
    }
  CHECK_FALSE(runs::are_several("--jobs"));
}
