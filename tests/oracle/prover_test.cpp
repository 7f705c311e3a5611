// Certificates that the prover writes: accepted of right answers, refuted of wrong ones, and short.
#include <lorentz/prover.hpp>

#include <catch2/catch.hpp>

#include <lorentz/certificate_check.hpp>
#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::CertificateCheck;
using oracle::Oracle;
using oracle::Prover;

namespace {

constexpr std::uint64_t kSeed = 8001;

struct Tally {
  std::map<Outcome, int> by_outcome;
  int from = 0;
  std::size_t most_windows = 0;
};

// What the check says to the prover's certificate for an answer.
std::string refutation(const Scene& scene, const Query& query, const Answer& answer) {
  try {
    return CertificateCheck(scene).refutation(query, answer, Prover(scene).prove(query, answer)).value_or("");
  } catch (const InputError& error) {
    return error.what();  // the prover saw itself that there is nothing to prove
  }
}

Answer truth(const Scene& scene, const Query& query) {
  oracle::Request request;
  request.digits = 40;
  return Oracle(scene).first_hit(query, request);
}

void require_proved(const Scene& scene, const Query& query, Tally& tally) {
  const Answer exact = truth(scene, query);
  const oracle::Certificate proof = Prover(scene).prove(query, exact);
  INFO(stream(scene, query) << line(exact, scene.dimension));
  REQUIRE(CertificateCheck(scene).refutation(query, exact, proof).value_or("") == "");
  ++tally.by_outcome[exact.outcome];
  tally.from += query.from.has_value();
  tally.most_windows = std::max(tally.most_windows, proof.windows.size());
}

Scene drawn_scene(Draw& draw, Style style, int dimension) {
  const Scene scene = scene_of(draw, style, dimension);
  return draw.one_in(3) ? with_ellipsoids(draw, style, scene) : scene;
}

Style drawn_style(Draw& draw) {
  return std::array{Style::generic, Style::grid, Style::near_grid}[draw.below(3)];
}

}  // namespace

TEST_CASE("Prover: the proofs of drawn answers are accepted", "[oracle][prover]") {
  INFO("seed " << kSeed);
  Draw draw(kSeed);
  for (const int dimension : {2, 3}) {
    Tally tally;
    for (int i = 0; i < 400; ++i) {
      const Style style = drawn_style(draw);
      const Scene scene = drawn_scene(draw, style, dimension);
      for (int k = 0; k < 3; ++k) require_proved(scene, query_of(draw, style, scene), tally);
    }
    CHECK(tally.by_outcome[Outcome::hit] > 300);     // 419 seen at least
    CHECK(tally.by_outcome[Outcome::inside] > 520);  // 655 seen at least
    CHECK(tally.by_outcome[Outcome::never] > 5);     // 7 seen at least
    CHECK(tally.from > 100);                         // 196 seen at least
    CHECK(tally.most_windows < 100);                 // 4 seen
  }
}

TEST_CASE("Prover: the proofs of every family's answers are accepted", "[oracle][prover]") {
  INFO("seed " << kSeed);
  for (const cases::Family& family : cases::families()) {
    INFO(family.name());
    Tally tally;
    for (std::uint64_t index = 0; index < 1200; index += 8) {
      const cases::Case one = family.make(kSeed, index);
      require_proved(one.scene, one.query, tally);
    }
    CHECK(tally.most_windows < 600);  // 57 seen at most
  }
}

TEST_CASE("Prover: whatever it writes of a wrong answer is refuted", "[oracle][prover]") {
  INFO("seed " << kSeed);
  Draw draw(kSeed + 1);
  int later = 0, beside = 0, never = 0;
  for (int i = 0; i < 500; ++i) {
    const Style style = drawn_style(draw);
    const Scene scene = drawn_scene(draw, style, 2 + i % 2);
    Query query = query_of(draw, style, scene);
    query.from.reset();
    const Answer exact = truth(scene, query);
    const auto require_refuted = [&](const Answer& wrong) {
      INFO(stream(scene, query) << line(exact, scene.dimension) << line(wrong, scene.dimension));
      REQUIRE(refutation(scene, query, wrong) != "");
    };
    if (exact.outcome == Outcome::never) {
      require_refuted(Answer::hit({}, 1));
      require_refuted(Answer::inside({}));
      ++never;
      continue;
    }
    require_refuted(Answer::never());
    // The next obstacle on the way, with its own time; or the next that contains x.
    const Answer next = truth(scene, {query.x, query.v, exact.obstacle});
    if (next.outcome != Outcome::never) require_refuted(next), ++later;
    Answer other = exact;
    other.obstacle = obstacle_of(draw, scene);
    if (other.obstacle == exact.obstacle) continue;
    require_refuted(other);
    ++beside;
  }
  CHECK(later > 390);   // 488 seen
  CHECK(beside > 370);  // 472 seen
  CHECK(never > 9);     // 12 seen
}

