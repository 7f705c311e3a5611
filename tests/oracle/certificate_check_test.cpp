// The check of certificates: proofs of drawn answers pass, whatever is tampered with does not.
#include "oracle/certificate/check/certificate_time.hpp"
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
  CHECK(outcomes[Outcome::hit] > 1000);
  CHECK(outcomes[Outcome::inside] > 500);
  CHECK(outcomes[Outcome::never] > 30);
  CHECK(std::min({with_from, ellipsoids, several}) > 300);
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
    // Of a solid basis two vectors may end up at right angles to the flight: then it is refused.
    INFO(text(c));
    const std::string said = refutation(c);
    REQUIRE((said.empty() || said.find("right angles") != std::string::npos));
    accepted += said.empty();
  }
  CHECK(accepted > 500);
}

TEST_CASE("The sign of a + sqrt(c) - sqrt(b), also where it is 0", "[oracle][certificate_check]") {
  int zeros = 0;
  for (int a = -8; a <= 8; ++a)
    for (int b = 0; b <= 40; ++b)
      for (int c = 0; c <= 40; ++c) {
        const long double value =
            a + std::sqrt(static_cast<long double>(c)) - std::sqrt(static_cast<long double>(b));
        const int expected = std::fabs(value) < 1e-12L ? 0 : value < 0 ? -1 : 1;  // none is that small but 0
        INFO(a << " " << b << " " << c);
        REQUIRE(oracle::certificate::sign_of(a, c, b) == expected);
        zeros += expected == 0;
      }
  CHECK(zeros > 50);
}

// ---- What is wrong

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
  CHECK(later > 500);
  CHECK(neighbours > 300);
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
        require_refused(c, "a gap before window " + std::to_string(first + 2));
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
        require_refused(c, "a gap before window " + std::to_string(first + 2));
        break;
      case 6:
        windows[first].from = 0.0;
        require_refused(c, "begins too late");
        break;
      default:
        windows[first + 3].to = *c.answer.time;
        require_refused(c, "end too early");
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
  c.proof.windows[1].to = -7.0;  // an empty one changes nothing
  require_accepted(c);
  c.proof.windows[0].to = std::nextafter(49, 0);
  require_refused(c, "a gap before window 2");
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
  // and where they are no binary64: sqrt(2) / 2
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

TEST_CASE("Vectors that are no basis are refused", "[oracle][certificate_check]") {
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
    require_refused(tampered, "second");
    tampered = c;
    tampered.proof.windows = proof_of(scene, c.query, Answer::hit({}, 1)).windows;
    require_refused(tampered, "windows do not prove");
    tampered = c;
    std::swap(tampered.proof.rows[0].basis[0], tampered.proof.rows[0].basis[1]);
    require_refused(tampered, "not parallel");
    tampered = c;
    tampered.query.v = {1, 0x1p-1000};
    require_refused(tampered, "not parallel");
    tampered = c;
    for (Integer& n : tampered.proof.rows[0].basis[0]) n = Integer(-n.int64());  // either sense will do
    require_accepted(tampered);
    // A hit that claims to be none: the rows are right, and one is met; also if it is only that of `from`.
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
  CHECK(never > 300);
  CHECK(hits > 1000);
}

TEST_CASE("never: of several atoms and lattices nobody's rows may be missing",
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
      require_refused(c, "the atom's second");
    }
  }
}

// ---- inside, from, ties, tangents

TEST_CASE("inside: only the smallest obstacle around x, but `from`", "[oracle][certificate_check]") {
  Scene scene = unit_scene(2, 0.75);
  scene.lattices[0].atoms.push_back(Atom{{0.125, 0}, 0.5, {}});
  const Query query{{0.5, 0.125}, {1, 3}, {}};
  const Case first = proved(scene, query);
  REQUIRE(first.answer.obstacle == ObstacleId{0, 0, {}});
  require_accepted(first);
  const ObstacleId next{0, 0, {Integer(1), Integer(0)}}, other{0, 1, {}};
  require_refused(proved(scene, query, Answer::inside(next)), "contains x, too, and comes first");
  require_refused(proved(scene, query, Answer::inside(other)), "contains x, too, and comes first");
  require_accepted(proved(scene, {query.x, query.v, first.answer.obstacle}, Answer::inside(next)));
  require_refused(proved(scene, {query.x, query.v, next}, Answer::inside(other)), "comes first");
  require_refused(proved(scene, {query.x, query.v, next}, Answer::inside(next)), "is `from`");
  const ObstacleId ahead{0, 0, {Integer(1), Integer(2)}};
  require_refused(proved(scene, query, Answer::inside(ahead)), "does not contain x");
  require_refused(proved(scene, query, Answer::hit(first.answer.obstacle, 0)), "contains x");
  // A hit while x is inside another.
  scene = unit_scene(2, 0.25);
  Case hit = proved(scene, {{0.5, 0}, {1, 0}, {}});
  hit.scene.lattices[0].atoms.push_back(Atom{{0.5, 0.25}, 0.3125, {}});
  hit.proof = proof_of(hit.scene, hit.query, hit.answer);
  require_refused(hit, "obstacle (lattice 0, atom 1, cell [0, 0]) contains x");
  hit.query.from = ObstacleId{0, 1, {}};
  require_accepted(hit);
}

