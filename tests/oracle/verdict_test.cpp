#include <lorentz/margin.hpp>
#include <lorentz/verdict.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Verdict;

namespace {

ObstacleId at(int i, int j) {
  return {0, 0, {i, j, 0}};
}

oracle::Judgement judged(const Scene& scene, const Query& query, const Answer& given, double ulps = 4) {
  return oracle::Judge(scene).judge(query, oracle::Oracle(scene).first_hit(query), given, ulps);
}

// One disc of radius 1/4 a unit cell. The flight along y = b passes or hits those in row 0 at b = 1/4.
const Scene kScene = unit_scene(2, 0.25);
Query level(double b) {
  return {{0.5, b}, {1, 0}, {}};
}

// The same question in other units and with its axes in another order, some of them turned round: all inputs
// and ulps go along, exactly.
struct OtherWords {
  int shift, exponent, slower;
  double sign;

  Vec operator()(const Vec& a, int dimension, int power) const {
    Vec b{};
    for (int i = 0; i < dimension; ++i)
      b[(i + shift) % dimension] = std::ldexp(i == 0 ? sign * a[i] : a[i], power);
    return b;
  }
  Scene operator()(Scene scene) const {
    for (Lattice& lattice : scene.lattices) {
      for (Vec& u : lattice.vectors) u = (*this)(u, scene.dimension, exponent);
      for (Atom& atom : lattice.atoms) {
        atom.position = (*this)(atom.position, scene.dimension, exponent);
        atom.radius = std::ldexp(atom.radius, exponent);
        for (Vec& a : atom.semiaxes) a = (*this)(a, scene.dimension, exponent);
      }
    }
    return scene;
  }
  Query operator()(const Query& query, int dimension) const {
    return {(*this)(query.x, dimension, exponent), (*this)(query.v, dimension, exponent - slower),
            query.from};
  }
  Answer operator()(Answer answer) const {
    if (answer.time) *answer.time = std::ldexp(*answer.time, slower);
    return answer;
  }
};

// In units and axes that are far from those of a test.
std::vector<OtherWords> other_words(int dimension) {
  std::vector<OtherWords> all{{0, 0, 0, 1}};
  for (int shift = 0; shift < dimension; ++shift)
    for (const double sign : {1.0, -1.0}) all.push_back({shift, 100 - 70 * shift, 30 * shift - 50, sign});
  return all;
}

}  // namespace

TEST_CASE("Each answer gets its verdict", "[oracle][verdict]") {
  const Query query = level(0.125);  // hits (1, 0)
  const auto verdict = [&](const Answer& given) { return judged(kScene, query, given).verdict; };
  const double time = *oracle::Oracle(kScene).first_hit(query).time;
  CHECK(verdict(Answer::hit(at(1, 0), time)) == Verdict::agree);
  CHECK(verdict(Answer::hit(at(2, 0), 1 + time)) == Verdict::wrong);
  CHECK(verdict(Answer::hit(at(1, 1), time)) == Verdict::wrong);
  CHECK(verdict(Answer::hit({1, 0, {}}, time)) == Verdict::wrong);
  CHECK(verdict(Answer::never()) == Verdict::wrong);
  CHECK(verdict(Answer::inside(at(1, 0))) == Verdict::wrong);
  CHECK(verdict(Answer::undecided()) == Verdict::undecided);
  CHECK(verdict(Answer::later()) == Verdict::undecided);
  CHECK(verdict(Answer::error("no")) == Verdict::error);
  CHECK(verdict(Answer::unsupported_because("no")) == Verdict::unsupported);
  CHECK(judged(kScene, level(0.5), Answer::never()).verdict == Verdict::agree);
  CHECK(judged(kScene, level(0.5), Answer::hit(at(1, 0), time)).verdict == Verdict::wrong);
  CHECK(judged(kScene, {{0.125, 0}, {1, 0}, {}}, Answer::inside(at(0, 0))).verdict == Verdict::agree);
  CHECK(judged(kScene, {{0.125, 0}, {1, 0}, {}}, Answer::inside(at(1, 0))).verdict == Verdict::wrong);
}

TEST_CASE("What an ill-posed answer departs by is the tolerance from which on it is one, and an obstacle's",
          "[oracle][verdict]") {
  // Rising lines that enter the disc (1, 0) by some roundings, and (2, 0) by more than any.
  std::size_t forgiven = 0;
  for (int roundings = 1; roundings <= 40; ++roundings) {
    const Query query{{0.5, -0.25 - 0x1p-31 + roundings * 0x1p-54}, {1, 0x1p-30}, {}};
    for (const Answer& given : {Answer::hit(at(2, 0), 1.5), Answer::never()}) {
      const oracle::Judgement judgement = judged(kScene, query, given);
      INFO(roundings << " " << static_cast<int>(given.outcome) << " " << judgement.departs);
      REQUIRE(judgement.obstacle);
      if (judgement.verdict != Verdict::ill_posed) continue;
      ++forgiven;
      CHECK(judgement.obstacle == at(1, 0));
      CHECK(judgement.departs > 0);
      CHECK(judged(kScene, query, given, 0.99 * judgement.departs).verdict == Verdict::wrong);
      CHECK(judged(kScene, query, given, 1.01 * judgement.departs).verdict == Verdict::ill_posed);
    }
  }
  CHECK(forgiven > 10);
  // And `never`, along the edge of a corridor.
  const oracle::Judgement never = judged(kScene, level(0.25 - 0x1p-52), Answer::never());
  CHECK(never.verdict == Verdict::ill_posed);
  CHECK(never.obstacle == at(1, 0));
  CHECK(never.departs > 0);
  CHECK(judged(kScene, level(0.25 - 0x1p-52), Answer::never(), 0.99 * never.departs).verdict ==
        Verdict::wrong);
  CHECK_FALSE(judged(kScene, level(0), Answer::hit({1, 0, {}}, 1)).obstacle);  // there is none
}

TEST_CASE("An answer to an invalid query is judged an error, not wrong", "[oracle][verdict]") {
  CHECK(oracle::Judge(kScene).judge(level(0), Answer::error("v is zero"), Answer::hit(at(0, 0), 1)).verdict ==
        Verdict::error);
}

