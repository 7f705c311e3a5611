// <lorentz/lorentz.h> as a program in C sees it: exact answers, each error, threads.
#include <lorentz/lorentz.h>
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
constexpr const char* kSquare =
    R"({"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.1}]}]})";

using Asker = std::unique_ptr<lorentz_asker, decltype(&lorentz_close)>;

Asker asker_for(const std::string& scene, const char* engine = nullptr) {
  return {lorentz_open(scene.c_str(), engine), lorentz_close};
}

Asker asker_for(const Scene& scene, const char* engine = nullptr) {
  std::string line;
  append_scene_line(line, scene);
  return asker_for(line, engine);
}

std::string why(const Asker& asker) {
  const char* const text = lorentz_why(asker.get());
  return text ? text : "";
}

/// Columns of queries, and of answers, whose values no answer has before.
struct Columns {
  std::vector<double> x[3], v[3], max_time, time;
  std::vector<std::int32_t> from_lattice, from_atom, outcome, lattice, atom;
  std::vector<std::int64_t> from_cell[3], cell[3];

  void add(const Query& query, double limit = kForEver) {
    for (int k = 0; k < 3; ++k) x[k].push_back(query.x[k]), v[k].push_back(query.v[k]);
    max_time.push_back(limit);
    from_lattice.push_back(query.from ? query.from->lattice : -1);
    from_atom.push_back(query.from ? query.from->atom : -1);
    for (int k = 0; k < 3; ++k) from_cell[k].push_back(query.from ? query.from->cell[k].int64() : 0);
    time.push_back(-1), outcome.push_back(-1), lattice.push_back(-1), atom.push_back(-1);
    for (auto& column : cell) column.push_back(-1);
  }

  lorentz_queries queries() const {
    return {static_cast<std::int64_t>(time.size()),
            {x[0].data(), x[1].data(), x[2].data()},
            {v[0].data(), v[1].data(), v[2].data()},
            from_lattice.data(),
            from_atom.data(),
            {from_cell[0].data(), from_cell[1].data(), from_cell[2].data()}};
  }
  lorentz_answers answers() {
    return {outcome.data(),
            lattice.data(),
            atom.data(),
            {cell[0].data(), cell[1].data(), cell[2].data()},
            time.data()};
  }

  std::int32_t ask(const Asker& asker, bool limited = false) {
    const lorentz_queries asked = queries();
    const lorentz_answers told = answers();
    return lorentz_first_hits(asker.get(), &asked, limited ? max_time.data() : nullptr, &told);
  }

  std::string row(std::size_t i, int dimension) const {
    std::string text =
        std::to_string(outcome[i]) + ' ' + std::to_string(lattice[i]) + ' ' + std::to_string(atom[i]);
    for (int k = 0; k < dimension; ++k) text += ' ' + std::to_string(cell[k][i]);
    append_number(text += ' ', std::isnan(time[i]) ? -1 : time[i]);
    return text;
  }
};

// What the row must be: as Columns::row, from the oracle's answer.
std::string row_of(const Answer& answer, int dimension) {
  static constexpr std::pair<Outcome, int> kPlain[] = {{Outcome::never, LORENTZ_NEVER},
                                                       {Outcome::later, LORENTZ_LATER},
                                                       {Outcome::undecided, LORENTZ_UNDECIDED}};
  Columns one;
  one.add({});
  one.lattice[0] = one.atom[0] = one.cell[0][0] = one.cell[1][0] = one.cell[2][0] = 0;
  for (const auto& [outcome, code] : kPlain)
    if (answer.outcome == outcome) one.outcome[0] = code;
  if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) {
    const Cell& cell = answer.obstacle.cell;
    const bool fits = cell[0].fits_int64() && cell[1].fits_int64() && cell[2].fits_int64();
    one.outcome[0] = answer.outcome == Outcome::hit ? LORENTZ_HIT : LORENTZ_INSIDE;
    if (!fits) one.outcome[0] = LORENTZ_FAR;
    one.lattice[0] = answer.obstacle.lattice, one.atom[0] = answer.obstacle.atom;
    for (int k = 0; k < dimension && fits; ++k) one.cell[k][0] = cell[k].int64();
    if (answer.outcome == Outcome::hit) one.time[0] = *answer.time;
  }
  return one.row(0, dimension);
}

