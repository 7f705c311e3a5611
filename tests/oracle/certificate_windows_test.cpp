// The windows of a proof that an obstacle is the first: no gap, ends held exactly, a basis of the lattice.
#include "tests/oracle/certificate_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::test::proofs;

TEST_CASE("A missing, shortened or misplaced window is refused", "[oracle][certificate_check]") {
  Draw draw(2106);
  INFO("seed 2106");
  for (int i = 0; i < 300; ++i) {
    const Case drawn_case = drawn_hit(draw);
    const Case whole = proved(drawn_case.scene, drawn_case.query, 4);
    require_accepted(whole);
    const std::size_t first = 4 * draw.below(whole.proof.windows.size() / 4);  // of one atom
    Case c = whole;
    auto& windows = c.proof.windows;
    const auto begin = windows.begin() + static_cast<long>(first);
    switch (draw.below(8)) {
      case 0:
        windows.erase(begin, begin + 4);
        require_refused(c, "no window");
        break;
      case 1:
        windows.erase(begin);
        require_refused(c, "begins too late");
        break;
      case 2:
        windows.erase(begin + 2);
        require_refused(c, "window " + std::to_string(first + 2) + " (lattice ");
        break;
      case 3:
        windows.erase(begin + 3);
        require_refused(c, "end too early");
        break;
      case 4:
        std::swap(windows[first + 1], windows[first + 2]);
        require_refused(c, "a gap");
        break;
      case 5:
        windows[first + 1].to.mantissa = windows[first + 1].to.mantissa.int64() - 1;
        require_refused(c, "window " + std::to_string(first + 2) + " (lattice ");
        break;
      case 6:
        windows[first].from = 0.0;  // perhaps behind its own end
        require_refused(c, "begins");
        break;
      default:
        windows[first + 3].to = *c.answer.time;  // perhaps before its own beginning
        require_refused(c, "end");
    }
  }
}

TEST_CASE("Windows may overlap, lie inside each other, and alternate between atoms",
          "[oracle][certificate_check]") {
  Case c = timed(100);
  const auto basis = c.proof.windows[0].basis;
  c.proof.windows = {
      {0, 0, -1.0, 50.0, basis}, {0, 0, 3.0, 7.5, basis}, {0, 0, Integer(49), Integer(101), basis}};
  require_accepted(c);
  c.proof.windows[1].to = 3.0;  // a point changes nothing
  require_accepted(c);
  c.proof.windows[1].to = std::nextafter(3, 0);
  require_refused(c, "window 1 (lattice 0, atom 0): ends before it begins");
  c.proof.windows.erase(c.proof.windows.begin() + 1);
  c.proof.windows[0].to = std::nextafter(49, 0);
  require_refused(c, "window 1 (lattice 0, atom 0): a gap before it");
}

TEST_CASE("The ends of windows are held against -r/|v| and t + r/|v| exactly",
          "[oracle][certificate_check]") {
  Case c = timed(100);
  Window& window = c.proof.windows[0];
  window.from = -1.0, window.to = 101.0;
  require_accepted(c);
  window.from = std::nextafter(-1, 0);
  require_refused(c, "begins too late");
  window.from = Integer(-1), window.to = std::nextafter(101, 0);
  require_refused(c, "end too early");
  window.to = Integer(1'000'000);
  require_accepted(c);
  // inside: -r/|v| and r/|v|
  c = proved(c.scene, {{0.5, 0, 0}, {0, 2, 0}, {}});
  REQUIRE(c.answer.outcome == Outcome::inside);
  c.proof.windows[0].from = -0.5, c.proof.windows[0].to = 0.5;
  require_accepted(c);
  c.proof.windows[0].to = std::nextafter(0.5, 0);
  require_refused(c, "end too early");
  c.proof.windows[0].from = std::nextafter(-0.5, 0);
  require_refused(c, "begins too late");
  // and where they are not binary64 numbers: sqrt(2) / 2
  c = proved(c.scene, {{0.5, 0, 0}, {1, 1, 0}, {}});
  c.proof.windows[0].from = -0.70710678118654757, c.proof.windows[0].to = 0.70710678118654757;
  require_accepted(c);
  c.proof.windows[0].to = std::nextafter(0.70710678118654757, 0);
  require_refused(c, "end too early");
}

TEST_CASE("An obstacle at the very end of a window is looked at", "[oracle][certificate_check]") {
  const Scene scene = unit_scene(2, 0.25);
  const ObstacleId third{0, 0, {Integer(3), Integer(0)}};
  Case c = proved(scene, {{0.5, 0}, {1, 0}, {}},
                  Answer::hit(third, 2.25));  // there are two before it, at T = 0.5 and 1.5
  const auto basis = c.proof.windows[0].basis;
  for (const double cut : {0.5, std::nextafter(0.5, 0), std::nextafter(0.5, 1), 0.25, 0.75}) {
    c.proof.windows = {{0, 0, -1.0, cut, basis}, {0, 0, cut, 3.0, basis}};
    require_refused(c, "obstacle (lattice 0, atom 0, cell [1, 0]) is entered earlier");
    c.query.from = ObstacleId{0, 0, {Integer(1), Integer(0)}};
    require_refused(c, "obstacle (lattice 0, atom 0, cell [2, 0]) is entered earlier");
    c.query.from.reset();
  }
}

TEST_CASE("An obstacle in the last row that a window can meet is looked at", "[oracle][certificate_check]") {
  // Balls that touch; the start is on one of them, and enters it. In this basis its row is as far out as any.
  Scene scene = unit_scene(3, 1);
  for (int i = 0; i < 3; ++i) scene.lattices[0].vectors[i][i] = 2;
  const Query query{{0, 0, 1}, {2, -2, -1}, {}};
  REQUIRE(oracle::Oracle(scene).first_hit(query).obstacle == ObstacleId{});
  Case c = proved(scene, {query.x, query.v, ObstacleId{}});
  REQUIRE(c.answer.obstacle == ObstacleId{0, 0, {1, -1, 0}});
  c.proof.windows[0].basis = {Cell{2, 0, -1}, {-1, 0, 1}, {2, -1, -1}};
  require_accepted(c);
  c.query.from.reset();
  require_refused(c, "obstacle (lattice 0, atom 0, cell [0, 0, 0]) is entered earlier");
}

TEST_CASE("Vectors that are not a basis are refused", "[oracle][certificate_check]") {
  Draw draw(2107);
  INFO("seed 2107");
  for (int i = 0; i < 300; ++i) {
    Case c = drawn(draw);
    auto& proof = c.proof;
    CertificateBasis& basis = proof.rows.empty() ? proof.windows[draw.below(proof.windows.size())].basis
                                                 : proof.rows[draw.below(proof.rows.size())].basis;
    const auto row = draw.below(c.scene.dimension), other = (row + 1) % c.scene.dimension;
    if (draw.one_in(3))
      basis[row] = basis[other];  // determinant 0
    else if (draw.one_in(2))
      for (Integer& n : basis[row]) n = Integer(2 * n.int64());  // +-2
    else
      basis[row] = Cell{};
    require_refused(c, "the determinant of the basis is not +-1");
  }
}
