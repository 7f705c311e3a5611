#include "golden/maker.hpp"
#include "src/exchange/json_writer.hpp"

#include <algorithm>
#include <stdexcept>

#include <lorentz/certificate_check.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/verdict.hpp>
#include <lorentz/walk.hpp>
#include "golden/seen.hpp"
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

struct Maker::Impl {
  Scene scene;
  std::string scene_line;
  NumberFormat precision;
  oracle::Oracle oracle;
  oracle::Walk walk;
  oracle::Margins margins;
  oracle::Judge judge;
  oracle::Prover prover;
  oracle::CertificateCheck check;

  Others others;

  Impl(const Scene& scene, std::string line, Others those, NumberFormat its_precision)
      : scene(scene),
        scene_line(std::move(line)),
        precision(its_precision),
        oracle(scene),
        walk(scene, kWalkCells),
        margins(scene, its_precision),
        judge(scene, {its_precision, {}}),
        prover(scene),
        check(scene),
        others(std::move(those)) {}

  Answer walked(const Query& query) const { return others.walk ? others.walk(query) : walk.first_hit(query); }
  oracle::Certificate proof(const Query& query, const Answer& answer) const {
    return others.prove ? others.prove(query, answer) : prover.prove(query, answer);
  }

  // Returns the hardest decision.
  std::optional<oracle::HardestDecision> measure(const Query& query, Record& record) const {
    const auto decision = margins.hardest_decision(query, record.expect);
    if (decision) record.margin = decision->margin;
    record.comment = comment_on(decision, scene);
    if (record.expect.outcome != Outcome::hit) return decision;
    record.condition = margins.condition(query, record.expect);
    record.time_change = margins.time_change(query, record.expect);
    return decision;
  }

  // Adds the other acceptable answers, or the tag that says that a judge is needed.
  void excuse(const Query& query, Record& record) const {
    if (auto excused = judge.excused(query, record.expect, kExcusedUlps, kMostAcceptable))
      record.acceptable = std::move(*excused);
    else
      record.tags.emplace_back(kNeedsJudge);
  }
};

Maker::Maker(const Scene& scene, Others others, NumberFormat precision)
    : Maker(scene, scene_line_of(scene), std::move(others), precision) {}
Maker::Maker(const Scene& scene, std::string scene_line, Others others, NumberFormat precision)
    : impl_(std::make_unique<const Impl>(scene, std::move(scene_line), std::move(others), precision)) {}
Maker::Maker(Maker&&) noexcept = default;
Maker::~Maker() = default;

const std::string& Maker::scene_line() const {
  return impl_->scene_line;
}

Proved Maker::prove(const Query& query) const {
  oracle::Request request;
  request.digits = kDigits;
  Proved proved{impl_->oracle.first_hit(query, request), {}};
  proved.certificate = impl_->proof(query, proved.exact);
  bool too_long = false;
  const auto why = impl_->check.refutation(query, proved.exact, proved.certificate, &too_long);
  if (too_long)
    throw ProofTooLong("no checker goes through the proof, which " + *why + ":\n" + asked_of(query));
  if (why)
    throw std::logic_error("the check of the certificate (" + *why + ") does not agree with the oracle:\n" +
                           asked_of(query));
  return proved;
}

std::string Maker::asked_of(const Query& query) const {
  return impl_->scene_line + "\n{" + question_of(query, impl_->scene) + "}";
}

MadeRecord Maker::make(std::string question, const std::optional<Query>& query) const {
  MadeRecord made;
  Record& record = made.record;
  record.id = id_of(impl_->scene_line, question);
  record.question = std::move(question);
  if (!query) {
    record.expect = Answer::error("no query");
    return made;
  }
  Proved proved = prove(*query);
  record.expect = std::move(proved.exact);
  record.certificate = std::move(proved.certificate);
  const Answer walked = impl_->walked(*query);
  made.walked = walked.outcome != Outcome::undecided;
  if (made.walked && !same_answer(walked, record.expect))
    throw std::logic_error("walk does not agree with the oracle:\n" + asked_of(*query));
  made.hardest = impl_->measure(*query, record);
  impl_->excuse(*query, record);
  return made;
}

std::optional<std::string> Maker::flaw_of(const Record& record, const std::optional<Query>& query,
                                          bool ask_walk, int format) const {
  if (record.id != id_of(impl_->scene_line, record.question))
    return "the id does not belong to the question (it is made from the scene's line and the question as "
           "they are "
           "written: blanks and digits count)";
  if (auto why = flaw_of_form(record)) return why;
  if (!query || record.expect.outcome == Outcome::error) {
    if (!query && record.expect.outcome == Outcome::error) return std::nullopt;
    return query ? "this is a query; `error` does not answer it"
                 : "this is not a query; its only answer is `error`";
  }
  if (!consists_of(impl_->scene, impl_->precision) || !consists_of(*query, impl_->precision))
    return std::string("its numbers are not of ") + name_of(impl_->precision);
  if (!record.certificate) return "it has no certificate";
  if (auto why = impl_->check.refutation(*query, record.expect, *record.certificate)) return why;
  Record again;
  again.expect = record.expect;
  impl_->measure(*query, again);
  if (again.margin != record.margin) return "its margin is another one";
  if (again.condition != record.condition) return "its condition is another one";
  if (format > 1) {
    impl_->excuse(*query, again);
    if (again.time_change != record.time_change) return "its time_change is another one";
    if (again.comment != record.comment) return "its comment says something else";
    if (!std::ranges::equal(again.acceptable, record.acceptable, is_same) ||
        again.tags.empty() != !needs_judge(record))
      return "other answers are acceptable";
  }
  if (ask_walk) {
    const Answer walked = impl_->walked(*query);
    if (walked.outcome != Outcome::undecided && !same_answer(walked, record.expect))
      return "walk says otherwise";
  }
  return std::nullopt;
}

}  // namespace lorentz::golden