TEST_CASE("Prover: few windows, however long the flight", "[oracle][prover]") {
  Tally tally;
  for (const double drift : {0x1p-20, 1e-9, 3e-17, 1e-30}) {
    for (const double radius : {0.3, 0.01, 1e-5}) {
      require_proved(unit_scene(2, radius), {{0, 0.5}, {1, drift}, {}}, tally);
      require_proved(unit_scene(2, radius), {{0.25, 0.5}, {1, 1 + drift}, {}}, tally);
    }
    for (const double radius : {0.3, 0.01}) {
      require_proved(unit_scene(3, radius), {{0, 0.5, 0.25}, {1, drift, drift / 3}, {}}, tally);
      require_proved(unit_scene(3, radius), {{0, 0.5, 0.25}, {1, drift, 0.618}, {}}, tally);
    }
  }
  CHECK(tally.by_outcome[Outcome::hit] > 30);  // 36 seen
  CHECK(tally.most_windows > 35);              // 49 seen
  CHECK(tally.most_windows < 100);             // 49 seen
}

TEST_CASE("Prover: nearly at right angles to lattice planes, at any angle", "[oracle][prover]") {
  Scene scene = unit_scene(3, 0.25);
  scene.lattices[0].vectors[1] = {0, 1 + 0x1p-49, 0};
  scene.lattices[0].vectors[2] = {0, 0x1p-8, 1};
  Tally tally;
  for (int k = 0; k < 1000; k += k < 100 ? 3 : 90)
    for (const Vec& x : {Vec{0, 0, 1}, {0.01, 0.02, 0.5}, {0.4, 0.3, 0.25}})
      for (const double z : {-1.1, 1.0})
        require_proved(scene, {x, {0x1.3p-16, 0.58, std::ldexp(z, k)}, {}}, tally);
  CHECK(tally.by_outcome[Outcome::inside] > 50);  // 88 seen
  CHECK(tally.by_outcome[Outcome::hit] > 100);    // 176 seen
}

TEST_CASE("Prover: never, with a velocity whose components have nothing in common", "[oracle][prover]") {
  Scene scene = unit_scene(3, 0x1p-14);
  scene.lattices[0].vectors[0] = {1, 3.09375, 4.71875};
  scene.lattices[0].vectors[2] = {0x1p-10, 0, 1};
  Tally tally;
  for (int k = 0; k < 1070; k += 107)
    for (const double z : {-2.221045572239388e+216, 0x1p1000})
      require_proved(scene, {{0.84, 0.64, 0}, {2.87e-322, 0, std::ldexp(z, -k)}, {}}, tally);
  CHECK(tally.by_outcome[Outcome::never] == 20);
}

TEST_CASE("Ends of windows: their text, and the binary64 that they are exactly", "[oracle][prover]") {
  using oracle::WindowEnd;
  const auto text = [](const WindowEnd& end) { return oracle::text_of(end); };
  const auto read = [&](const char* given) {
    const auto end = oracle::window_end_from(given);
    return end ? text(*end) : std::string("none");
  };
  CHECK(text(WindowEnd(500, -3)) == "0x1f4p-3");
  CHECK(text(WindowEnd(-500, 3)) == "-0x1f4p3");
  CHECK(text(WindowEnd(*Integer::from_decimal("-1180591620717411303424"), 0)) == "-0x400000000000000000p0");
  for (const char* good : {"0x0p0", "-0x1p-1100", "0x123456789abcdef0123456789p77", "-0xfp5"})
    CHECK(read(good) == good);
  CHECK(read("0x1") == "0x1p0");
  CHECK(read("0xAp1") == "0xap1");
  CHECK(read("+0x1p1") == "0x1p1");
  for (const char* bad : {"", "0x", "0xp1", "x1p1", "0x1p", "0x1p1 ", "0x1q1", "0x1p1.5", "--0x1p1", "1p1",
                          "0x1p99999999999999999999", "0x-1p1"}) {
    INFO(bad);
    CHECK(read(bad) == "none");
  }
  for (const double value : {0.0, 1.0, -0.1, 0x1.fffffffffffffp1023, 0x1p-1074, -0x1.8p-1070, 123456.0})
    CHECK(oracle::binary64_of(WindowEnd(value)) == value);
  CHECK(oracle::binary64_of(WindowEnd(500, -3)) == 62.5);
  CHECK(oracle::binary64_of(WindowEnd(Integer(std::int64_t{1} << 53), 0)) == 0x1p53);
  for (const WindowEnd& none :
       {WindowEnd(Integer((std::int64_t{1} << 53) + 1), 0),
        WindowEnd(Integer(-(std::int64_t{1} << 53) - 1), 0),
        WindowEnd(*Integer::from_decimal("1180591620717411303424"), 0), WindowEnd(1, 1024),
        WindowEnd(1, -1075), WindowEnd(3, -1075), WindowEnd(1, 5000), WindowEnd(1, -5000)})
    CHECK_FALSE(oracle::binary64_of(none));
}
