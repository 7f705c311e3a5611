#include "judge/golden/maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include "src/problem/same_answer.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::golden {
namespace {

constexpr std::int64_t kWalkCells = 100;

// The number of significant digits of a decimal number as it is written here; 0 for zero.
int significant_digits(std::string_view decimal) {
  int digits = 0;
  for (const char c : decimal.substr(0, decimal.find('e')))
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  return digits;
}

bool is_same(const oracle::ExcusedAnswer& a, const oracle::ExcusedAnswer& b) {
  return a.ulps == b.ulps && a.answer.outcome == b.answer.outcome && a.answer.obstacle == b.answer.obstacle;
}

// A record must have exactly the parts that belong to its outcome.
std::optional<std::string> flaw_of_form(const Record& record) {
  const Outcome outcome = record.expect.outcome;
  const std::string& decimal = record.expect.time_decimal;
  if (outcome == Outcome::error && (record.margin || record.condition || record.time_change ||
                                    record.certificate || !record.acceptable.empty()))
    return "an error has no margin, condition, time_change, certificate or acceptable";
  if (outcome != Outcome::hit && !decimal.empty()) return "it has a time_decimal, and hits nothing";
  if (outcome != Outcome::hit) return std::nullopt;
  if (decimal.empty()) return "it has no time_decimal";
  if (decimal != "0" && significant_digits(decimal) != kDigits)
    return "its time_decimal has not " + std::to_string(kDigits) + " digits";
  return std::nullopt;
}

bool is_hard(const std::optional<oracle::HardestDecision>& decision) {
  return decision && decision->margin < oracle::kLargestMargin;
}

// "misses lattice 0, atom 0, cell [3,1] by 2.1 ulps"; empty if no decision is hard.
std::string comment_on(const std::optional<oracle::HardestDecision>& decision, const Components& count) {
  if (!is_hard(decision)) return "";
  const ObstacleId& its = decision->obstacle;
  const char* what = decision->kind == oracle::DecisionKind::containing
                         ? (decision->yes ? "x lies in" : "x lies outside of")
                     : decision->kind == oracle::DecisionKind::meeting
                         ? (decision->yes ? "the line meets" : "the line misses")
                         : "the line enters later";
  return fmt::format("{} lattice {}, atom {}, cell [{}], by {:.3g} ulps", what, its.lattice, its.atom,
                     decimals(components(its.cell, count.of_cells(its.lattice)), ","), decision->margin);
}

}  // namespace

Maker::Maker(const Scene& scene, std::string scene_line, Others others, NumberFormat precision)
    : scene_(scene),
      scene_line_(std::move(scene_line)),
      precision_(precision),
      others_(std::move(others)),
      oracle_(scene),
      walk_(scene, kWalkCells),
      margins_(scene, precision),
      judge_(scene, {precision, {}}),
      prover_(scene),
      check_(scene) {}

Answer Maker::walked(const Query& query) const {
  return others_.walk ? others_.walk(query) : walk_.first_hit(query);
}

// Returns the hardest decision.
std::optional<oracle::HardestDecision> Maker::measure(const Query& query, Record& record) const {
  const auto decision = margins_.hardest_decision(query, record.expect);
  if (decision) record.margin = decision->margin;
  record.comment = comment_on(decision, scene_);
  if (record.expect.outcome != Outcome::hit) return decision;
  record.condition = margins_.condition(query, record.expect);
  record.time_change = margins_.time_change(query, record.expect);
  return decision;
}

// Adds the other acceptable answers, or the tag that says that a judge is needed.
void Maker::excuse(const Query& query, Record& record) const {
  if (auto excused = judge_.excused(query, record.expect, kExcusedUlps, kMostAcceptable))
    record.acceptable = std::move(*excused);
  else
    record.tags.emplace_back(kNeedsJudge);
}

Proved Maker::prove(const Query& query) const {
  Proved proved{oracle_.first_hit(query, {.digits = kDigits, .detail = is_one_obstacle(scene_)}), {}};
  proved.exact.detail.reset();
  proved.certificate =
      others_.prove ? others_.prove(query, proved.exact) : prover_.prove(query, proved.exact);
  bool too_long = false;
  const auto why = check_.refutation(query, proved.exact, proved.certificate, &too_long);
  if (too_long)
    throw ProofTooLong("no checker goes through the proof, which " + *why + ":\n" + asked_of(query));
  if (why)
    throw std::logic_error("the check of the certificate (" + *why + ") does not agree with the oracle:\n" +
                           asked_of(query));
  return proved;
}

std::string Maker::asked_of(const Query& query) const {
  return scene_line_ + "\n{" + question_of(query, scene_) + "}";
}

MadeRecord Maker::make(std::string question, const std::optional<Query>& query) const {
  MadeRecord made;
  Record& record = made.record;
  record.id = id_of(scene_line_, question);
  record.question = std::move(question);
  if (!query) {
    record.expect = Answer::error("no query");
    return made;
  }
  Proved proved = prove(*query);
  record.expect = std::move(proved.exact);
  record.certificate = std::move(proved.certificate);
  const Answer walked = this->walked(*query);
  made.walked = walked.outcome != Outcome::undecided;
  if (made.walked && !same_answer(walked, record.expect))
    throw std::logic_error("walk does not agree with the oracle:\n" + asked_of(*query));
  made.hardest = measure(*query, record);
  excuse(*query, record);
  return made;
}