TEST_CASE("inside: tampered answers among many overlapping balls are refused",
          "[oracle][certificate_check]") {
  Draw draw(2111);
  INFO("seed 2111");
  int refused = 0, same_answers = 0;
  for (int i = 0; i < 300; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, draw.between(0.8, 3));
    const Case c = proved(scene, {draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}});
    require_accepted(c);
    Case other = c;
    for (int k = 0; k < dimension; ++k)
      other.answer.obstacle.cell[k] = Integer(static_cast<int>(draw.below(5)) - 2);
    if (other.answer.obstacle == c.answer.obstacle) {
      ++same_answers;
      continue;
    }
    INFO(text(other));
    REQUIRE(refutation(other) != "");
    ++refused;
  }
  CHECK(refused > 200);
}

TEST_CASE("`from` counts once, and only where it is", "[oracle][certificate_check]") {
  const Scene scene = unit_scene(2, 0.25);
  const ObstacleId first{0, 0, {Integer(1), Integer(0)}}, second{0, 0, {Integer(2), Integer(0)}};
  Case c = proved(scene, {{0.5, 0}, {1, 0}, {}});
  REQUIRE(c.answer.obstacle == first);
  c.query.from = first;
  require_refused(c, "is `from`");
  c = proved(scene, c.query);
  REQUIRE(c.answer.obstacle == second);
  require_accepted(c);
  for (const std::optional<ObstacleId>& from :
       {std::optional<ObstacleId>{}, {ObstacleId{0, 0, {Integer(0), Integer(0)}}}}) {
    c.query.from = from;
    require_refused(c, "obstacle (lattice 0, atom 0, cell [1, 0]) is entered earlier");
  }
  c.query.from = ObstacleId{0, 1, first.cell};
  require_refused(c, "query: from names atom 1");
  c.scene.lattices[0].atoms.push_back(Atom{{0.5, 0.5}, 0.25, {}});
  c.proof = proof_of(c.scene, c.query, c.answer);
  require_refused(c, "obstacle (lattice 0, atom 0, cell [1, 0]) is entered earlier");
  c.scene.lattices.push_back(c.scene.lattices[0]);
  c.query.from = ObstacleId{1, 0, first.cell};
  c.proof = proof_of(c.scene, c.query, c.answer);
  require_refused(c, "obstacle (lattice 0, atom 0, cell [1, 0]) is entered earlier");
}

TEST_CASE("A tie claimed for another than the smallest lattice, atom, cell is refused",
          "[oracle][certificate_check]") {
  // Two balls that the flight enters at the same t: above and below the line.
  Scene scene = unit_scene(2, 0.625);
  scene.lattices[0].vectors = {Vec{4, 0}, Vec{0, 1}};
  const Query query{{1, 0.5}, {1, 0}, {}};
  const ObstacleId low{0, 0, {Integer(1), Integer(0)}}, high{0, 0, {Integer(1), Integer(1)}};
  Case c = proved(scene, query);
  REQUIRE(c.answer.obstacle == low);
  require_accepted(c);
  const double time = *c.answer.time;
  require_refused(proved(scene, query, Answer::hit(high, time)),
                  "is entered at the same time and comes first");
  require_accepted(proved(scene, {query.x, query.v, low}, Answer::hit(high, time)));
  scene.lattices[0].atoms.push_back(scene.lattices[0].atoms[0]);
  scene.lattices.push_back(scene.lattices[0]);
  require_accepted(proved(scene, query));
  for (const ObstacleId& other : {ObstacleId{0, 1, low.cell}, {1, 0, low.cell}, {1, 1, high.cell}})
    require_refused(proved(scene, query, Answer::hit(other, time)),
                    "is entered at the same time and comes first");
}