TEST_CASE("The obstacle that is left is never the answer, however few ulps speak against it",
          "[oracle][verdict]") {
  const Query off{{0.5, 0.125}, {1, 0}, at(1, 0)}, out{{0.125, 0}, {1, 0}, at(0, 0)};
  CHECK(judged(kScene, off, Answer::hit(at(1, 0), 0.28)).verdict == Verdict::wrong);
  CHECK(judged(kScene, out, Answer::inside(at(0, 0))).verdict == Verdict::wrong);
}

TEST_CASE("inside: only what comes before the obstacle named speaks against it", "[oracle][verdict]") {
  const Scene overlapping = unit_scene(2, 0.75);
  // In the first disc by an ulp, in the second by a lot.
  const Query query{{std::nextafter(0.75, 0), 0}, {1, 0.5}, {}};
  REQUIRE(oracle::Oracle(overlapping).first_hit(query).obstacle == at(0, 0));
  CHECK(judged(overlapping, query, Answer::inside(at(1, 0))).verdict == Verdict::ill_posed);
  CHECK(judged(overlapping, {{0.5, 0}, {1, 0.5}, {}}, Answer::inside(at(1, 0))).verdict == Verdict::wrong);
}

TEST_CASE("never: a component of v that is zero is exact", "[oracle][verdict]") {
  // Along (+-1, 0, 1) the flight would be free.
  for (const double side : {1, -1}) {
    const Query query{{side * 0.05, 0, 0.5}, {0, 0, 1}, {}};
    CHECK(judged(unit_scene(3, 0.1), query, Answer::never()).verdict == Verdict::wrong);
  }
}

TEST_CASE("never: among tiny discs nearly every direction is within ulps of a free one",
          "[oracle][verdict]") {
  Draw draw(41);
  INFO("seed 41");
  int ill_posed = 0;
  for (int i = 0; i < 200; ++i) {
    const Query query{draw.vec(2, 0, 1), draw.vec(2, 0.1, 1), {}};
    ill_posed += judged(unit_scene(2, 1e-9), query, Answer::never()).verdict == Verdict::ill_posed;
  }
  CHECK(ill_posed > 190);  // 198 seen; with coefficients of lattice lines up to 1 only, 164
}

