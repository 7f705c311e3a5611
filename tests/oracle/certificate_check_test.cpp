// The check of certificates: proofs of drawn answers pass, false answers do not, whatever is tampered with.
#include "tests/oracle/certificate_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::test::proofs;

TEST_CASE("Proofs of drawn answers are accepted", "[oracle][certificate_check]") {
  Draw draw(2101);
  INFO("seed 2101");
  std::map<Outcome, int> outcomes;
  int with_from = 0, ellipsoids = 0, several = 0;
  for (int i = 0; i < 3000; ++i) {
    const Case c = drawn(draw);
    require_accepted(c);
    ++outcomes[c.answer.outcome];
    with_from += c.query.from.has_value();
    ellipsoids += !c.scene.lattices[0].atoms[0].is_ball();
    several += c.scene.lattices.size() + c.scene.lattices[0].atoms.size() > 2;
  }
  CHECK(outcomes[Outcome::hit] > 1000);                     // 1 164 seen
  CHECK(outcomes[Outcome::inside] > 1400);                  // 1 794 seen
  CHECK(outcomes[Outcome::never] > 30);                     // 42 seen
  CHECK(std::min({with_from, ellipsoids, several}) > 300);  // 483 seen
}

TEST_CASE("Proofs of long flights among small obstacles are accepted", "[oracle][certificate_check]") {
  Draw draw(2102);
  INFO("seed 2102");
  double longest = 0;
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = unit_scene(dimension, std::exp2(draw.between(dimension == 2 ? -25 : -12, -5)));
    if (draw.one_in(2)) {
      const double r = scene.lattices[0].atoms[0].radius;
      scene = scene_of(draw, Style::generic, dimension);
      for (Lattice& lattice : scene.lattices)
        for (Atom& atom : lattice.atoms) atom.radius = r;
    }
    const Case c = proved(scene, {draw.vec(dimension, 0.2, 0.8), draw.vec(dimension, -1, 1), {}},
                          draw.one_in(2) ? 1 : 20);
    require_accepted(c);
    if (c.answer.time) longest = std::max(longest, *c.answer.time);
  }
  CHECK(longest > 1e5);
}

TEST_CASE("Any basis and any cutting of the windows proves the same", "[oracle][certificate_check]") {
  Draw draw(2103);
  INFO("seed 2103");
  int accepted = 0;
  for (int i = 0; i < 600; ++i) {
    Case c = drawn_hit(draw);
    if (*c.answer.time > 1000) continue;  // a bad basis has too many rows
    for (Window& window : c.proof.windows)
      window.basis = skewed(draw, window.basis, c.scene.dimension, static_cast<int>(draw.below(6)));
    // Two vectors of a solid basis may end up at right angles to the flight: then it is refused.
    INFO(text(c));
    const std::string said = refutation(c);
    REQUIRE((said.empty() || said.find("right angles") != std::string::npos));
    accepted += said.empty();
  }
  CHECK(accepted > 500);  // 588 seen
}

TEST_CASE("Another obstacle than the first is refused, whatever the proof holds",
          "[oracle][certificate_check]") {
  Draw draw(2104);
  INFO("seed 2104");
  int later = 0, neighbours = 0;
  for (int i = 0; i < 1500; ++i) {
    const Case truth = drawn_hit(draw);
    if (*truth.answer.time > 1e4) continue;
    Case c = truth;
    if (draw.one_in(3)) {
      Integer& n = c.answer.obstacle.cell[draw.below(c.scene.dimension)];
      n = Integer(n.int64() + (draw.one_in(2) ? 1 : -1));
      ++neighbours;
    } else if (!c.query.from) {
      // What would be hit if the first were not there: its time is right, and so are the windows.
      Query after = c.query;
      after.from = c.answer.obstacle;
      c.answer = oracle::Oracle(c.scene).first_hit(after);
      if (c.answer.outcome != Outcome::hit || *c.answer.time > 1e4) continue;
      c.proof = proof_of(c.scene, after, c.answer, 1 + static_cast<int>(draw.below(3)));
      for (Window& window : c.proof.windows)
        window.basis = skewed(draw, window.basis, c.scene.dimension, static_cast<int>(draw.below(4)));
      ++later;
      INFO(text(c) << "before it: " << line(truth.answer, c.scene.dimension));
      const std::string said = refutation(c);
      REQUIRE_THAT(said, Catch::Contains("is entered earlier") ||
                             Catch::Contains("at the same time and comes first") ||
                             Catch::Contains("right angles"));
    }
    INFO(text(c));
    if (!(c.answer.obstacle == truth.answer.obstacle)) REQUIRE(refutation(c) != "");
  }
  CHECK(later > 500);       // 796 seen
  CHECK(neighbours > 300);  // 502 seen
}

TEST_CASE("No false answer passes with proofs tampered with at random", "[oracle][certificate_check]") {
  Draw draw(2105);
  INFO("seed 2105");
  int tried = 0;
  while (tried < 3000) {
    const Case truth = drawn_hit(draw);
    if (*truth.answer.time > 1e3 || truth.query.from) continue;
    Query after = truth.query;
    after.from = truth.answer.obstacle;
    Case c = proved(truth.scene, truth.query, oracle::Oracle(truth.scene).first_hit(after));
    if (c.answer.outcome != Outcome::hit) continue;
    if (draw.one_in(3)) c.answer = draw.one_in(2) ? Answer::never() : Answer::inside(truth.answer.obstacle);
    const Certificate whole = draw.one_in(2) ? c.proof : proof_of(c.scene, c.query, c.answer);
    for (int k = 0; k < 10; ++k, ++tried) {
      c.proof = whole;
      for (auto changes = 1 + draw.below(4); changes > 0 && !c.proof.windows.empty(); --changes) {
        Window& window = c.proof.windows[draw.below(c.proof.windows.size())];
        switch (draw.below(6)) {
          case 0:
            window.basis[draw.below(3)][draw.below(3)] = Integer(static_cast<int>(draw.below(5)) - 2);
            break;
          case 1:
            window.from = draw.between(-2, 3);
            break;
          case 2:
            window.to = draw.between(-2, 3);
            break;
          case 3:
            window.to = Integer(static_cast<int>(draw.below(5)) - 2);
            break;
          case 4:
            std::swap(window, c.proof.windows.back());
            break;
          default:
            c.proof.windows.push_back(window);
        }
      }
      if (draw.one_in(2)) c.proof.rows = proof_of(c.scene, c.query, Answer::never()).rows;
      if (draw.one_in(2)) c.proof.windows.clear();
      INFO(text(c));
      REQUIRE(refutation(c) != "");
    }
  }
}