TEST_CASE("Tangents are no hits, nor is what lies behind or is left", "[oracle][certificate_check]") {
  const Scene scene = unit_scene(2, 0.25);
  const ObstacleId ball{0, 0, {Integer(1), Integer(0)}};
  require_refused(proved(scene, {{0.5, 0.25}, {1, 0}, {}}, Answer::hit(ball, 0.5)), "is not met by the line");
  require_refused(proved(scene, {{0.5, 0.3}, {1, 0}, {}}, Answer::hit(ball, 0.5)), "is not met by the line");
  require_refused(proved(scene, {{1.5, 0}, {1, 0}, {}}, Answer::hit(ball, 0.25)), "lies behind");
  require_refused(proved(scene, {{1.25, 0}, {1, 0}, {}}, Answer::hit(ball, 0)), "lies behind");  // leaving
  require_refused(proved(scene, {{1, 0.25}, {1, 0}, {}}, Answer::hit(ball, 0)), "is not met by the line");
  require_accepted(proved(scene, {{0.75, 0}, {1, 0}, {}}, Answer::hit(ball, 0)));  // entering
  // One that is only touched on the way does not matter.
  Scene two = scene;
  two.lattices[0].atoms.push_back(Atom{{0.5, 0.25}, 0.25, {}});
  require_accepted(proved(two, {{0.25, 0}, {1, 0}, {}}, Answer::hit(ball, 0.5)));
}

// ---- Garbage

