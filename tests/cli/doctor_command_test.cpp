// lorentz doctor: this machine is fit, and one with broken arithmetic is not.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <lorentz/environment.hpp>
#include <lorentz/oracle.hpp>
#include "judge/fitness.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// The checks that fail, by name, and what they found.
std::vector<std::string> broken() {
  std::vector<std::string> names;
  for (const ArithmeticCheck& check : arithmetic_checks())
    if (!check.fit) names.push_back(check.name + ": " + check.found);
  return names;
}

}  // namespace

TEST_CASE("lorentz doctor finds this machine fit, and says what it looked at", "[cli][doctor]") {
  const auto [status, out, err] = Folder().lorentz("doctor --json");
  INFO(out << err);
  CHECK(status == 0);
  CHECK(contains(out, R"({"fit":true,)"));
  CHECK(contains(out, R"("not_fit_for":[])"));
  for (const char* engine : {"reduction", "batch"})
    CHECK(contains(
        out, fmt::format(R"({{"name":"{}","fit":true,"found":"7 of 8 answers right, 1 left undecided"}})",
                         engine)));
  CHECK(contains(out, R"("name":"problem 2 of the 100-digit challenge","fit":true)"));
  for (const char* library : {"GMP", "Arb", "CGAL", "Highway", "SQLite", "simdjson"})
    CHECK(contains(out, std::string("\"") + library + ' '));
}

TEST_CASE("lorentz doctor needs no large stack", "[cli][doctor]") {
#ifdef __SANITIZE_ADDRESS__
  const char* kilobytes = "1024";  // its frames are wide
#else
  const char* kilobytes = "128";
#endif
  const std::string command =
      "ulimit -s " + std::string(kilobytes) + "; " + LORENTZ_PROGRAM + " doctor >/dev/null";
  CHECK(std::system(command.c_str()) == 0);
}

TEST_CASE("lorentz doctor calls a machine that rounds otherwise not fit, and says for what",
          "[cli][doctor]") {
  const auto [status, out, err] = Folder().run(
      "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" LORENTZ_TOWARD_ZERO " " LORENTZ_PROGRAM " doctor");
  CHECK(out.find("\nlibraries: GMP ") != std::string::npos);
  INFO(out << err);
  CHECK(status == 1);
  CHECK(contains(out, "rounding mode                          toward zero; it should be: to nearest"));
  CHECK(contains(out, "\nNOT FIT for the binary64 engines, paths and starts; "));
}

TEST_CASE("Broken arithmetic is seen, and named", "[cli][doctor]") {
  using Names = std::vector<std::string>;
  CHECK(broken() == Names{});
  for (const auto& [mode, name] :
       {std::pair{FE_UPWARD, "upward"}, {FE_DOWNWARD, "downward"}, {FE_TOWARDZERO, "toward zero"}}) {
    std::fesetround(mode);
    const Names found = broken();
    std::fesetround(FE_TONEAREST);
    CHECK(found == Names{std::string("rounding mode: ") + name});
  }
#if defined(__SSE2__)
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x40;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | kFlushToZero);
  const Names flushed = broken();
  _mm_setcsr(before | kDenormalsAreZero);
  const Names taken = broken();
  _mm_setcsr(before);
  CHECK(flushed == Names{"subnormal results: flushed to zero"});
  CHECK(taken == Names{"subnormal operands: taken for zero"});
#endif
}

namespace {

using namespace lorentz::fitness;

// An oracle that gives its known answers but this one, which it spoils.
Ask oracle_but(int which, const std::function<void(Answer&)>& spoil) {
  return [=, asked = std::make_shared<int>(0)](const Scene& scene, const Query& query) {
    Answer answer = oracle::Oracle(scene).first_hit(query);
    if ((*asked)++ == which) spoil(answer);
    return answer;
  };
}

const std::vector<Use> kSpoiled{Use::oracle, Use::itineraries};

}  // namespace

