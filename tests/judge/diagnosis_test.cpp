// What went wrong is called by its name, and what sets the failing questions apart is found, or is not.
#include "judge/diagnosis.hpp"

#include <catch2/catch.hpp>

#include "judge/findings.hpp"

using namespace lorentz;
using namespace lorentz::judge;

namespace {

Question asked(double radius, Vec x, Vec v, std::optional<ObstacleId> from = {}) {
  const auto place = std::make_shared<Place>(unit_scene(2, radius));
  const Query query{x, v, from};
  return {place, query, place->oracle().first_hit(query), "here", ""};
}

ObstacleId disc(long i, long j) {
  return {0, 0, {i, j, 0}};
}

std::optional<Diagnosis> diagnosed(const Question& question, const Answer& given) {
  return diagnosis_of(question, given, question.place->judge().judge(question.query, question.exact, given));
}

// The name of the cause, after a ~ if rounding of the inputs explains it.
std::string cause(const Question& question, const Answer& given) {
  const auto its = diagnosed(question, given);
  if (!its) return "none";
  return (its->severity == Severity::ill_posed ? "~" : "") + std::string(name_of(its->cause));
}

}  // namespace

TEST_CASE("later, though an obstacle is entered before the limit, is a cause of its own",
          "[judge][diagnosis]") {
  Question along = asked(0.25, {0.5, 0, 0}, {1, 0, 0});  // the disc (1, 0) is hit at 0.25
  const auto cause_of = [&](const Answer& given) {
    const auto its = diagnosis_of(along, given, question::judgement_of(along, given, 4));
    return its ? std::string(name_of(its->cause)) : "none";
  };
  along.max_time = 1;
  CHECK(cause_of(Answer::later()) == "later-for-hit");
  CHECK(cause_of(Answer::never()) == "never-for-hit");
  along.max_time = 0.125;
  CHECK(cause_of(Answer::later()) == "none");
}

