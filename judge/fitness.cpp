#include "judge/fitness.hpp"

#include <algorithm>

#include <lorentz/batch.hpp>
#include <lorentz/certificate_check.hpp>
#include <lorentz/certified.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/walk.hpp>
#include "src/problem/same_answer.hpp"

namespace lorentz::fitness {
namespace {

Cell cell(const char* a, const char* b, const char* c = "0") {
  return {*Integer::from_decimal(a), *Integer::from_decimal(b), *Integer::from_decimal(c)};
}

Answer hit(int lattice, const Cell& cell, double time) {
  return Answer::hit({lattice, 0, cell}, time);
}

Scene square(double radius) {
  return unit_scene(2, radius);
}

// The square lattice and a copy of it turned by about pi / 5.
Scene superposition() {
  constexpr double kCosine = 0.8090169943749475, kSine = 0.5877852522924731;
  return {2,
          {{{{{1, 0, 0}, {0, 1, 0}}}, {{{}, 0.01, {}}}},
           {{{{kCosine, kSine, 0}, {-kSine, kCosine, 0}}}, {{{0.3, 0.1, 0}, 0.03, {}}}}}};
}

Scene leaning_ellipses() {
  return {2, {{{{{1, 0, 0}, {0.25, 1.25, 0}}}, {{{}, 0, {{0.16, 0.12, 0}, {-0.05, 0.07, 0}}}}}}};
}

// Questions of different kinds: drawn, hopeless, very far, inside; in 3D; among ellipses; in two lattices. A
// test compares each of them with the procedure of the golden sets, in which oracle, walk and check of
// certificates agree.
const auto& known_answers() {
  static const std::vector<std::tuple<Scene, Query, Answer>> known{
      {square(0.1),
       {{0, 0.445}, {0.9998476951563913, 0.01745240643728351}, {}},
       hit(0, cell("27", "1"), 26.950854326278535)},
      {square(0.1), {{0, 0.445}, {1, 0}, {}}, Answer::never()},
      {square(0.1), {{0, 0.445}, {1, 1e-20}, {}}, hit(0, cell("45500000000000001275", "1"), 4.55e+19)},
      {square(0.1), {{0.05, 0}, {1, 0}, {}}, Answer::inside({0, 0, cell("0", "0")})},
      {unit_scene(3, 0.01),
       {{0.5, 0.5, 0.5}, {1, 0.6180339887498949, 0.41421356237309503}, {}},
       hit(0, cell("9970", "6162", "4130"), 9969.500777773532)},
      {unit_scene(3, 0.01),
       {{0.5, 0.5, 0.5}, {1, 1e-9, 1e-18}, {}},
       hit(0, cell("490000000499996808", "490000001", "1"), 4.900000004999968e+17)},
      {leaning_ellipses(),
       {{0.5, 0.5}, {1, -0.7320508075688772}, {}},
       hit(0, cell("1", "0"), 0.5252055495001422)},
      {superposition(), {{0.5, 0.5}, {1, 1e-8}, {}}, hit(1, cell("20", "-14"), 24.203702892796873)},
  };
  return known;
}

// An examination that throws counts as unfit.
Symptom guarded(const char* name, const std::vector<Use>& spoiled, const std::function<Symptom()>& examine) {
  try {
    return examine();
  } catch (const std::exception& error) {
    return {name, false, error.what(), spoiled};
  }
}

bool refuted_by_check(const Scene& scene, const Query& query, const Answer& proven, const Answer& claimed) {
  const oracle::Certificate proof = oracle::Prover(scene).prove(query, proven);
  return oracle::CertificateCheck(scene).refutation(query, claimed, proof).has_value();
}

Answer by_batch(const Scene& scene, const Query& query) {
  QueryTable queries;
  queries.push_back(query);
  FlightTable flights;
  flights.resize(1);
  Batch(scene).fly(queries.columns(), flights.columns(), Batch::Time::rounded);
  return answer_of(flights[0]);
}

Answer by_reduction(const Scene& scene, const Query& query) {
  return answer_of(
      Reduction(scene).fly(query, std::numeric_limits<double>::infinity(), Reduction::Time::rounded));
}

// Bornemann, Laurie, Wagon, Waldvogel, "The SIAM 100-digit challenge" (2004), problem 2.
std::string distance_of_photon() {
  const auto number = [](const char* text) { return *rational_from(text); };
  RationalScene mirrors = rational(square(0.25));
  mirrors.lattices[0].atoms[0].radius = number("1/3");
  Start photon;
  photon.x = {number("1/2"), number("1/10"), 0.0};
  photon.v = {Surd(1.0), Surd(), Surd()};
  oracle::Journey journey;
  journey.time = 10.0, journey.digits = 28;
  return oracle::Itinerary(mirrors).follow(photon, journey).distance;
}

}  // namespace

Symptom examine(const char* name, std::vector<Use> spoiled, std::size_t may_leave, const Ask& ask) {
  return guarded(name, spoiled, [&]() -> Symptom {
    std::size_t right = 0, undecided = 0;
    for (const auto& [scene, query, known] : known_answers()) {
      const Answer answer = ask(scene, query);
      right += same_answer(answer, known);
      undecided += answer.outcome == Outcome::undecided;
    }
    const std::size_t all = known_answers().size();
    return {name, right + undecided == all && undecided <= may_leave,
            std::to_string(right) + " of " + std::to_string(all) + " answers right" +
                (undecided ? ", " + std::to_string(undecided) + " left undecided" : ""),
            spoiled};
  });
}

Symptom examine_certificates(const Refuted& refuted) {
  constexpr const char* kName = "certificates";
  const std::vector<Use> spoiled{Use::certificates};
  return guarded(kName, spoiled, [&]() -> Symptom {
    std::size_t accepted = 0, refused = 0;
    for (const auto& [scene, query, known] : known_answers()) {
      accepted += !refuted(scene, query, known, known);
      Answer other = known;
      if (known.outcome == Outcome::never)
        other = hit(0, cell("5", "0"), 5);
      else
        other.obstacle.cell[0] = 12345;
      refused += refuted(scene, query, known, other);
    }
    const std::size_t all = known_answers().size();
    return {kName, accepted == all && refused == all,
            std::to_string(accepted) + " of " + std::to_string(all) + " true ones accepted, " +
                std::to_string(refused) + " false ones refused",
            spoiled};
  });
}

Symptom examine_itinerary(const std::function<std::string()>& distance) {
  constexpr const char *kName = "problem 2 of the 100-digit challenge",
                       *kDistance = "0.9952629194433541608903118094";
  const std::vector<Use> spoiled{Use::itineraries};
  return guarded(kName, spoiled, [&]() -> Symptom {
    const std::string end = distance();
    return {kName, end == kDistance, end.empty() ? "no answer" : end, spoiled};
  });
}

std::vector<Symptom> examine_known_answers() {
  constexpr std::size_t kTooFarToWalk = 3;  // the second oracle goes cell by cell
  return {
      examine("reduction", {Use::engines}, 1, by_reduction),
      examine("batch", {Use::engines}, 1, by_batch),
      examine("the oracle", {Use::oracle, Use::certificates, Use::itineraries}, 0,
              [](const Scene& scene, const Query& query) { return oracle::Oracle(scene).first_hit(query); }),
      examine("the second oracle", {Use::oracle}, kTooFarToWalk,
              [](const Scene& scene, const Query& query) { return oracle::Walk(scene).first_hit(query); }),
      examine(
          "certified", {Use::oracle, Use::engines}, 0,
          [](const Scene& scene, const Query& query) { return oracle::Certified(scene).first_hit(query); }),
      examine_certificates(refuted_by_check),
      examine_itinerary(distance_of_photon)};
}

const char* name_of(Use use) {
  constexpr const char* kNames[] = {"the binary64 engines, paths and starts", "exact answers", "certificates",
                                    "certified trajectories"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Use::itineraries) + 1);
  return kNames[static_cast<int>(use)];
}

std::vector<Symptom> findings_of(const std::vector<ArithmeticCheck>& checks) {
  std::vector<Symptom> findings;
  for (const ArithmeticCheck& check : checks)
    findings.push_back({check.name,
                        check.fit,
                        check.fit ? check.found : check.found + "; it should be: " + check.expected,
                        {std::begin(kUses), std::end(kUses)}});
  return findings;
}

std::vector<Use> unfit_uses(const std::vector<Symptom>& findings) {
  std::vector<Use> uses;
  for (const Use use : kUses)
    if (std::ranges::any_of(findings, [use](const Symptom& finding) {
          return !finding.fit && std::ranges::count(finding.spoiled, use) > 0;
        }))
      uses.push_back(use);
  return uses;
}

}  // namespace lorentz::fitness