TEST_CASE("A wrong time departs by no more than its own ulps", "[oracle][verdict]") {
  // Here an ulp in each input moves the time by less than an ulp of its own.
  const Scene scene = unit_scene(3, 0.4);
  const Query query{{0.5, 0.5, 0}, {-0.06926965601134438, -0.004098486767561527, 0.9153936903353617}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  const auto judgement = judged(scene, query, Answer::hit(exact.obstacle, *exact.time * (1 + 0x1p-40)));
  CHECK(judgement.wrong_time);
  CHECK(judgement.departs == Approx(*judgement.ulps));
}

TEST_CASE("An answer that a few ulps would make right is ill-posed, with the tolerance that it needs",
          "[oracle][verdict]") {
  // At b = 1/4 - m ulps of the cell the disc is hit; x and r move: m - 1 + 1/4 ulps are left between.
  // The change of the distance is ulp(cell) + ulp(1/4) = 1.25 2^-52; T ulp(v_2) is nothing, v_2 = 0 being
  // exact.
  for (const int m : {1, 2, 4, 5, 6, 10}) {
    const double b = 0.25 - m * 0x1p-52;
    const auto judgement = judged(kScene, level(b), Answer::never());
    INFO(m);
    // The exact answer is a hit, and moving by m / 1.25 ulps opens the corridor.
    CHECK(judgement.verdict == (m <= 5 ? Verdict::ill_posed : Verdict::wrong));
    const auto missed = judged(kScene, level(0.25 + m * 0x1p-52), Answer::hit(at(1, 0), 0.5));
    CHECK(missed.verdict == (m <= 5 ? Verdict::ill_posed : Verdict::wrong));
    CHECK(missed.departs == Approx(m / 1.25));
  }
  CHECK(judged(kScene, level(0.25 + 0x1p-50), Answer::hit(at(1, 0), 0.5), 3).verdict == Verdict::wrong);
  CHECK(judged(kScene, level(0.25 + 0x1p-50), Answer::hit(at(1, 0), 0.5), 3.3).verdict == Verdict::ill_posed);
}

TEST_CASE("A disc passed over with room to spare condemns, one that is grazed does not",
          "[oracle][verdict]") {
  // (1, 0) is grazed, (2, 0) too: every answer along the row is ill-posed; not one behind, nor in another
  // row.
  const Query query = level(0.25 - 0x1p-52);
  REQUIRE(oracle::Oracle(kScene).first_hit(query).obstacle == at(1, 0));
  CHECK(judged(kScene, query, Answer::hit(at(2, 0), 1.5)).verdict == Verdict::ill_posed);
  CHECK(judged(kScene, query, Answer::hit(at(1000, 0), 999.5)).verdict == Verdict::ill_posed);
  CHECK(judged(kScene, query, Answer::hit(at(0, 0), 0)).verdict == Verdict::wrong);
  CHECK(judged(kScene, query, Answer::hit(at(1, 1), 0.5)).verdict == Verdict::wrong);
  // Falling by 2^-10 a cell it soon has room to spare.
  const Query falling{{0.5, 0.25}, {1, -0x1p-10}, {}};
  CHECK(judged(kScene, falling, Answer::hit(at(2, 0), 1.4)).verdict == Verdict::wrong);
}

TEST_CASE("never: an open corridor within a few ulps of v is ill-posed, one beside it is wrong",
          "[oracle][verdict]") {
  const auto verdict = [](double slope, double b) {
    return judged(kScene, {{0.5, b}, {1, slope}, {}}, Answer::never()).verdict;
  };
  // Along (1, 1) the corridors are 1/sqrt(2) - 1/2 = 0.207 wide, around y - x = 1/2: x = (1/2, 1).
  CHECK(verdict(1, 1) == Verdict::agree);
  for (const double sign : {1.0, -1.0}) {
    CHECK(verdict(1 + sign * 4 * 0x1p-52, 1) == Verdict::ill_posed);
    CHECK(verdict(1 + sign * 20 * 0x1p-52, 1) == Verdict::wrong);
    CHECK(verdict(1 + sign * 4 * 0x1p-52, 1.2) == Verdict::wrong);  // not in the corridor
  }
  // A zero is exact, a component beside it is not: no corridor along the axis.
  CHECK(verdict(0x1p-60, 0.5) == Verdict::wrong);
  CHECK(judged(kScene, {{0.5, 0.5}, {1, 5e-324}, {}}, Answer::never()).verdict == Verdict::ill_posed);
  // 3D: in a plane channel y = 1/2, and along (1, 0, 0) with both others drifting.
  const Scene cubic = unit_scene(3, 0.25);
  const auto solid = [&](const Vec& v, const Vec& x = {0.5, 0.5, 0.25}) {
    return judged(cubic, {x, v, {}}, Answer::never()).verdict;
  };
  CHECK(solid({1, 0, 0.6180339887498949}) == Verdict::agree);
  CHECK(solid({1, 1 + 0x1p-51, 0.3}, {0.5, 1, 0.25}) ==
        Verdict::ill_posed);  // in the plane of (1, 1, 0) and (0, 0, 1)
  CHECK(solid({1, 1 + 0x1p-46, 0.3}, {0.5, 1, 0.25}) == Verdict::wrong);
  CHECK(solid({1, 1 + 0x1p-51, 0.3}, {0.5, 1.25, 0.25}) == Verdict::wrong);  // beside that channel
  // r = 0.55: along (0, 0, 1) there is a cylindrical channel, and no plane channel.
  const Scene tight = unit_scene(3, 0.55);
  const auto drift = [&](double a, double b) {
    return judged(tight, {{0.5, 0.5, 0.25}, {a, b, 1}, {}}, Answer::never()).verdict;
  };
  CHECK(drift(0, 0) == Verdict::agree);
  CHECK(drift(0, 5e-324) == Verdict::ill_posed);
  CHECK(drift(5e-324, 1e-322) == Verdict::wrong);  // 20 of its ulps
}

TEST_CASE("never: far from the origin, where ulps of x are large, no corridor opens that is nowhere",
          "[oracle][verdict]") {
  // Along (1, 1) there is none for r > 1 / sqrt(8) = 0.3536, wherever x is; below, x lies in one or within
  // ulps of it, or does not.
  const auto verdict = [](double r, double x) {
    return judged(unit_scene(2, r), {{x + 0.5, 0}, {1, 1}, {}}, Answer::never()).verdict;
  };
  for (const int far : {4, 40, 47, 48, 49})
    for (const double r : {0.354, 0.375, 0.4375}) CHECK(verdict(r, std::ldexp(1, far)) == Verdict::wrong);
  CHECK(judged(unit_scene(2, 0.5), {{0x1p49 + 0.25, 0}, {1, 1}, {}}, Answer::never()).verdict ==
        Verdict::wrong);
  CHECK(judged(unit_scene(2, 0.35), {{0x1p49 + 0.25, 0}, {1, 1}, {}}, Answer::never()).verdict ==
        Verdict::ill_posed);
  // In space, within the planes x + y = integer, which are 0.7071 apart.
  const auto in_space = [](double r) {
    return judged(unit_scene(3, r), {{0x1p49 + 0.25, 0, 0.5}, {1, -1, 0.34375}, {}}, Answer::never()).verdict;
  };
  CHECK(in_space(0.4375) == Verdict::wrong);
  CHECK(in_space(0.3125) == Verdict::ill_posed);
}

TEST_CASE("never: whatever lattice line or plane v was rounded from, its corridor is found",
          "[oracle][verdict]") {
  Draw draw(5101);
  INFO("seed 5101");
  int ill_posed = 0;
  for (int i = 0; i < 400; ++i) {
    // Along (p, q), in the middle of the corridor, for p t - q s = 1.
    const auto p = 1 + static_cast<long>(draw.below(5000)), q = 1 + static_cast<long>(draw.below(5000));
    if (std::gcd(p, q) != 1) continue;
    long t = 0;
    while ((q * t + 1) % p != 0) ++t;  // s of  p t' - q s = 1,  t' = (q s + 1) / p
    const double s = static_cast<double>(t), t2 = static_cast<double>((q * t + 1) / p);
    const double speed = std::exp2(draw.between(-3, 3)) * draw.sign();
    const Query query{{s / 2, t2 / 2}, {speed * static_cast<double>(p), speed * static_cast<double>(q)}, {}};
    const Scene scene = unit_scene(2, draw.between(0.1, 0.45) / std::hypot(p, q));
    INFO(stream(scene, query));
    const Verdict verdict = judged(scene, query, Answer::never(), 1).verdict;
    REQUIRE((verdict == Verdict::ill_posed || verdict == Verdict::agree));
    ill_posed += verdict == Verdict::ill_posed;
    REQUIRE(judged(scene, query, Answer::never(), 100).verdict == verdict);
  }
  CHECK(ill_posed > 200);  // 252 seen
  ill_posed = 0;
  for (int i = 0; i < 200; ++i) {
    // In the plane normal to (a, b, 1), which (1, 0, -a) and (0, 1, -b) span; its channel around 1/2.
    const auto a = static_cast<double>(draw.below(20)), b = 1 + static_cast<double>(draw.below(20));
    const double f = draw.between(-1, 1), g = draw.between(-1, 1);
    const Query query{{0, 0, 0.5}, {f, g, -a * f - b * g}, {}};
    const Scene scene = unit_scene(3, draw.between(0.1, 0.45) / std::hypot(a, b, 1));
    INFO(stream(scene, query));
    // The last component was rounded from two that may be larger.
    const double lost = (a * std::fabs(f) + b * std::fabs(g)) / std::fabs(query.v[2]);
    if (lost > 4) continue;
    const Verdict verdict = judged(scene, query, Answer::never(), 8).verdict;
    REQUIRE((verdict == Verdict::ill_posed || verdict == Verdict::agree));
    ill_posed += verdict == Verdict::ill_posed;
  }
  CHECK(ill_posed > 95);  // 122 seen
}

TEST_CASE("never: a lattice line that lies in no open plane opens a cylinder, however the lattice is turned",
          "[oracle][verdict]") {
  // Simple cubic, r = 0.6: every plane channel is closed, and along an axis a cylinder of 0.107 is open.
  Draw draw(5102);
  INFO("seed 5102");
  const double a = draw.between(0, 2 * M_PI), b = draw.between(0, 2 * M_PI), c = std::cos(a), s = std::sin(a);
  Scene scene = unit_scene(3, 0.6);
  auto& u = scene.lattices[0].vectors;
  u = {Vec{c, s, 0}, Vec{-s * std::cos(b), c * std::cos(b), std::sin(b)},
       Vec{s * std::sin(b), -c * std::sin(b), std::cos(b)}};
  for (std::size_t k = 0; k < 3; ++k) {
    Query query{{}, u[k], {}};
    for (std::size_t i = 0; i < 3; ++i) query.x[i] = (u[(k + 1) % 3][i] + u[(k + 2) % 3][i]) / 2;
    query.v[1] = std::nextafter(query.v[1], 2);
    INFO(stream(scene, query));
    const oracle::Judgement judgement = judged(scene, query, Answer::never());
    CHECK(judgement.departs > 0.4);
    CHECK(judged(scene, query, Answer::never(), 0.25).verdict == Verdict::wrong);
    for (const OtherWords& words : other_words(3))
      CHECK(judged(words(scene), words(query, 3), Answer::never()).verdict == Verdict::ill_posed);
  }
}

TEST_CASE(
    "An obstacle that is entered earlier condemns, though its centre lies beyond the entry of the one named",
    "[oracle][verdict]") {
  // E is entered by 2e-17, which is a matter of ulps; then Z, at 1/2, and X, at 0.9, before the centre of Z.
  const auto scene_of = [](int dimension, double wide) {
    Scene scene = unit_scene(dimension, 0.25);
    for (int i = 0; i < dimension; ++i) scene.lattices[0].vectors[i][i] = 10;
    Atom z{{1.5, 0}, 1, {}};
    if (wide != 1) {
      z = {{1.5, 0}, 0, {{1, 0, 0}, {0, wide, 0}}};
      if (dimension == 3) z.semiaxes.push_back({0, 0, wide});
    }
    scene.lattices[0].atoms = {{{-1, 0.25}, 0.25, {}}, z, {{1.2, 0}, 0.3, {}}};
    return scene;
  };
  const Query query{{-3, 2e-17}, {1, 0}, {}};
  for (const int dimension : {2, 3})
    for (const double wide : {1.0, 0.75}) {
      const Scene scene = scene_of(dimension, wide);
      INFO(stream(scene, query));
      REQUIRE(oracle::Oracle(scene).first_hit(query).obstacle == ObstacleId{0, 0, {}});
      for (const OtherWords& words : other_words(dimension)) {
        const auto of = [&](int atom, double time) {
          return judged(words(scene), words(query, dimension), words(Answer::hit({0, atom, {}}, time)));
        };
        CHECK(of(1, 3.5).verdict == Verdict::ill_posed);
        CHECK(of(2, 3.9).verdict == Verdict::wrong);
        CHECK(of(2, 3.9).obstacle == ObstacleId{0, 1, {}});
      }
      // A lattice of its own for each.
      Scene apart = scene;
      apart.lattices.assign(3, scene.lattices[0]);
      for (std::size_t l = 0; l < 3; ++l) apart.lattices[l].atoms = {scene.lattices[0].atoms[l]};
      CHECK(judged(apart, query, Answer::hit({1, 0, {}}, 3.5)).verdict == Verdict::ill_posed);
      CHECK(judged(apart, query, Answer::hit({2, 0, {}}, 3.9)).obstacle == ObstacleId{1, 0, {}});
    }
}

TEST_CASE("never: small obstacles and a slope near a lattice vector", "[oracle][verdict]") {
  CHECK(judged(unit_scene(2, 3e-4), {{0.5, 0}, {1, 1e-4}, {}}, Answer::never()).verdict == Verdict::wrong);
  CHECK(judged(unit_scene(2, 3.423250686789962e-05),
               {{-0.5, 0}, {-1.8449123588949907, 0.00025262390235451093}, {}}, Answer::never())
            .verdict == Verdict::wrong);
}

TEST_CASE("Containing is judged by its margin, too", "[oracle][verdict]") {
  // On the surface of (0, 0), outwards: the exact answer flies on; inside is a matter of ulps.
  const double edge = 0.25;
  for (const int m : {0, 1, 5, 6, 20}) {
    INFO(m);
    const Query outside{{edge + m * 0x1p-52, 0}, {1, 0}, {}},
        within{{edge - (m + 1) * 0x1p-52, 0}, {1, 0}, {}};
    CHECK(judged(kScene, outside, Answer::inside(at(0, 0))).verdict ==
          (m <= 5 ? Verdict::ill_posed : Verdict::wrong));
    const double time = *oracle::Oracle(kScene).first_hit(outside).time;
    CHECK(judged(kScene, within, Answer::hit(at(1, 0), time)).verdict ==
          (m + 1 <= 5 ? Verdict::ill_posed : Verdict::wrong));
  }
}

TEST_CASE("An obstacle left behind is acceptable only within the ulps that would put it ahead",
          "[oracle][verdict]") {
  // On the surface, along the tangent, past the point nearest to the centre by e: s = -2 e, which x and v
  // change by 2 ulps and 2 a ulps. The distance of the line is the radius, rounded.
  const double a = 0.1875;
  const Scene scene = unit_scene(2, a * std::sqrt(2.0));
  for (const int steps : {2, 64}) {
    const double e = steps * 0x1p-52;
    const auto judgement = judged(scene, {{-a + e, a + e}, {1, 1}, {}}, Answer::hit(at(0, 0), 0));
    CHECK(judgement.departs == Approx(steps / (1 + a)).epsilon(1e-6));
    CHECK(judgement.verdict == (steps == 2 ? Verdict::ill_posed : Verdict::wrong));
  }
}

TEST_CASE("A start hardly inside an obstacle is outside within ulps, and enters it at once",
          "[oracle][verdict]") {
  Scene alone = unit_scene(2, 1);
  alone.lattices[0].vectors = {}, alone.lattices[0].rank = 0;
  const double inside = -1 + 0x1p-53;
  const auto along = [&](const Vec& v) { return Query{{inside, 0}, v, {}}; };
  for (const Scene& scene : {alone, unit_scene(2, 0.25)}) {
    const Query inwards{{scene.lattices[0].rank == 0 ? inside : -0.25 + 0x1p-54, 0}, {1, 0}, {}};
    REQUIRE(oracle::Oracle(scene).first_hit(inwards).outcome == Outcome::inside);
    CHECK(judged(scene, inwards, Answer::never()).verdict == Verdict::wrong);
  }
  const Scene square = unit_scene(2, 0.25);
  const Query inwards{{-0.25 + 0x1p-54, 0}, {1, 0}, {}};
  CHECK(judged(square, inwards, Answer::hit(at(1, 0), 1)).verdict == Verdict::wrong);
  CHECK(judged(square, inwards, Answer::hit(at(0, 0), 0)).verdict == Verdict::ill_posed);
  // Outwards nothing is entered; along the surface next to nothing.
  CHECK(judged(alone, along({-1, 0}), Answer::never()).verdict == Verdict::ill_posed);
  CHECK(judged(alone, along({0x1p-60, 1}), Answer::never()).verdict == Verdict::ill_posed);
  const Query outwards{{0.25 - 0x1p-55, 0}, {1, 0}, {}};
  REQUIRE(oracle::Oracle(square).first_hit(outwards).outcome == Outcome::inside);
  CHECK(judged(square, outwards, Answer::hit(at(1, 0), 0.5)).verdict == Verdict::ill_posed);
  CHECK(judged(square, outwards, Answer::hit(at(2, 0), 1.5)).verdict == Verdict::wrong);
}

TEST_CASE("Either of two obstacles entered together within ulps is acceptable", "[oracle][verdict]") {
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{0, 0.125}, 0.25, {}});
  const Query middle{{0.5, 0.0625}, {1, 0}, {}};  // an exact tie
  const Answer exact = oracle::Oracle(scene).first_hit(middle);
  REQUIRE(exact.obstacle.atom == 0);
  CHECK(judged(scene, middle, Answer::hit({0, 1, {1, 0, 0}}, *exact.time)).verdict == Verdict::ill_posed);
  const Query off{{0.5, 0.0625 + 0x1p-30}, {1, 0}, {}};
  CHECK(oracle::Oracle(scene).first_hit(off).obstacle.atom == 1);
  CHECK(judged(scene, off, Answer::hit({0, 0, {1, 0, 0}}, *exact.time)).verdict == Verdict::wrong);
}