TEST_CASE("Garbage is refused with a reason, and in time", "[oracle][certificate_check]") {
  const Case good = timed(100), solid = timed(100, 3);
  const auto tampered = [](Case c, auto change) {
    change(c);
    return c;
  };
  for (const long exponent : {65'537L, -65'537L, std::numeric_limits<long>::min() + 1}) {
    const oracle::WindowEnd end(1, exponent);
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].from = end; }),
                    "window 0 (lattice 0, atom 0): an end");
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].to = end; }), "an end has an exponent");
  }
  for (const int index : {-1, 1, 1 << 30}) {
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].lattice = index; }), "no such atom");
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].atom = index; }), "no such atom");
    require_refused(tampered(good, [&](Case& c) { c.answer.obstacle.lattice = index; }), "does not exist");
    require_refused(tampered(good, [&](Case& c) { c.answer.obstacle.atom = index; }), "does not exist");
  }
  for (const auto digits : {1234UL, 100'000UL}) {
    const Integer huge = *Integer::from_decimal("-" + std::string(digits, '9'));
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].from = huge; }), "4096 bits");
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].basis[1][0] = huge; }), "4096 bits");
    require_refused(tampered(good, [&](Case& c) { c.answer.obstacle.cell[0] = huge; }), "4096 bits");
    require_refused(tampered(good, [&](Case& c) { c.query.from = ObstacleId{0, 0, {huge}}; }), "4096 bits");
  }
  require_refused(tampered(good, [](Case& c) { c.proof.windows[0].basis[0][2] = 1; }), "third coordinate");
  require_refused(tampered(good, [](Case& c) { c.proof.windows[0].basis[2][2] = 1; }), "third vector");
  require_refused(tampered(good, [](Case& c) { c.answer.obstacle.cell[2] = 1; }), "third coordinate");
  require_refused(tampered(good,
                           [](Case& c) {
                             c.query.from = ObstacleId{0, 0, {0, 0, 1}};
                           }),
                  "third coordinate");
  require_refused(tampered(good, [](Case& c) { c.query.x[2] = 1; }), "third coordinate");
  require_refused(tampered(good, [](Case& c) { c.query.v = {0, 0, 1}; }), "third coordinate");
  require_refused(tampered(good, [](Case& c) { c.query.v = {}; }), "query: v is zero");
  require_refused(tampered(good, [&](Case& c) { c.query.x[0] = NAN; }), "query: x is not finite");
  require_refused(tampered(good, [](Case& c) { c.proof.rows.push_back({}); }), "rows prove `never` only");
  for (const Answer& answer : {Answer::later(), Answer::undecided(), Answer::error("none")})
    require_refused(tampered(good, [&](Case& c) { c.answer = answer; }), "only hit, inside and never");
  // N = b_1 x b_2 along v
  require_refused(tampered(solid,
                           [](Case& c) {
                             c.proof.windows[0].basis = {Cell{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
                           }),
                  "right angles");
  Case rows = proved(unit_scene(2, 0.25), {{0.5, 0.5}, {1, 0}, {}});
  for (const int index : {-1, 1}) {
    require_refused(tampered(rows, [&](Case& c) { c.proof.rows[0].lattice = index; }), "no such atom");
    require_refused(tampered(rows, [&](Case& c) { c.proof.rows[0].atom = index; }), "no such atom");
  }
}

TEST_CASE("A scene with a flaw proves nothing", "[oracle][certificate_check]") {
  const auto hold = [](auto change, const std::string& reason) {
    Case c = timed(100);
    change(c.scene);
    CHECK_THAT(refutation(c), Catch::StartsWith("scene: " + reason));
  };
  hold([](Scene& scene) { scene.dimension = 4; }, "dimension");
  hold([](Scene& scene) { scene.lattices[0].vectors[1] = scene.lattices[0].vectors[0]; },
       "the primitive vectors are dep");
  hold(
      [](Scene& scene) {
        scene.lattices[0].atoms[0] = {{}, 0, {Vec{1, 2}, Vec{2, 4}}};
      },
      "the semiaxes are dependent");
  hold([](Scene& scene) { scene.lattices[0].atoms[0].radius = -1; }, "lattice 0, atom 0: radius");
}

TEST_CASE("Proofs that are too much work are refused", "[oracle][certificate_check]") {
  Case c = timed(100);
  Window& window = c.proof.windows[0];
  window.from = -0x1p100, window.to = 0x1p100;
  window.basis = {Cell{0, 1}, Cell{1, 0}};  // columns across the flight
  require_refused(c, "window 0 (lattice 0, atom 0): more than 1000000 rows");
  window.basis = {Cell{1, 0}, Cell{0, 1}};  // a row along it: as many obstacles
  c.query.from = ObstacleId{};
  require_refused(c, "rows and obstacles to look at");
  // 64 windows of 2^9 columns or more, hardly ever met.
  c = proved(c.scene, {{0.5, 0}, {1, 0.6180339887498949}, {}});
  REQUIRE(c.answer.outcome == Outcome::inside);
  c.proof.windows[0].to = 0x1p19;
  c.proof.windows[0].basis = {Cell{0, 1}, Cell{1, 0}};
  c.proof.windows.resize(64, Window(c.proof.windows[0]));
  require_accepted(c);
  CHECK_FALSE(CertificateCheck(c.scene, 66 * 512).refutation(c.query, c.answer, c.proof));
  CHECK_THAT(CertificateCheck(c.scene, 64 * 512).refutation(c.query, c.answer, c.proof).value_or(""),
             Catch::Contains("atom 0): more than 32768 rows and obstacles to look at"));
  for (Window& window : c.proof.windows)
    window.from = 1.0, window.to = -1.0;  // windows count, also empty ones
  c.proof.windows[0].from = -1.0, c.proof.windows[0].to = 1.0;
  require_accepted(c);
  CHECK_FALSE(CertificateCheck(c.scene, 66).refutation(c.query, c.answer, c.proof));
  CHECK(CertificateCheck(c.scene, 63).refutation(c.query, c.answer, c.proof));
  c = timed(100, 3);
  c.proof.windows[0].to = 0x1p100;
  c.proof.windows[0].basis = {Cell{1, 1, 0}, {0, 1, 0}, {0, 0, 1}};  // planes along the flight
  require_refused(c, "more than 1000000 rows");
  c.proof.windows[0].basis = {Cell{0, 1, 0}, {1, 0, 1}, {1, 0, 0}};  // and across it
  require_refused(c, "more than 1000000 rows");
  // Three planes of 600 000 rows each
  c.proof.windows[0].from = -1.0, c.proof.windows[0].to = 600'000 * 1024.;
  c.proof.windows[0].basis = {Cell{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (double& u : c.scene.lattices[0].vectors[1]) u *= 0.75 / 1024;
  require_refused(c, "more than 1000000 rows");
  // Rows along v in a basis that shows nothing of how far apart they are
  c = proved(unit_scene(3, 0.25), {{0.5, 0.5, 0.5}, {1, 0, 0}, {}});
  c.proof.rows[0].basis = {Cell{1, 0, 0}, {0, 10'000'000, 1}, {0, 1, 0}};
  c.proof.rows[0].basis[2] = {0, 9'999'999, 1};
  require_refused(c, "more than 1000000 rows");
  // Of a few thousand each counts
  c.proof.rows[0].basis = {Cell{1, 0, 0}, {0, 10'000, 1}, {0, 9'999, 1}};
  require_accepted(c);
  CHECK_THAT(CertificateCheck(c.scene, 1000).refutation(c.query, c.answer, c.proof).value_or(""),
             Catch::Contains("atom 0): more than 1000 rows and obstacles to look at"));
}