// Half of the queries that hit get a limit at the time of the hit, or a bit beside it.
double limit_for(Draw& draw, const Answer& exact) {
  const double time = exact.time.value_or(kForEver);
  if (draw.one_in(2) || !(time > 0x1p-1000) || std::isinf(time)) return kForEver;
  return draw.one_in(3) ? time : std::nextafter(time, draw.one_in(2) ? 0 : kForEver);
}

}  // namespace

TEST_CASE("From C: the answers are the oracle's, to the bit", "[c]") {
  Draw draw(1);
  std::map<int, int> seen;
  std::size_t rows = 0;
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t first = 0; first < 320; first += cases::kCasesPerScene) {
      const Scene scene = target.make(1, first).scene;
      const Asker asker = asker_for(scene);
      REQUIRE(why(asker) == "");
      const oracle::Oracle oracle(scene);
      Columns columns;
      std::vector<std::string> free, limited;
      for (std::uint64_t i = first; i < first + cases::kCasesPerScene; ++i) {
        const cases::Case one = target.make(1, i);
        bool fits = one.scene == scene;
        if (one.query.from)
          for (const Integer& n : one.query.from->cell) fits &= n.fits_int64();
        if (!fits) continue;
        const Answer exact = oracle.first_hit(one.query);
        const double limit = limit_for(draw, exact);
        columns.add(one.query, limit);
        free.push_back(row_of(exact, scene.dimension));
        oracle::Request request;
        if (limit < kForEver) request.max_time = limit;
        limited.push_back(row_of(oracle.first_hit(one.query, request), scene.dimension));
      }
      for (const bool with_limits : {true, false}) {  // without them after with them: nothing may stay
        REQUIRE(columns.ask(asker, with_limits) == LORENTZ_DONE);
        for (std::size_t i = 0; i < free.size(); ++i) {
          INFO(target.name() << ", row " << i);
          REQUIRE(columns.row(i, scene.dimension) == (with_limits ? limited : free)[i]);
          ++seen[columns.outcome[i]], ++rows;
        }
      }
    }
  CHECK(rows > 20'000);
  for (int outcome = LORENTZ_HIT; outcome <= LORENTZ_FAR; ++outcome) {
    if (outcome == LORENTZ_UNDECIDED || outcome == LORENTZ_UNSUPPORTED) continue;
    INFO(outcome);
    CHECK(seen[outcome] > 20);
  }
}

TEST_CASE("From C: more rows than are answered together, and columns that are left out", "[c]") {
  Draw draw(2);
  const Scene scene = unit_scene(2, 0.1);
  const oracle::Oracle oracle(scene);
  const Asker asker = asker_for(kSquare);
  Columns all;
  for (int i = 0; i < 9000; ++i) all.add({draw.vec(2, 0, 1), draw.vec(2, -1, 1), {}});
  REQUIRE(all.ask(asker) == LORENTZ_DONE);
  lorentz_queries queries = all.queries();
  queries.x[2] = queries.v[2] = nullptr;
  queries.from_lattice = queries.from_atom = nullptr;
  for (auto& column : queries.from_cell) column = nullptr;
  std::vector<std::int32_t> outcome(9000, -1);
  lorentz_answers answers{};
  answers.outcome = outcome.data();
  REQUIRE(lorentz_first_hits(asker.get(), &queries, nullptr, &answers) == LORENTZ_DONE);
  CHECK(outcome == all.outcome);
  for (const std::size_t i : {std::size_t{0}, std::size_t{4095}, std::size_t{4096}, std::size_t{8999}}) {
    const Query query{{all.x[0][i], all.x[1][i], 0}, {all.v[0][i], all.v[1][i], 0}, {}};
    CHECK(all.row(i, 2) == row_of(oracle.first_hit(query), 2));
  }
  Columns none;
  CHECK(none.ask(asker) == LORENTZ_DONE);
}