TEST_CASE("Errors of the time are counted in ulps, and judged by the condition", "[oracle][verdict]") {
  const Answer hit = oracle::Oracle(kScene).first_hit(level(0.125));
  const auto with_time = [&](double time) { return Answer::hit(at(1, 0), time); };
  const auto judgement = [&](double time) { return judged(kScene, level(0.125), with_time(time)); };
  const double unit = 0x1p-54;  // ulp of 0.283..
  CHECK(judgement(*hit.time).ulps == 0.0);
  CHECK(judgement(*hit.time + unit).ulps == 1.0);
  CHECK(judgement(*hit.time - 3 * unit).ulps == 3.0);
  // The normal is (-cos, sin) with sin = 1/2: dt = dx_1 + tan dx_2 + t dv_1 + dr / cos, in ulps
  // (x: 2^-52, r: 2^-54 -> 4 (1 + .577) + .283 * 4 + 1.155 = 8.6 of them.
  const double condition = 4 * (1 + std::tan(M_PI / 6)) + 4 * *hit.time + 1 / std::cos(M_PI / 6);
  CHECK(judgement(*hit.time + std::floor(4 * condition) * unit).verdict == Verdict::agree);
  CHECK_FALSE(judgement(*hit.time + std::floor(4 * condition) * unit).wrong_time);
  CHECK(judgement(*hit.time + std::ceil(4 * condition + 1) * unit).verdict == Verdict::agree);
  CHECK(judgement(*hit.time + std::ceil(4 * condition + 1) * unit).wrong_time);
  CHECK(judgement(*hit.time + std::ceil(4 * condition + 1) * unit).departs == Approx(4).epsilon(0.1));
  CHECK(judged(kScene, level(0.125), with_time(*hit.time + 30 * unit), 1).wrong_time);
  Answer logged = hit;
  logged.time.reset();
  CHECK_FALSE(judged(kScene, level(0.125), logged).ulps.has_value());
  CHECK(judged(kScene, level(0.125), logged).verdict == Verdict::agree);
  CHECK(judgement(INFINITY).other_quantity);
  CHECK_FALSE(judged(kScene, level(0.125), Answer::hit(at(2, 0), 1)).ulps.has_value());
}