TEST_CASE("Each way of being wrong has its name", "[judge][diagnosis]") {
  // Midway between two discs, along the row: the disc (1, 0) is hit at 0.25.
  const Question along = asked(0.25, {0.5, 0, 0}, {1, 0, 0});
  CHECK(cause(along, Answer::hit(disc(1, 0), 0.25)) == "none");
  CHECK(cause(along, Answer::undecided()) == "none");
  CHECK(cause(along, Answer::unsupported_because("no")) == "none");
  CHECK(cause(along, Answer::hit(disc(2, 0), 1.25)) == "passed-over");
  CHECK(cause(along, Answer::never()) == "never-for-hit");
  CHECK(cause(along, Answer::hit(disc(1, 1), 0.5)) == "false-hit");
  CHECK(cause(along, Answer::hit(disc(0, 0), -0.75)) == "behind");
  CHECK(cause(along, Answer::inside(disc(1, 0))) == "inside-not-so");
  CHECK(cause(along, Answer::hit({1, 0, {}}, 0.25)) == "no-obstacle");
  CHECK(cause(along, Answer::hit(disc(1, 0), 0.75)) == "not-the-time");
  CHECK(cause(along, Answer::hit(disc(1, 0), 0.25 + 1e-11)) == "wrong-time");
  CHECK(cause(along, Answer::error("no")) == "refused");
  CHECK(cause(along, Answer::error("cmd is what its message begins with")) == "refused");
  CHECK(diagnosis_of(along, Answer::error("no"), {oracle::Verdict::missing})->cause == Cause::no_answer);
  // Behind the start, far or near, whether the line that goes on backwards meets it or not.
  CHECK(cause(along, Answer::hit(disc(-7, 0), 6)) == "behind");
  CHECK(cause(along, Answer::hit(disc(-7, 1), 6)) == "behind");
  CHECK(diagnosed(along, Answer::hit(disc(1, 1), 0.5))->by_radii == Approx(3));
  CHECK(diagnosed(along, Answer::inside(disc(1, 0)))->by_radii == Approx(1));

  const Question leaving = asked(0.25, {0.125, 0, 0}, {1, 0, 0}, disc(0, 0));
  CHECK(cause(leaving, Answer::hit(disc(0, 0), 0)) == "leaving");
  CHECK(cause(leaving, Answer::inside(disc(0, 0))) == "leaving");
  const Question inside = asked(0.25, {0.125, 0, 0}, {1, 0, 0});
  CHECK(cause(inside, Answer::hit(disc(1, 0), 0.625)) == "inside-unseen");
  CHECK(diagnosed(inside, Answer::never())->by_radii == Approx(0.5));
  const Question inside_two = asked(0.6, {0.5, 0, 0}, {1, 0, 0});
  CHECK(cause(inside_two, Answer::inside(disc(1, 0))) == "inside-another");
  // Only touched, which is a margin of 0 and told without an obstacle.
  const Question touched = asked(0.25, {0.5, 0.25, 0}, {1, 0, 0});
  REQUIRE(touched.exact.outcome == Outcome::never);
  CHECK(cause(touched, Answer::hit(disc(2, 0), 1.5)) == "~false-hit-grazing");
  Scene two = unit_scene(2, 0.25);
  two.lattices[0].atoms.push_back({{0.25, 0, 0}, 0.125, {}});
  // On the edge of one and within another: rounding decides which.
  const auto overlapping = std::make_shared<Place>(two);
  const Query on_edge{{0.25, 0, 0}, {0, 1, 0}, {}};
  const Question within{overlapping, on_edge, overlapping->oracle().first_hit(on_edge), "", ""};
  REQUIRE(within.exact.obstacle == ObstacleId{0, 1, {0, 0, 0}});
  CHECK(cause(within, Answer::inside(disc(0, 0))) == "~inside-another");
  const Question two_at_once = asked(0.6, {0.5, 0.5, 0}, {0, 1, 0});
  CHECK(cause(two_at_once, Answer::hit(disc(1, 1), *two_at_once.exact.time)) == "~tie");

  Question nonsense = along;
  nonsense.text = R"("x":[0.5,0],"v":[0,0])";
  const auto its = diagnosis_of(nonsense, Answer::never(), {oracle::Verdict::wrong});
  CHECK(its->cause == Cause::answers_nonsense);
  CHECK(its->severity == Severity::nonsense);
}

TEST_CASE("What is only just met or missed is told apart, with the power of ten above it",
          "[judge][diagnosis]") {
  const Question met = asked(0.25, {0.5, 0.25 * (1 - 3e-10), 0}, {1, 0, 0});
  CHECK(cause(met, Answer::never()) == "never-for-grazing");
  CHECK(cause(met, Answer::hit(disc(2, 0), *met.exact.time + 1)) == "passed-over-grazing");
  CHECK(diagnosed(met, Answer::never())->by_radii == Approx(3e-10).epsilon(1e-5));
  const Question missed = asked(0.25, {0.5, 0.25 * (1 + 3e-10), 0}, {1, 0, 0});
  CHECK(cause(missed, Answer::hit(disc(1, 0), 0.5)) == "false-hit-grazing");
  const Question within_rounding = asked(0.25, {0.5, 0.25 - 0x1p-54, 0}, {1, 0, 0});
  CHECK(cause(within_rounding, Answer::never()) == "~never-for-grazing");
  CHECK(sentence_of(Cause::passed_over_grazing, 3e-10) ==
        "passes over obstacles that the line enters by less than 1e-09 of their radii");
}