TEST_CASE("From C: other engines by name, in their own words", "[c]") {
  const Query plain{{0, 0.445, 0}, {1, 0.01, 0}, {}}, hard{{0, 0.45, 0}, {1e17, 1, 0}, {}};
  for (const char* engine : {"oracle", "walk", "certified", "reduction", "batch", "published"}) {
    INFO(engine);
    const Asker asker = asker_for(kSquare, engine);
    Columns columns;
    columns.add(plain);
    REQUIRE(columns.ask(asker) == LORENTZ_DONE);
    CHECK(columns.outcome[0] == LORENTZ_HIT);
  }
  const Asker
      cubic = asker_for(unit_scene(3, 0.1), "classical"),
      layered = asker_for(
          R"({"dimension":2,"lattices":[{"vectors":[[1,0]],"atoms":[{"position":[0,0],"radius":0.1}]}]})",
          "published");
  Columns columns;
  columns.add(plain);
  CHECK(columns.ask(layered) == LORENTZ_DONE);
  CHECK(columns.outcome[0] == LORENTZ_UNSUPPORTED);
  CHECK(why(layered) == "");
}

TEST_CASE("From C: scenes and engines that are refused, with the place", "[c]") {
  const auto refusal = [](const std::string& scene, const char* engine = nullptr) {
    const Asker asker = asker_for(scene, engine);
    Columns columns;
    columns.add({{0.5, 0.5, 0}, {1, 0, 0}, {}});
    CHECK(columns.ask(asker) == LORENTZ_REFUSED);
    CHECK(columns.outcome[0] == -1);
    return why(asker);
  };
  using Catch::Contains;
  CHECK(refusal("") == "is empty: a scene needs dimension and lattices");
  CHECK_THAT(refusal("{\n\"dimension\":2,,}"), Contains("line 2") && Contains("not JSON"));
  CHECK_THAT(refusal("dimension = 2\nlattices ="), Contains("not TOML"));
  CHECK(refusal(R"({"dimension":4,"lattices":[]})") == "dimension: must be 2 or 3");
  CHECK_THAT(
      refusal(R"({"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0]}]}]})"),
      Contains("lattices[0].atoms[0]: radius is missing"));
  CHECK_THAT(
      refusal(
          R"({"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":1,"color":1}]}]})"),
      Contains("the key \"lattices.atoms.color\" is not known"));
  CHECK_THAT(
      refusal(
          R"({"dimension":2,"lattices":[{"vectors":[[1,0],[2,0]],"atoms":[{"position":[0,0],"radius":1}]}]})"),
      Contains("linearly dependent"));
  CHECK_THAT(
      refusal(
          R"({"dimension":2,"lattices":[{"vectors":[[1,0],[2,0]],"atoms":[{"position":[0,0],"radius":1}]}]})",
          "reduction"),
      Contains("linearly dependent"));
  CHECK_THAT(refusal(kSquare, "orcale"),
             Contains("engine: \"orcale\" is not one of classical") && Contains("oracle, walk"));
  CHECK_THAT(refusal(kSquare, "cmd:./mine"), Contains("cmd:./mine"));
  const Asker nothing(lorentz_open(nullptr, nullptr), lorentz_close);
  CHECK_THAT(why(nothing), Contains("scene: is NULL"));
  CHECK(lorentz_why(nullptr) == std::string("out of memory"));
  CHECK(lorentz_first_hits(nullptr, nullptr, nullptr, nullptr) == LORENTZ_FAILED);
  lorentz_close(nullptr);
  CHECK(lorentz_interface() == LORENTZ_INTERFACE);
}