TEST_CASE("A time that is off by a good part of itself is another quantity", "[oracle][verdict]") {
  const Answer hit = oracle::Oracle(kScene).first_hit(level(0.125));
  const double condition = oracle::Margins(kScene).condition(level(0.125), hit);
  const auto judgement = [&](double off, double ulps = oracle::kDefaultUlps) {
    return judged(kScene, level(0.125), Answer::hit(at(1, 0), *hit.time + off), ulps);
  };
  REQUIRE(condition == Approx(8.6).epsilon(0.01));
  const double most = 0x1p30 * condition * (std::nextafter(*hit.time, 1) - *hit.time);
  for (const double sign : {1.0, -1.0})
    for (const double ulps : {0.0, 4.0}) {
      const auto off = judgement(sign * 0.99 * most, ulps), other = judgement(sign * 1.01 * most, ulps);
      CHECK((off.verdict == Verdict::agree && off.wrong_time && !off.other_quantity));
      CHECK((other.verdict == Verdict::agree && other.wrong_time && other.other_quantity));
    }
  for (const double time : {-1.0, HUGE_VAL}) {
    const auto other = judged(kScene, level(0.125), Answer::hit(at(1, 0), time));
    CHECK((other.verdict == Verdict::agree && other.other_quantity));
  }
  // Where nothing is forgiven, a time is wrong however little it is off: here by 2^-1074 where an ulp of x is 512.
  Scene huge = unit_scene(2, 0x5p60);
  huge.lattices[0].vectors = {}, huge.lattices[0].rank = 0;
  const Query touching{{-3458764513820540928, 4611686018427387904}, {1, -1}, {}};
  const auto judged_at_once = [&](double ulps) {
    const Answer exact = oracle::Oracle(huge).first_hit(touching);
    REQUIRE(exact.time == 0.0);
    return oracle::Judge(huge).judge(touching, exact, Answer::hit(exact.obstacle, 0x1p-1074), ulps);
  };
  CHECK((judged_at_once(0).wrong_time && !judged_at_once(1).wrong_time));
  // At t = 0 an ulp is that of 0, but what the inputs' ulps make of the time is not.
  const Query at_once{{0.75, 0}, {1, 0}, {}};
  CHECK(judged(kScene, at_once, Answer::hit(at(1, 0), 0x1p-53)).wrong_time == false);
  CHECK(judged(kScene, at_once, Answer::hit(at(1, 0), 0x1p-30)).wrong_time);
  CHECK_FALSE(judged(kScene, at_once, Answer::hit(at(1, 0), 0x1p-30)).other_quantity);
  CHECK(judged(kScene, at_once, Answer::hit(at(1, 0), 0x1p-20)).other_quantity);
}