TEST_CASE("An engine that gives one wrong answer, or leaves one too many undecided, is not fit", "[doctor]") {
  const auto nothing = [](Answer&) {};
  const Symptom good = examine("it", kSpoiled, 0, oracle_but(-1, nothing));
  CHECK(good.fit);
  CHECK(good.name == "it");
  CHECK(good.found == "8 of 8 answers right");
  CHECK(good.spoiled == kSpoiled);
  for (int which = 0; which < 8; ++which) {
    INFO("question " << which);
    const Symptom wrong =
        examine("it", kSpoiled, 3, oracle_but(which, [](Answer& answer) {
                  answer = answer.outcome == Outcome::never ? Answer::hit({}, 1) : Answer::never();
                }));
    CHECK_FALSE(wrong.fit);
    CHECK(wrong.found == "7 of 8 answers right");
    const Ask silent = oracle_but(which, [](Answer& answer) { answer = Answer::undecided(); });
    const Symptom left = examine("it", kSpoiled, 0, silent);
    CHECK_FALSE(left.fit);
    CHECK(left.found == "7 of 8 answers right, 1 left undecided");
    CHECK(examine("it", kSpoiled, 1, oracle_but(which, [](Answer& answer) { answer = Answer::undecided(); }))
              .fit);
    // The right obstacle an ulp too late; at the right time another cell, atom or lattice.
    int spoilt = 0;
    const std::function<void(Answer&)> spoils[] = {[](Answer& a) {
                                                     if (a.time) a.time = std::nextafter(*a.time, 0);
                                                   },
                                                   [](Answer& a) {
                                                     if (a.outcome == Outcome::hit) a.obstacle.cell[1] = 77;
                                                   },
                                                   [](Answer& a) {
                                                     if (a.outcome == Outcome::inside) ++a.obstacle.atom;
                                                   },
                                                   [](Answer& a) {
                                                     if (a.outcome == Outcome::hit) ++a.obstacle.lattice;
                                                   }};
    for (const auto& spoil : spoils) {
      bool changes = false;
      const Symptom found = examine("it", kSpoiled, 0, oracle_but(which, [&](Answer& answer) {
                                      const Answer before = answer;
                                      spoil(answer);
                                      changes =
                                          !(answer.time == before.time && answer.obstacle == before.obstacle);
                                    }));
      CHECK(found.fit == !changes);
      spoilt += changes;
    }
    CHECK(spoilt == (which == 1 ? 0 : which == 3 ? 1 : 3));
  }
  CHECK_FALSE(examine("it", kSpoiled, 3, [](const Scene&, const Query&) { return Answer::undecided(); }).fit);
  const Symptom broken = examine(
      "it", kSpoiled, 8, [](const Scene&, const Query&) -> Answer { throw std::runtime_error("no memory"); });
  CHECK_FALSE(broken.fit);
  CHECK(broken.found == "no memory");
  CHECK(broken.name == "it");
  CHECK(broken.spoiled == kSpoiled);
}

TEST_CASE("A check of certificates that refuses a true one, or takes a false one, is not fit", "[doctor]") {
  // The party is asked about the true answer, and then about a false one, eight times.
  const auto with = [](int which, bool broken) {
    return examine_certificates([=, asked = std::make_shared<int>(0)](
                                    const Scene&, const Query&, const Answer& proven, const Answer& claimed) {
      const bool is_false = proven.outcome != claimed.outcome || !(proven.obstacle == claimed.obstacle);
      return is_false != (broken && (*asked)++ == which);
    });
  };
  CHECK(with(0, false).fit);
  for (int which = 0; which < 16; ++which) {
    const Symptom found = with(which, true);
    CHECK_FALSE(found.fit);
    CHECK(found.found == (which % 2 == 0 ? "7 of 8 true ones accepted, 8 false ones refused"
                                         : "8 of 8 true ones accepted, 7 false ones refused"));
    CHECK(found.spoiled == std::vector<Use>{Use::certificates});
  }
  const Symptom broken =
      examine_certificates([](const Scene&, const Query&, const Answer&, const Answer&) -> bool {
        throw std::runtime_error("no proof");
      });
  CHECK_FALSE(broken.fit);
  CHECK(broken.found == "no proof");
  CHECK(broken.spoiled == std::vector<Use>{Use::certificates});
}

TEST_CASE("A path whose last digit is another is not fit", "[doctor]") {
  CHECK(examine_itinerary([] { return "0.9952629194433541608903118094"; }).fit);
  const Symptom other = examine_itinerary([] { return "0.9952629194433541608903118095"; });
  CHECK_FALSE(other.fit);
  CHECK(other.found == "0.9952629194433541608903118095");
  CHECK(other.spoiled == std::vector<Use>{Use::itineraries});
  CHECK(examine_itinerary([] { return ""; }).found == "no answer");
  CHECK_FALSE(examine_itinerary([]() -> std::string { throw std::runtime_error("stuck"); }).fit);
}

TEST_CASE("What is spoiled is what some unfit finding spoils, and nothing else", "[doctor]") {
  const Symptom fit{"a", true, "", {Use::engines, Use::oracle}}, one{"b", false, "", {Use::certificates}},
      two{"c", false, "", {Use::oracle, Use::certificates}};
  CHECK(unfit_uses({fit}).empty());
  CHECK(unfit_uses({fit, one}) == std::vector<Use>{Use::certificates});
  CHECK(unfit_uses({one, fit, two}) == std::vector<Use>{Use::oracle, Use::certificates});
  const auto findings = findings_of({{"rounding", true, "up", "up"}, {"precision", false, "24", "53"}});
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].fit);
  CHECK(findings[0].found == "up");
  CHECK_FALSE(findings[1].fit);
  CHECK(findings[1].name == "precision");
  CHECK(findings[1].found == "24; it should be: 53");
  CHECK(unfit_uses(findings).size() == 4);
  std::map<std::string, std::vector<Use>> spoiled;
  for (const Symptom& finding : examine_known_answers()) {
    CHECK(finding.fit);
    spoiled[finding.name] = finding.spoiled;
  }
  CHECK(spoiled.size() == 7);
  CHECK(spoiled["batch"] == std::vector<Use>{Use::engines});
  CHECK(spoiled["the oracle"] == std::vector<Use>{Use::oracle, Use::certificates, Use::itineraries});
  CHECK(spoiled["the second oracle"] == std::vector<Use>{Use::oracle});
  CHECK(spoiled["certified"] == std::vector<Use>{Use::oracle, Use::engines});
  std::set<std::string> names;
  for (const Use use : kUses) names.insert(name_of(use));
  CHECK(names.size() == 4);
}