std::optional<std::string> Maker::flaw_of(const Record& record, const std::optional<Query>& query,
                                          bool ask_walk, int format) const {
  if (record.id != id_of(scene_line_, record.question))
    return "the id does not belong to the question (it is made from the scene's line and the question as "
           "they are written: blanks and digits count)";
  if (auto why = flaw_of_form(record)) return why;
  if (!query || record.expect.outcome == Outcome::error) {
    if (!query && record.expect.outcome == Outcome::error) return std::nullopt;
    return query ? "this is a query; `error` does not answer it"
                 : "this is not a query; its only answer is `error`";
  }
  if (!consists_of(scene_, precision_) || !consists_of(*query, precision_))
    return std::string("its numbers are not of ") + name_of(precision_);
  if (!record.certificate) return "it has no certificate";
  if (auto why = check_.refutation(*query, record.expect, *record.certificate)) return why;
  Record again;
  again.expect = record.expect;
  measure(*query, again);
  const auto differs = [](const auto& given, const auto& right) { return given && given != right; };
  if (differs(record.margin, again.margin)) return "its margin is another one";
  if (differs(record.condition, again.condition)) return "its condition is another one";
  if (format > 1) {
    excuse(*query, again);
    if (differs(record.time_change, again.time_change)) return "its time_change is another one";
    if (!record.comment.empty() && again.comment != record.comment) return "its comment says something else";
    if (!std::ranges::equal(again.acceptable, record.acceptable, is_same) ||
        again.tags.empty() != !needs_judge(record))
      return "other answers are acceptable";
  }
  if (ask_walk) {
    const Answer walked = this->walked(*query);
    if (walked.outcome != Outcome::undecided && !same_answer(walked, record.expect))
      return "walk says otherwise";
  }
  return std::nullopt;
}

// ---- What is seen of a question

namespace {

constexpr double kFar = 1e6, kTiny = 1e-5, kNear = 0x1p-20;
constexpr int kSmall = 8;

double smallest_radius(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_atom(scene, [&](const Atom& atom) {
    if (atom.is_ball()) smallest = std::min(smallest, atom.radius);
  });
  return smallest;
}

// True if v is along a small vector of a lattice, or nearly.
bool is_near_rational(const Scene& scene, const Vec& v) {
  for (const Lattice& lattice : scene.lattices) {
    const int rank = lattice.rank_in(scene.dimension);
    std::array<int, 3> most{};
    std::fill_n(most.begin(), rank, kSmall);
    for (int i = -most[0]; i <= most[0]; ++i)
      for (int j = -most[1]; j <= most[1]; ++j)
        for (int k = -most[2]; k <= most[2]; ++k) {
          Vec sum{};
          const std::array<int, 3> n{i, j, k};
          for (int m = 0; m < rank; ++m) sum = plus(sum, n[m], lattice.vectors[m]);
          const double sine = length(cross(sum, v)) / length(sum) / length(v);  // NaN for a zero vector
          if (sine < kNear) return true;
        }
  }
  return false;
}

// The distance to a hit along direction 2^exponent; the time may be out of range for binary64.
long double flown(const Answer& exact, const Vec& direction, int exponent) {
  if (exact.outcome != Outcome::hit) return 0;
  return std::scalbn(std::strtold(exact.time_decimal.c_str(), nullptr) * length(direction), exponent);
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& seen_tags() {
  static const std::vector<std::pair<std::string, std::string>> tags{
      {"grazing", "the line enters or misses an obstacle by less than 2^20 ulps of the inputs"},
      {"tie", "two obstacles are entered at times that 2^20 ulps of the inputs could swap"},
      {"boundary-start", "the start is within 2^20 ulps of an obstacle's surface"},
      {"near-rational", "the direction is within 2^-20 of a lattice vector with components up to 8"},
      {"zero-component", "a component of v is zero"},
      {"leaving", "`from` names an obstacle, which is ignored"},
      {"far", "the flight is longer than 10^6 times the shortest lattice vector"},
      {"tiny-radius", "a radius is below 10^-5 of the shortest lattice vector"},
      {"invalid", "no valid question: the answer is `error`"},
      {"plain", "none of the others"}};
  return tags;
}

std::vector<std::string> tags_seen(const Scene& scene, const Query& query, const Answer& exact,
                                   const std::optional<oracle::HardestDecision>& decision) {
  const auto is = [&](oracle::DecisionKind kind) { return is_hard(decision) && decision->kind == kind; };
  const double unit = shortest_vector(scene);
  const int exponent = std::ilogb(largest_component(query.v));
  const Vec direction = times_power_of_two(query.v, -exponent);  // its largest component is from 1 to 2
  const bool has_zero = std::any_of(query.v.begin(), query.v.begin() + scene.dimension,
                                    [](double component) { return component == 0; });
  const std::pair<const char*, bool> all[] = {
      {"grazing", is(oracle::DecisionKind::meeting)},
      {"tie", is(oracle::DecisionKind::order)},
      {"boundary-start", is(oracle::DecisionKind::containing)},
      {"near-rational", is_near_rational(scene, direction)},
      {"zero-component", has_zero},
      {"leaving", query.from.has_value()},
      {"far", flown(exact, direction, exponent) > kFar * unit},
      {"tiny-radius", std::isfinite(unit) && smallest_radius(scene) < kTiny * unit}};
  std::vector<std::string> tags;
  for (const auto& [tag, holds] : all)
    if (holds) tags.emplace_back(tag);
  if (tags.empty()) tags.emplace_back("plain");
  return tags;
}

}  // namespace lorentz::golden