TEST_CASE("From C: a row that is not a query is named, and the others are answered", "[c]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Query good{{0.5, 0.5, 0}, {1, 1e-3, 0}, {}};
  const Asker asker = asker_for(kSquare);
  Columns columns;
  for (int i = 0; i < 5000; ++i) columns.add(good);
  columns.v[1][4500] = nan;
  columns.v[0][4700] = columns.v[1][4700] = 0;
  columns.from_lattice[4800] = 7;
  CHECK(columns.ask(asker) == LORENTZ_BAD_ROWS);
  CHECK_THAT(why(asker), Catch::StartsWith("row 4500: ") && Catch::Contains("v"));
  for (const std::size_t i : {4500, 4700, 4800}) CHECK(columns.outcome[i] == LORENTZ_INVALID);
  CHECK(std::count(columns.outcome.begin(), columns.outcome.end(), LORENTZ_HIT) == 4997);
  columns.v[1][4500] = columns.v[1][4700] = columns.v[0][4700] = 1;
  columns.from_lattice[4800] = -1;
  columns.max_time[3] = 0;
  CHECK(columns.ask(asker, true) == LORENTZ_BAD_ROWS);
  CHECK(why(asker) == "row 3: max_time must be above zero");
  CHECK(columns.ask(asker) == LORENTZ_DONE);
  CHECK(why(asker) == "");
}

TEST_CASE("From C: columns that are missing are named", "[c]") {
  const Asker asker = asker_for(unit_scene(3, 0.1));
  Columns columns;
  columns.add({{0.5, 0.5, 0.5}, {1, 0, 0}, {}});
  const auto refusal = [&](const auto& spoil) {
    lorentz_queries queries = columns.queries();
    lorentz_answers answers = columns.answers();
    spoil(queries, answers);
    CHECK(lorentz_first_hits(asker.get(), &queries, nullptr, &answers) == LORENTZ_REFUSED);
    CHECK(columns.outcome[0] == -1);
    return why(asker);
  };
  CHECK(refusal([](auto& queries, auto&) { queries.x[2] = nullptr; }) == "the column x[2] is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.x[0] = queries.x[1] = queries.v[0] = nullptr; }) ==
        "the column x[0] is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.v[0] = nullptr; }) == "the column v[0] is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.from_atom = nullptr; }) ==
        "the column from_atom is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.from_lattice = nullptr; }) ==
        "the column from_lattice is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.from_cell[1] = nullptr; }) ==
        "the column from_cell[1] is missing");
  CHECK(refusal([](auto&, auto& answers) { answers.outcome = nullptr; }) == "the column outcome is missing");
  CHECK(refusal([](auto& queries, auto&) { queries.count = -1; }) == "count: must not be below 0");
  const lorentz_queries queries = columns.queries();
  CHECK(lorentz_first_hits(asker.get(), &queries, nullptr, nullptr) == LORENTZ_REFUSED);
  CHECK(why(asker) == "queries and answers: must not be NULL");
}

TEST_CASE("From C: arithmetic that would void the answers is refused", "[c]") {
  const Asker asker = asker_for(kSquare);
  Columns columns;
  columns.add({{0.5, 0.5, 0}, {1, 1e-3, 0}, {}});
  std::fesetround(FE_UPWARD);
  const std::int32_t status = columns.ask(asker);
  std::fesetround(FE_TONEAREST);
  CHECK(status == LORENTZ_REFUSED);
  CHECK_THAT(why(asker), Catch::Contains("rounding mode: upward, not to nearest"));
}

TEST_CASE("From C: several threads, each with an asker", "[c][threads]") {
  Draw draw(3);
  Columns all;
  for (int i = 0; i < 20'000; ++i) all.add({draw.vec(2, 0, 1), draw.vec(2, -1, 1), {}});
  REQUIRE(all.ask(asker_for(kSquare)) == LORENTZ_DONE);
  std::vector<Columns> by_thread(2, all);
  std::vector<std::string> said(2);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 2; ++t)
    threads.emplace_back([&, t] {
      Columns& mine = by_thread[t];
      mine.outcome.assign(mine.outcome.size(), -1);
      mine.v[0][t] = mine.v[1][t] = 0;
      for (int round = 0; round < 20; ++round) {
        const Asker asker = asker_for(kSquare);
        mine.ask(asker);
        said[t] = why(asker);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < 2; ++t) {
    CHECK_THAT(said[t], Catch::StartsWith("row " + std::to_string(t) + ": "));
    CHECK(by_thread[t].outcome[t] == LORENTZ_INVALID);
    for (std::size_t i = 2; i < 20'000; ++i)
      if (by_thread[t].row(i, 2) != all.row(i, 2)) FAIL("thread " << t << ", row " << i);
  }
}
