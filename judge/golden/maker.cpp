#include "judge/golden/maker.hpp"

#include <algorithm>
#include <stdexcept>

#include "judge/golden/seen.hpp"
#include "src/problem/same_answer.hpp"

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

bool is_one_obstacle(const Scene& scene) {
  return scene.lattices.size() == 1 && scene.lattices[0].atoms.size() == 1 &&
         scene.lattices[0].rank(scene.dimension) == 0;
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
  oracle::Request request;
  request.digits = kDigits;
  request.detail = is_one_obstacle(scene_);
  Proved proved{oracle_.first_hit(query, request), {}};
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

}  // namespace lorentz::golden