TEST_CASE("An error of a time is told in radii along the ray, for an ellipsoid in its smallest semiaxes",
          "[judge][diagnosis]") {
  const auto off = [](const Scene& scene, const Vec& v, double later) {
    const auto place = std::make_shared<Place>(scene);
    const Query query{{0.5, 0, 0}, v, {}};
    const Question question{place, query, place->oracle().first_hit(query), "here", ""};
    REQUIRE(question.exact.outcome == Outcome::hit);
    const Answer given = Answer::hit(question.exact.obstacle, *question.exact.time + later);
    return std::pair(question::radii_off(question, given), diagnosed(question, given));
  };
  const auto [ball, diagnosis] = off(unit_scene(2, 0.25), {4, 0, 0}, 0.0625);
  CHECK(ball == Approx(1));
  REQUIRE(diagnosis);
  CHECK(diagnosis->by_radii == ball);
  CHECK(
      sentence_of(Cause::wrong_time, 0.003) ==
      "gives times of the right obstacle that are off by more than rounding of the inputs explains, by up to "
      "0.003 radii along the ray");
  const Question through = asked(0.25, {0.5, 0, 0}, {1, 0, 0});
  Answer wrong_exit = through.exact;  // 0.25, and right is 0.75
  for (const double exit : {1.0, 0.75 + 1e-12}) {
    wrong_exit.exit_time = exit;
    CHECK(diagnosed(through, wrong_exit)->by_radii == Approx(4 * (exit - 0.75)).epsilon(1e-3));
    CHECK(cause(through, wrong_exit) == (exit == 1 ? "not-the-time" : "wrong-time"));
  }
  wrong_exit.exit_time = INFINITY;
  CHECK_FALSE(diagnosed(through, wrong_exit)->by_radii);
  for (const StartInside rule : {StartInside::miss, StartInside::zero, StartInside::exit}) {
    Claim claim;
    claim.inside = rule;
    Question by_rule = through;
    by_rule.place = std::make_shared<Place>(unit_scene(2, 0.25), claim);
    wrong_exit.exit_time = 1;
    CHECK(question::radii_off(by_rule, wrong_exit) == Approx(rule == StartInside::miss ? 1 : 0));
  }
  Scene slender = unit_scene(2, 0.25);
  // Sheared: the smallest semiaxis is not a column's length.
  slender.lattices[0].atoms[0] = Atom{{}, 0, {{0.25, 0, 0}, {0.25, 0.0625, 0}}};
  const double expected = 0.0625 / question::smallest_semiaxis(slender.lattices[0].atoms[0], 2);
  CHECK(question::smallest_semiaxis(slender.lattices[0].atoms[0], 2) == Approx(0.0438).epsilon(0.01));
  CHECK(off(slender, {1, 0, 0}, 0.0625).first == Approx(expected));
  CHECK_FALSE(off(unit_scene(2, 0.25), {4, 0, 0}, INFINITY).first);
}

TEST_CASE("The obstacle that is told of is the one that condemns", "[judge][diagnosis]") {
  // The disc (0, 0) is entered by a rounding, (1, 0) by more than any, and (2, 0) is named. The line rises.
  const Question two = asked(0.25, {-0.5, -0.25 - 0x1p-31 + 0x1p-54, 0}, {1, 0x1p-30, 0});
  REQUIRE(two.exact.obstacle == disc(0, 0));
  const Answer given = Answer::hit(disc(2, 0), 2.3);
  const auto judgement = two.place->judge().judge(two.query, two.exact, given);
  REQUIRE(judgement.verdict == oracle::Verdict::wrong);
  CHECK(judgement.obstacle == disc(1, 0));
  const auto diagnosis = diagnosis_of(two, given, judgement);
  REQUIRE(diagnosis);
  const double depth = -two.place->margins().approach(two.query, disc(1, 0)).gap;
  CHECK(diagnosis->by_radii == Approx(depth));
  CHECK(judgement.departs > 4);
  // What rounding forgives is told with the rounding that it takes.
  const Answer next = Answer::hit(disc(1, 0), *two.exact.time + 1);
  const auto forgiven = two.place->judge().judge(two.query, two.exact, next);
  CHECK(forgiven.verdict == oracle::Verdict::ill_posed);
  CHECK(forgiven.obstacle == disc(0, 0));
  CHECK(forgiven.departs > 0);
  CHECK(forgiven.departs <= 4);
}

