// Proofs of `never`: rows along the flight, of every atom, none of which is met.
#include "tests/oracle/certificate_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::test::proofs;

TEST_CASE("never: rows that are met, missing, or not along the flight are refused",
          "[oracle][certificate_check]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.25);
    const Vec x{0.5, 0.5, 0};
    Case c = proved(scene, {x, {1, 0}, {}});
    REQUIRE(c.answer.outcome == Outcome::never);
    require_accepted(c);
    Case tampered = c;
    tampered.proof.rows.clear();
    require_refused(tampered, "lattice 0, atom 0: no rows");
    tampered = c;
    tampered.proof.rows.push_back(c.proof.rows[0]);
    require_refused(tampered, "other rows");
    tampered = c;
    tampered.proof.windows = proof_of(scene, c.query, Answer::hit({}, 1)).windows;
    require_refused(tampered, "other rows, or windows");
    tampered = c;
    std::swap(tampered.proof.rows[0].basis[0], tampered.proof.rows[0].basis[1]);
    require_refused(tampered, "not parallel");
    tampered = c;
    tampered.query.v = {1, 0x1p-1000};
    require_refused(tampered, "not parallel");
    tampered = c;
    for (Integer& n : tampered.proof.rows[0].basis[0]) n = Integer(-n.int64());  // either sense will do
    require_accepted(tampered);
    // A hit that claims to be `never`: the rows are right, and one is met; also if it is only that of `from`.
    for (const double y : {0.25 - 0x1p-53, -0.25 + 0x1p-54, 0.75 + 0x1p-53, 5.0, 0.0}) {
      tampered = c;
      tampered.query.x[1] = y;
      require_refused(tampered, "the line meets obstacle");
      tampered.query.from = ObstacleId{};
      require_refused(tampered, "the line meets obstacle");
    }
    for (const double y : {0.25, 0.75, -0.25, 7.25, 0.5}) {  // tangents
      tampered = c;
      tampered.query.x[1] = y;
      require_accepted(tampered);
    }
  }
}

TEST_CASE("never: any basis with b_1 along the flight proves the same, and a hit is never one",
          "[oracle][certificate_check]") {
  Draw draw(2110);
  INFO("seed 2110");
  int never = 0, hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = scene_of(draw, Style::grid, dimension);
    if (draw.one_in(3)) scene = with_ellipsoids(draw, Style::grid, scene);
    for (Lattice& lattice : scene.lattices)
      for (Atom& atom : lattice.atoms) {
        atom.radius /= 4;
        for (Vec& axis : atom.semiaxes)
          for (double& component : axis) component /= 4;
      }
    Query query = query_of(draw, Style::grid, scene);
    const Answer answer = oracle::Oracle(scene).first_hit(query);
    Case c = proved(scene, query, Answer::never());
    for (auto& rows : c.proof.rows)
      for (auto steps = draw.below(5); steps > 0; --steps) {
        const auto row = 1 + draw.below(dimension - 1), other = draw.below(dimension);
        if (row == other) continue;
        for (int k = 0; k < dimension; ++k)
          rows.basis[row][k] = Integer(rows.basis[row][k].int64() + rows.basis[other][k].int64());
      }
    if (answer.outcome == Outcome::never) {
      require_accepted(c);
      ++never;
    } else {
      require_refused(c, "the line meets obstacle");
      ++hits;
    }
  }
  CHECK(never > 510);  // 646 seen
  CHECK(hits > 1800);  // 2 354 seen
}

TEST_CASE("never: no atom's rows may be missing, with several atoms and lattices",
          "[oracle][certificate_check]") {
  for (const int dimension : {2, 3}) {
    Scene scene = unit_scene(dimension, 0.125);
    for (const double x : {0.25, 0.5}) scene.lattices[0].atoms.push_back(Atom{{x, 0}, 0.125, {}});
    scene.lattices.push_back(scene.lattices[0]);
    const Query query{{0, 0.5, 0.5}, {1, 0}, {}};
    const Case whole = proved(scene, dimension == 2 ? Query{{0, 0.5}, {1, 0}, {}} : query);
    REQUIRE(whole.answer.outcome == Outcome::never);
    require_accepted(whole);
    REQUIRE(whole.proof.rows.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
      Case c = whole;
      c.proof.rows.erase(c.proof.rows.begin() + static_cast<long>(i));
      const std::string name = "lattice " + std::to_string(i / 3) + ", atom " + std::to_string(i % 3);
      require_refused(c, name + ": no rows");
      // Also if it is this atom that is hit, and with another's rows twice in place of its own.
      c.scene.lattices[i / 3].atoms[i % 3].position[1] = 0.5;
      if (dimension == 3) c.scene.lattices[i / 3].atoms[i % 3].position[2] = 0.5;
      REQUIRE(oracle::Oracle(c.scene).first_hit(c.query).outcome != Outcome::never);
      require_refused(c, name + ": no rows");
      c.proof.rows.push_back(c.proof.rows[0]);
      require_refused(c, "other rows");
    }
  }
}