TEST_CASE("An exit is judged like a time, by its own condition", "[oracle][verdict]") {
  oracle::Request request;
  request.detail = true;
  const double unit = 0x1p-53;  // ulp of 0.716.., and of what is left of it from within
  // As above, with the other sign of the sine: dt = dx_1 - tan dx_2 + t dv_1 + dr / cos.
  for (const double x : {0.5, 1.0}) {
    const Query query{{x, 0.125}, {1, 0}, {}};
    const Answer exact = oracle::Oracle(kScene).first_hit(query, request);
    REQUIRE(exact.outcome == (x == 1 ? Outcome::inside : Outcome::hit));
    REQUIRE(exact.exit_time == Approx(1 + 0.25 * std::cos(M_PI / 6) - x).epsilon(1e-15));
    const double its = x == 1 ? unit / 4 : unit, tan = std::tan(M_PI / 6);
    const double change = 2 * (1 + tan) + 2 * *exact.exit_time + 0.5 / std::cos(M_PI / 6);
    const double condition = change * unit / its;
    const auto judgement = [&](double ulps) {
      Answer given = exact;
      given.exit_time = *exact.exit_time + ulps * its;
      Answer bare = exact;  // as answers of engines are judged, to which the exact exit is not computed
      bare.exit_time.reset(), bare.detail.reset();
      const oracle::Judgement one = judged(kScene, query, given);
      CHECK(oracle::Judge(kScene).judge(query, bare, given).wrong_time == one.wrong_time);
      CHECK(one.verdict == Verdict::agree);
      return one;
    };
    CHECK_FALSE(judgement(0).wrong_time);
    CHECK_FALSE(judgement(std::floor(4 * condition)).wrong_time);
    CHECK(judgement(std::ceil(4 * condition + 1)).wrong_time);
    CHECK(judgement(-std::ceil(4 * condition + 1)).departs == Approx(4).epsilon(0.1));
    CHECK(judgement(std::ceil(4 * condition + 1)).ulps == std::ceil(4 * condition + 1));
    if (x != 1) CHECK(judgement(std::floor(4 * condition)).ulps == 0);
    CHECK(judgement(0x1p31 * condition).other_quantity);
    Answer right_exit = exact;  // the wrong time is not excused by it
    if (x != 1) {
      right_exit.time = 0.2;
      CHECK(judged(kScene, query, right_exit).wrong_time);
    }
  }
}

TEST_CASE("The condition of an exit is the sum of its derivatives", "[oracle][verdict]") {
  Draw draw(4410);
  INFO("seed 4410");
  int exits = 0, insides = 0;
  for (int i = 0; i < 300; ++i) {
    const int d = draw.one_in(2) ? 2 : 3;
    Scene scene = unit_scene(d, draw.between(0.3, 0.9));
    scene.lattices[0].vectors = {}, scene.lattices[0].rank = 0;
    scene.lattices[0].atoms[0].position = draw.vec(d, -0.5, 0.5);
    const Query query{draw.vec(d, -1, 1), draw.vec(d, -3, 3), {}};
    oracle::Request request;
    request.detail = true;
    const auto exit = [&](const Scene& where, const Query& one) {
      return oracle::Oracle(where).first_hit(one, request).exit_time;
    };
    Answer given = oracle::Oracle(scene).first_hit(query, request);
    const Answer exact = given;
    if (!exact.exit_time || *exact.exit_time < 0.1) continue;
    if (exact.outcome == Outcome::hit && *exact.exit_time - *exact.time < 0.02)
      continue;  // grazed: bent too much
    // Central differences. An ulp of x is at least that of the scene's largest number.
    constexpr double kStep = 0x1p-20;
    double size = scene.lattices[0].atoms[0].radius, change = 0;
    for (const double component : scene.lattices[0].atoms[0].position)
      size = std::max(size, std::fabs(component));
    const auto add = [&](const auto& set, double its_ulp) {
      Scene scenes[2] = {scene, scene};
      Query queries[2] = {query, query};
      for (const int side : {0, 1}) set(scenes[side], queries[side], side ? kStep : -kStep);
      const auto before = exit(scenes[0], queries[0]), after = exit(scenes[1], queries[1]);
      REQUIRE((before && after));
      change += std::fabs(*after - *before) / (2 * kStep) * its_ulp;
    };
    for (int k = 0; k < d; ++k) {
      const NumberFormat b64 = NumberFormat::binary64;
      add([k](Scene&, Query& q, double step) { q.x[k] += step; },
          std::max(ulp(query.x[k], b64), ulp(size, b64)));
      add([k](Scene&, Query& q, double step) { q.v[k] += step; }, ulp(query.v[k], b64));
    }
    add([](Scene& s, Query&, double step) { s.lattices[0].atoms[0].radius += step; },
        ulp(scene.lattices[0].atoms[0].radius, NumberFormat::binary64));
    given.exit_time = *exact.exit_time + 0x1p-10;
    const oracle::Judgement judgement = oracle::Judge(scene).judge(query, exact, given);
    INFO(stream(scene, query));
    CHECK(judgement.wrong_time);
    CHECK(0x1p-10 / judgement.departs == Approx(change).epsilon(1e-3));
    ++(exact.outcome == Outcome::hit ? exits : insides);
  }
  CHECK(exits > 20);
  CHECK(insides > 20);
}