TEST_CASE("A circumstance is true of all that fail, and of few that do not", "[judge][circumstance]") {
  std::vector<Features> failing(8), right(100);
  for (std::size_t i = 0; i < right.size(); ++i) {
    right[i].flight = 1 + static_cast<double>(i);  // 1 .. 100
    right[i].in_space = i % 4 == 0;
    right[i].depth = 0.5;
  }
  for (Features& f : failing) f.flight = 2, f.depth = 0.5, f.in_space = true;
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->text == "on flights shorter than 10 lattice vectors");
  CHECK(circumstance_of(failing, right)->share == Approx(0.09));
  failing[3].flight = 5e3;
  CHECK(circumstance_of(failing, right)->text == "in 3D");
  CHECK(circumstance_of(failing, right)->share == Approx(0.25));
  failing[4].in_space = false;
  CHECK_FALSE(circumstance_of(failing, right));  // not of all
  failing.assign(5, failing[0]);
  CHECK(circumstance_of(failing, right)->share == Approx(0.09));
  failing.resize(2);
  CHECK_FALSE(circumstance_of(failing, right));  // two of a tenth may be chance
  for (Features& f : failing) f.depth = 3e-10;
  CHECK_FALSE(circumstance_of(failing, {}));
  failing.resize(4, failing[0]);
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->name == "depth");
  // Less than a whole radius is every obstacle entered: that says nothing, even if it tells them apart.
  for (Features& f : right) f.depth = std::nan("");
  for (Features& f : failing) f.depth = 0.4;
  failing[0].flight = 5e3, failing[1].in_space = false;
  failing.resize(8, failing[0]);
  CHECK_FALSE(circumstance_of(failing, right));
  for (Features& f : failing) f.depth = 0.04;
  for (Features& f : right) f.depth = 0.5;
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->name == "depth");
  // If 3 failures share something that no right answer has, as many right ones are needed as leave 1 in 50 000
  // to chance: (3 / n)^3 <= 1 / 50 000.
  failing.assign(3, Features{}), failing[0].in_space = failing[1].in_space = failing[2].in_space = true;
  CHECK_FALSE(circumstance_of(failing, std::vector<Features>(110)));
  REQUIRE(circumstance_of(failing, std::vector<Features>(111)));
  failing.resize(1);
  CHECK_FALSE(circumstance_of(failing, std::vector<Features>(149'999)));
  CHECK(circumstance_of(failing, std::vector<Features>(150'001)));
}

TEST_CASE("What only touches the line is told of as that", "[judge][diagnosis]") {
  // The line touches the disc (0, 0) and enters (1, 1). No input needs to move for the one that is named.
  const Question question = asked(0.3125, {0.203125, -0.25, 0}, {3, 4, 0});
  REQUIRE(question.exact.obstacle == disc(1, 1));
  CHECK(question.place->margins().approach(question.query, disc(0, 0)).gap == 0);
  CHECK(cause(question, Answer::hit(disc(0, 0), 0.05)) == "~false-hit-grazing");
}

TEST_CASE("Features are those of the whole scene, in lengths of its shortest vector", "[judge][features]") {
  Scene scene = unit_scene(2, 0.3);
  scene.lattices[0].vectors = {{{2, 0, 0}, {0, 3, 0}, {}}};
  scene.lattices[0].atoms.push_back(Atom{{1, 1.5, 0}, 0.2, {}});
  scene.lattices.push_back({{{{0, 1.5, 0}, {7, 0, 0}, {}}}, {Atom{{0.5, 0.7, 0}, 0.25, {}}}});
  const auto of = [](const Scene& asked_of, const Query& query) {
    const auto place = std::make_shared<Place>(asked_of);
    return std::pair(features_of({place, query, place->oracle().first_hit(query), "here", ""}),
                     place->oracle().first_hit(query));
  };
  const Query query{{0.8, -0.7, 0}, {1.75, 6, 0}, {}};
  const auto [its, exact] = of(scene, query);
  REQUIRE(exact.outcome == Outcome::hit);
  CHECK((its.several_lattices && its.several_atoms && its.other_cell));
  CHECK_FALSE((its.in_space || its.zero_component || its.leaving || its.ellipsoids));
  CHECK(its.radius == Approx(0.2 / 1.5));
  CHECK(its.speed == Approx(6.25));
  CHECK(its.start == Approx(std::hypot(0.8, 0.7) / 1.5));
  CHECK(its.flight == Approx(*exact.time * 6.25 / 1.5));
  scene.lattices[1].atoms[0] = Atom{{0.5, 0.7, 0}, 0, {{{0.25, 0, 0}, {0, 0.0625, 0}}}};
  const Features slender = of(scene, query).first;
  CHECK(slender.ellipsoids);
  CHECK(slender.radius == Approx(0.0625 / 1.5));
  scene.lattices[0].atoms[1].radius = 0.03125;
  CHECK(of(scene, query).first.radius == Approx(0.03125 / 1.5));
  const Features plain = of(unit_scene(3, 0.25), {{0.5, 0, 0}, {1, 0, 0.5}, ObstacleId{}}).first;
  CHECK((plain.in_space && plain.zero_component && plain.leaving));
  CHECK_FALSE((plain.several_lattices || plain.several_atoms || plain.other_cell));
  // A row has one vector, and a single disc has none.
  const Query downwards{{0, 3, 0}, {0, -1, 0}, {}};
  const Features row = of({2, {Lattice{{{{2, 0, 0}}}, {Atom{{0, 0, 0}, 0.5, {}}}, 1}}}, downwards).first;
  CHECK((row.radius == 0.25 && row.start == 1.5 && row.flight == 1.25));
  const Features disc_alone = of({2, {Lattice{{}, {Atom{{0, 0, 0}, 0.5, {}}}, 0}}}, downwards).first;
  CHECK((std::isnan(disc_alone.radius) && std::isnan(disc_alone.start) && std::isnan(disc_alone.flight)));
}

TEST_CASE("False hits from afar are told by the distance in radii", "[judge][circumstance]") {
  const auto place = std::make_shared<Place>(Scene{2, {Lattice{{}, {Atom{{0, 0, 0}, 4, {}}}, 0}}});
  const auto from = [&](double x) {
    const Query query{{x, 12, 0}, {-1, 0, 0}, {}};
    return features_of({place, query, place->oracle().first_hit(query), "here", ""});
  };
  CHECK(from(-3).distance == Approx(std::hypot(3, 12) / 4));
  std::vector<Features> failing(8, from(0x1p28));
  failing[3] = from(0x1.8p40);
  std::vector<Features> right(100, from(0x1p20));
  // Their starts lie as far from the origin in lattice vectors, of which there are none.
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->text ==
        "from starts 2^26 radii or more from the obstacle in question");
  right.assign(100, from(0x1p29));
  CHECK_FALSE(circumstance_of(failing, right));
  // The distance is that of the obstacle that is named, wherever others stand.
  const Question square = asked(0.25, {0.5, 0, 0}, {1, 0, 0});
  CHECK(features_of(square, disc(-7, 0)).distance == Approx(30));
  CHECK(features_of(square, disc(1, 0)).distance == Approx(2));
  CHECK(features_of(square).flight_in_radii == Approx(1));
  // How deep the line enters is said of the obstacle that is hit, whichever is in question.
  CHECK(features_of(square, disc(1, 0)).depth == Approx(1));
  CHECK(features_of(asked(0.25, {0.5, 0.125, 0}, {1, 0, 0}), disc(1, 0)).depth == Approx(0.5));
  CHECK(features_of(square, disc(-7, 0)).depth == Approx(1));
}

TEST_CASE("Questions about far cells are told from others", "[judge][circumstance]") {
  const auto far_start = [](double i) { return features_of(asked(0.25, {i + 0.5, 0, 0}, {1, 0, 0})); };
  CHECK(far_start(0).cell == 1);
  CHECK(far_start(-7e8).cell == 7e8 - 1);
  CHECK(features_of(asked(0.25, {0.5, 0.5, 0}, {1, 0, 0})).cell != 0);  // never: there is none
  std::vector<Features> failing(8, far_start(3e9));
  for (Features& f : failing) f.start = std::nan("");
  std::vector<Features> right(100, far_start(2));
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->text == "in far cells, with numbers of 1e+09 or more");
  for (Features& f : right) f.cell = 5e9;
  CHECK_FALSE(circumstance_of(failing, right));
}

TEST_CASE("Each part of a finding has its own largest distance in radii", "[judge][findings]") {
  const Question question = asked(0.25, {0.5, 0, 0}, {2, 0, 0});  // a path of one radius
  Findings findings;
  for (int i = 0; i < 6; ++i)
    for (const double time : {2 * *question.exact.time, *question.exact.time + 10}) {
      const Answer given = Answer::hit(disc(1, 0), time);
      const auto judgement = question.place->judge().judge(question.query, question.exact, given);
      findings.add({question, given, judgement, *diagnosis_of(question, given, judgement)}, "times");
    }
  std::deque<question::ExaminedRow> rows(1);
  rows[0].name = "times", rows[0].tally.queries = 100;
  std::vector<Finding> all = findings.all(rows);
  REQUIRE(all.size() == 2);
  if (all[0].quantity.empty()) std::swap(all[0], all[1]);
  CHECK(all[0].quantity == kDistance);  // in place of the time
  CHECK(all[0].by_radii == Approx(1));
  CHECK(all[1].by_radii == Approx(80));
}

TEST_CASE("Findings of one cause are one, the simplest case in front, the most frequent cause first",
          "[judge][findings]") {
  const Question plain = asked(0.25, {0.5, 0, 0}, {1, 0, 0}),
                 odd = asked(0.25, {0.4375, 0.0234375, 0}, {0.984375, 0.015625, 0});
  Findings findings;
  const auto add = [&](const Question& question, const Answer& given, const char* row) {
    const auto judgement = question.place->judge().judge(question.query, question.exact, given);
    findings.add({question, given, judgement, *diagnosis_of(question, given, judgement)}, row);
  };
  add(odd, Answer::never(), "many");
  add(odd, Answer::hit(disc(1, 0), *odd.exact.time + 1e-9), "few");
  add(plain, Answer::never(), "many");
  add(odd, Answer::never(), "many");
  add(odd, Answer::hit(disc(2, 0), *odd.exact.time + 1), "few");
  add(odd, Answer::inside(disc(1, 0)), "many");
  std::deque<question::ExaminedRow> rows(3);
  rows[0].name = "many", rows[0].tally.queries = 100;
  rows[1].name = "few", rows[1].tally.queries = 20, rows[1].is_hard = false;
  rows[2].name = "none", rows[2].is_hard = false;
  const std::vector<Finding> all = findings.all(rows);
  REQUIRE(all.size() == 4);
  // One of twenty plain flights is more than three of a hundred hard ones; but no wrong time is.
  CHECK(all[0].cause() == Cause::passed_over);
  CHECK(all[0].share_of_plain == Approx(0.05));
  CHECK(all[1].cause() == Cause::never_for_hit);
  CHECK(all[1].share_of_hard == Approx(0.03));
  CHECK(all[1].count == 3);
  CHECK(all[1].simplest.question.query.v[1] == 0);
  CHECK(all[1].by_radii == Approx(1));
  CHECK(all[2].cause() == Cause::inside_not_so);
  CHECK(all[3].cause() == Cause::wrong_time);
}
