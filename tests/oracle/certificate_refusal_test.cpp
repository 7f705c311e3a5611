// Invalid proofs: garbage, scenes with a flaw, more work than a checker should do.
#include "tests/oracle/certificate_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::test::proofs;

TEST_CASE("Garbage is refused with a reason, and in time", "[oracle][certificate_check]") {
  const Case good = timed(100), solid = timed(100, 3);
  const auto tampered = [](Case c, auto change) {
    change(c);
    return c;
  };
  for (const long exponent : {16'385L, -16'385L, std::numeric_limits<long>::min() + 1}) {
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
  for (const auto digits : {3125UL, 100'000UL}) {
    const Integer huge = *Integer::from_decimal("-" + std::string(digits, '9'));
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].from = huge; }), "characters");
    require_refused(tampered(good, [&](Case& c) { c.proof.windows[0].basis[1][0] = huge; }), "characters");
    require_refused(tampered(good, [&](Case& c) { c.answer.obstacle.cell[0] = huge; }), "characters");
    require_refused(tampered(good, [&](Case& c) { c.query.from = ObstacleId{0, 0, {huge}}; }), "characters");
  }
  // As long as a text may be, and longer by one; an end's mantissa has more digits than its hexadecimal text.
  for (const auto& [most, change] : std::vector<std::pair<std::size_t, void (*)(Case&, const Integer&)>>{
           {2500, [](Case&c, const Integer&n) { c.answer.obstacle.cell[0] = n; }},
           {2500, [](Case&c, const Integer&n) { c.proof.windows[0].basis[1][0] = n; }},
           {2500, [](Case&c, const Integer&n) { c.query.from = ObstacleId{0, 0, {n}}; }},
           {3125, [](Case&c, const Integer&n) { c.proof.windows[0].from = n; }}})
    for (const std::string sign : {"", "-"})
      for (const std::size_t length : {most, most + 1}) {
        Case c = good;
        change(c, *Integer::from_decimal(sign + std::string(length - sign.size(), '9')));
        INFO(length << " characters");
        CHECK((refutation(c).find("characters") != std::string::npos) == (length > most));
      }
  require_refused(tampered(good, [](Case& c) { c.proof.windows[0].basis[0][2] = 1; }), "2 coordinates");
  require_refused(tampered(good, [](Case& c) { c.proof.windows[0].basis[2][2] = 1; }), "2 vectors");
  require_refused(tampered(good, [](Case& c) { c.answer.obstacle.cell[2] = 1; }), "2 coordinates");
  require_refused(tampered(good,
                           [](Case& c) {
                             c.query.from = ObstacleId{0, 0, {0, 0, 1}};
                           }),
                  "more coordinates");
  require_refused(tampered(good, [](Case& c) { c.query.x[2] = 1; }), "third must be zero");
  require_refused(tampered(good, [](Case& c) { c.query.v = {0, 0, 1}; }), "third must be zero");
  require_refused(tampered(good, [](Case& c) { c.query.v = {}; }), "query: v is zero");
  require_refused(tampered(good, [&](Case& c) { c.query.x[0] = NAN; }), "query: x is not finite");
  require_refused(tampered(good, [](Case& c) { c.proof.rows.push_back({}); }), "rows prove `never` only");
  for (const Answer& answer : {Answer::later(), Answer::undecided(), Answer::error("none")})
    require_refused(tampered(good, [&](Case& c) { c.answer = answer; }), "only hit, inside and never");
  // N = b_1 x b_2 along v is no worse than another
  require_accepted(tampered(solid, [](Case& c) {
    c.proof.windows[0].basis = {Cell{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  }));
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
  require_refused(c, "window 0 (lattice 0, atom 0): takes more than 1000000 steps");
  window.basis = {Cell{1, 0}, Cell{0, 1}};  // a row along it: as many obstacles
  c.query.from = ObstacleId{};
  require_refused(c, "more than 1000000 steps");
  // 64 windows of 2^9 columns or more, hardly ever met.
  c = proved(c.scene, {{0.5, 0}, {1, 0.6180339887498949}, {}});
  REQUIRE(c.answer.outcome == Outcome::inside);
  c.proof.windows[0].to = 0x1p19;
  c.proof.windows[0].basis = {Cell{0, 1}, Cell{1, 0}};
  c.proof.windows.resize(64, Window(c.proof.windows[0]));
  require_accepted(c);
  CHECK_FALSE(CertificateCheck(c.scene, 66 * 523).refutation(c.query, c.answer, c.proof));
  CHECK_THAT(CertificateCheck(c.scene, 64 * 523).refutation(c.query, c.answer, c.proof).value_or(""),
             Catch::Contains("atom 0): takes more than 33472 steps"));
  for (Window& window : c.proof.windows) window.from = 1.0;  // a window counts as ten, however short
  c.proof.windows[0].from = -1.0, c.proof.windows[0].to = 1.0;
  for (Window& window : c.proof.windows) window.to = 1.0;
  require_accepted(c);
  bool too_long = false;
  CHECK_FALSE(CertificateCheck(c.scene, 64 * 13).refutation(c.query, c.answer, c.proof, &too_long));
  CHECK_FALSE(too_long);
  CHECK(CertificateCheck(c.scene, 64 * 11).refutation(c.query, c.answer, c.proof, &too_long));
  CHECK(too_long);  // there are some rows besides
  c.answer.obstacle.cell[0] = 1;
  CHECK(CertificateCheck(c.scene, 64 * 11).refutation(c.query, c.answer, c.proof, &too_long));
  CHECK_FALSE(too_long);  // false, however long
  c = timed(100, 3);
  c.proof.windows[0].to = 0x1p100;
  c.proof.windows[0].basis = {Cell{1, 1, 0}, {0, 1, 0}, {0, 0, 1}};  // planes along the flight
  require_refused(c, "more than 1000000 steps");
  c.proof.windows[0].basis = {Cell{0, 1, 0}, {1, 0, 1}, {1, 0, 0}};  // and across it
  require_refused(c, "more than 1000000 steps");
  // Three planes of 600 000 rows each
  c.proof.windows[0].from = -1.0, c.proof.windows[0].to = 600'000 * 1024.;
  c.proof.windows[0].basis = {Cell{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (double& u : c.scene.lattices[0].vectors[1]) u *= 0.75 / 1024;
  require_refused(c, "more than 1000000 steps");
  // Rows along v in a basis that shows nothing of how far apart they are
  c = proved(unit_scene(3, 0.25), {{0.5, 0.5, 0.5}, {1, 0, 0}, {}});
  c.proof.rows[0].basis = {Cell{1, 0, 0}, {0, 10'000'000, 1}, {0, 1, 0}};
  c.proof.rows[0].basis[2] = {0, 9'999'999, 1};
  require_refused(c, "more than 1000000 steps");
  // Each of a few thousand rows counts
  c.proof.rows[0].basis = {Cell{1, 0, 0}, {0, 10'000, 1}, {0, 9'999, 1}};
  require_accepted(c);
  CHECK_THAT(CertificateCheck(c.scene, 1000).refutation(c.query, c.answer, c.proof).value_or(""),
             Catch::Contains("atom 0): takes more than 1000 steps"));
}