TEST_CASE("Starts inside are judged by the rule that is claimed", "[oracle][verdict]") {
  // Two discs overlap at x: the one of cell (0, 0) is left at t = 1/4, that of an atom beside it at t = 3/8.
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].vectors = {Vec{4, 0}, Vec{0, 4}, Vec{}};
  scene.lattices[0].atoms.push_back({Vec{0.125, 0}, 0.25, {}});
  const ObstacleId first{0, 0, {}}, second{0, 1, {}}, next{0, 0, {1, 0, 0}};
  const auto judged_by = [&](StartInside rule, const Query& query, const Answer& given, double ulps = 4) {
    Claim claim;
    claim.inside = rule;
    oracle::Request request;
    request.start = rule;
    return oracle::Judge(scene, claim)
        .judge(query, oracle::Oracle(scene).first_hit(query, request), given, ulps);
  };
  const auto is = [&](StartInside rule, const Query& query, const Answer& given, Verdict verdict,
                      bool wrong_time = false) {
    const oracle::Judgement one = judged_by(rule, query, given);
    CHECK(one.verdict == verdict);
    CHECK(one.wrong_time == wrong_time);
  };
  const Query within{{0, 0}, {1, 0}, {}};
  for (const StartInside rule : {StartInside::miss, StartInside::zero, StartInside::exit})
    is(rule, within, Answer::inside(first), Verdict::wrong);
  is(StartInside::miss, within, Answer::hit(next, 3.75), Verdict::agree);
  is(StartInside::miss, within, Answer::hit(next, 3.5), Verdict::agree, true);
  is(StartInside::miss, within, Answer::hit(first, 0.25), Verdict::wrong);
  is(StartInside::miss, within, Answer::never(), Verdict::wrong);
  is(StartInside::zero, within, Answer::hit(first, 0), Verdict::agree);
  is(StartInside::zero, within, Answer::hit(first, 0.25), Verdict::agree, true);
  is(StartInside::zero, within, Answer::hit(second, 0), Verdict::wrong);
  is(StartInside::zero, within, Answer::hit(next, 3.75), Verdict::wrong);
  is(StartInside::exit, within, Answer::hit(first, 0.25), Verdict::agree);
  is(StartInside::exit, within, Answer::hit(first, 0), Verdict::agree, true);
  is(StartInside::exit, within, Answer::hit(second, 0.375), Verdict::wrong);
  is(StartInside::exit, within, Answer::never(), Verdict::wrong);
  // By an ulp inside, or outside: both answers are right or excused.
  const double inner = std::nextafter(-0.25, 0), outer = std::nextafter(-0.25, -1);
  for (const double x : {inner, outer}) {
    const Query edge{{x, 0}, {1, 0}, {}};
    is(StartInside::miss, edge, Answer::hit(second, -0.125 - x),
       x == inner ? Verdict::agree : Verdict::ill_posed);
    is(StartInside::miss, edge, Answer::hit(first, 0), x == inner ? Verdict::ill_posed : Verdict::agree);
    is(StartInside::zero, edge, Answer::hit(first, 0), Verdict::agree);
    is(StartInside::exit, edge, Answer::hit(first, 0.25 - x), Verdict::agree);
    is(StartInside::exit, edge, Answer::hit(first, 0), Verdict::agree);
  }
  // An obstacle is left where the flight starts: its rule holds if x lies in it by an ulp.
  for (const StartInside rule : {StartInside::zero, StartInside::exit})
    for (const double y : {std::nextafter(0.25, 0), 0.25, std::nextafter(0.25, 1), 0.2500001}) {
      const Query leaving{{0, y}, {0, 1}, {}};
      is(rule, leaving, Answer::hit(first, 0),
         y < 0.25         ? Verdict::agree
         : y < 0.25000001 ? Verdict::ill_posed
                          : Verdict::wrong);
      is(rule, Query{leaving.x, leaving.v, first}, Answer::hit(first, 0), Verdict::wrong);
    }
  // Two exits within ulps of each other.
  scene.lattices[0].atoms[1].position[0] = 0x1p-55;
  is(StartInside::exit, within, Answer::hit(second, 0.25), Verdict::ill_posed);
  CHECK(judged_by(StartInside::exit, within, Answer::hit(second, 0.25), 0).verdict == Verdict::wrong);
  // Where x is free all rules are one.
  const Query free{{1, 0}, {1, 0}, {}};
  for (const StartInside rule : {StartInside::miss, StartInside::zero, StartInside::exit}) {
    is(rule, free, Answer::hit(next, 2.75), Verdict::agree);
    is(rule, free, Answer::hit(first, 2.75), Verdict::wrong);
  }
}

TEST_CASE("Among the subnormal numbers a rounding is as large as the time, and still a rounding",
          "[oracle][verdict]") {
  const Scene scene = unit_scene(2, 0.1909099887142184);
  const Query query{{-4.3436925586290234e-58, 0.19090998871421846}, {0, -2.247116418577895e+307}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.time == 0x1p-1074);
  const auto judgement = [&](double time) { return judged(scene, query, Answer::hit(at(0, 0), time), 0); };
  CHECK((judgement(0).verdict == Verdict::agree && judgement(0).wrong_time));
  CHECK((judgement(5 * 0x1p-1074).verdict == Verdict::agree && judgement(5 * 0x1p-1074).wrong_time));
  CHECK_FALSE(judgement(6 * 0x1p-1074).other_quantity);
  CHECK(judgement(0x1p-1000).other_quantity);
}

TEST_CASE("Excused answers are the same in other units, axes and bases", "[oracle][verdict][excused]") {
  int lists = 0, none = 0;
  for (const char* name :
       {"grazing", "ties", "boundary-starts", "corridor-edge", "ball-3d", "rows-and-layers"})
    for (std::uint64_t index = 0; index < 24; ++index) {
      const cases::Case one = cases::family_named(name)->make(302, index);
      const int dimension = one.scene.dimension;
      const auto listed = [](const Scene& scene, const Query& query) {
        return oracle::Judge(scene).excused(query, oracle::Oracle(scene).first_hit(query), 16, 32);
      };
      const OtherWords words{static_cast<int>(index) % dimension, 40, 13, index % 2 ? 1.0 : -1.0};
      Scene scene = words(one.scene);
      Query query = words(one.query, dimension);
      // The first two vectors the other way round, and the cells with them.
      const auto turned = [&](ObstacleId obstacle) {
        if (scene.lattices[static_cast<std::size_t>(obstacle.lattice)].rank_in(dimension) > 1)
          std::swap(obstacle.cell[0], obstacle.cell[1]);
        return obstacle;
      };
      for (Lattice& lattice : scene.lattices)
        if (lattice.rank_in(dimension) > 1) std::swap(lattice.vectors[0], lattice.vectors[1]);
      if (query.from) query.from = turned(*query.from);
      const auto here = listed(one.scene, one.query), there = listed(scene, query);
      INFO(name << ' ' << index << '\n' << stream(one.scene, one.query));
      REQUIRE(here.has_value() == there.has_value());
      if (!here) {
        ++none;
        continue;
      }
      REQUIRE(here->size() == there->size());
      for (const oracle::ExcusedAnswer& its : *here) {
        const auto same = [&](const oracle::ExcusedAnswer& other) {
          const bool names_one = its.answer.outcome != Outcome::never;
          return other.answer.outcome == its.answer.outcome &&
                 (!names_one || other.answer.obstacle == turned(its.answer.obstacle)) &&
                 other.ulps == Approx(its.ulps).epsilon(1e-9);
        };
        REQUIRE(std::ranges::any_of(*there, same));
        ++lists;
      }
    }
  INFO(lists << " answers, " << none << " without a list");
  CHECK(lists > 40);
}

TEST_CASE("Verdicts, and by how many radii a line misses, are the same in other units and axes",
          "[oracle][verdict]") {
  Draw draw(301);
  INFO("seed 301");
  std::map<Verdict, int> met;
  int wrong_times = 0;
  for (int i = 0; i < 600; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = unit_scene(dimension, draw.between(0.05, 0.4));
    for (int k = 0; k < dimension; ++k)
      scene.lattices[0].vectors[k] = sum(scene.lattices[0].vectors[k], draw.vec(dimension, -0.1, 0.1));
    const Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
    const Answer exact = oracle::Oracle(scene).first_hit(query);
    if (exact.outcome != Outcome::hit) continue;
    Answer given = exact;
    if (draw.one_in(3))
      given.obstacle.cell[0] = given.obstacle.cell[0].int64() + 1;
    else
      *given.time *= 1 + std::ldexp(draw.between(-1, 1), -static_cast<int>(draw.below(50)));
    if (*given.time < 0) continue;
    const OtherWords words{static_cast<int>(draw.below(static_cast<std::uint64_t>(dimension))),
                           static_cast<int>(draw.below(400)) - 200, static_cast<int>(draw.below(400)) - 200,
                           draw.one_in(2) ? -1.0 : 1.0};
    const auto judgement = judged(scene, query, given),
               other = judged(words(scene), words(query, dimension), words(given));
    INFO(stream(scene, query) << line(given, dimension));
    REQUIRE(judgement.verdict == other.verdict);
    REQUIRE(judgement.wrong_time == other.wrong_time);
    REQUIRE(judgement.departs == Approx(other.departs).epsilon(1e-9));
    const auto near = oracle::Margins(scene).approach(query, given.obstacle),
               far = oracle::Margins(words(scene)).approach(words(query, dimension), given.obstacle);
    REQUIRE((near.gap == far.gap && near.start_gap == far.start_gap && near.ahead == far.ahead));
    ++met[judgement.verdict];
    wrong_times += judgement.wrong_time;
  }
  CHECK(met[Verdict::agree] > wrong_times);
  CHECK(wrong_times > 20);
  CHECK(met[Verdict::wrong] > 50);
}

TEST_CASE("Where no ulp is forgiven an answer is the exact one or wrong", "[oracle][verdict]") {
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{0, 0.125}, 0.25, {}});
  const Query middle{{0.5, 0.0625}, {1, 0}, {}};  // an exact tie
  const Answer exact = oracle::Oracle(scene).first_hit(middle);
  const auto judgement = [&](const Answer& given) { return judged(scene, middle, given, 0); };
  CHECK(judgement(exact).verdict == Verdict::agree);
  const auto other = judgement(Answer::hit({0, 1, {1, 0, 0}}, *exact.time));
  CHECK((other.verdict == Verdict::wrong && other.departs == 0));
  CHECK(judgement(Answer::hit(exact.obstacle, std::nextafter(*exact.time, 1))).wrong_time);
}

TEST_CASE("Times beyond the largest binary64: an infinity is right, a small number is not",
          "[oracle][verdict]") {
  const Query slow{{0.5, 0.125}, {1e-320, 0}, {}};
  REQUIRE(std::isinf(*oracle::Oracle(kScene).first_hit(slow).time));
  const auto judgement = [&](double time) { return judged(kScene, slow, Answer::hit(at(1, 0), time)); };
  CHECK(judgement(INFINITY).verdict == Verdict::agree);
  CHECK_FALSE(judgement(INFINITY).wrong_time);
  // An ulp in so small a velocity is 1 / 2000 of it: the condition is larger than 2^22.
  CHECK(judgement(1).wrong_time);
  CHECK(judgement(1e300).wrong_time);
}

TEST_CASE("Answers so far away that the times of neighbours agree in 150 digits are judged, too",
          "[oracle][verdict]") {
  // Down between two columns of discs that touch, and so little to the left that it is one disc in 10^215.
  const Query query{{-33.5, 36}, {-1.300974440221139e-216, -1}, {}};
  const Integer row = *Integer::from_decimal("-1" + std::string(215, '0'));
  CHECK(judged(unit_scene(2, 0.5), query, Answer::hit({0, 0, {-34, row, 0}}, 1e215)).verdict ==
        Verdict::wrong);
}

TEST_CASE("An answer beyond any number of obstacles that ulps decide on is judged, and soon",
          "[oracle][verdict]") {
  // Far out an ulp of v moves the line by more than a radius: it meets what it meets by less than an ulp.
  const Query query{{0.5, 0}, {1, 1 + 0x1p-52}, {}};
  const Integer far = *Integer::from_decimal("1" + std::string(400, '0'));
  CHECK(judged(unit_scene(2, 1e-6), query, Answer::hit({0, 0, {far, far, 0}}, 1e300)).verdict ==
        Verdict::ill_posed);
}

TEST_CASE("never: along a row that is met it is wrong, whatever other rows lie beside the line",
          "[oracle][verdict]") {
  Scene scene = unit_scene(3, 0.25);
  scene.lattices[0].vectors = {Vec{1, 0, 0}};
  scene.lattices[0].rank = 1;
  scene.lattices[0].atoms = {Atom{{0, 5, 0}, 0.25, {}}, Atom{{0, 0, 0}, 0.25, {}}};
  const Query along{{0.5, 0.125, 0}, {1, 0, 0}, {}};
  REQUIRE(oracle::Oracle(scene).first_hit(along).obstacle.atom == 1);
  CHECK(judged(scene, along, Answer::never()).verdict == Verdict::wrong);
}
