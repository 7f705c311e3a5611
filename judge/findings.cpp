#include "judge/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "fuzz/campaign/shrink.hpp"

namespace lorentz::judge {
namespace {

constexpr std::size_t kMostFeatures = 2000;

// Valid questions come before invalid ones. These have no numbers, so the shortest text is the simplest.
std::pair<bool, long> complexity_of(const Question& question) {
  if (!question.is_query()) return {true, static_cast<long>(question.text.size())};
  return {false, fuzz::complexity(question.place->scene(), question.query)};
}

// The share among all questions that were asked in the hard rows, or in the others.
double share_of(const std::map<std::string, std::size_t>& by_row,
                const std::deque<question::ExaminedRow>& rows, bool hard) {
  double all = 0, its = 0;
  for (const question::ExaminedRow& row : rows) {
    if (row.is_hard != hard) continue;
    all += static_cast<double>(row.asked() - row.tally[question::Count::unsupported]);
    if (const auto place = by_row.find(row.name); place != by_row.end())
      its += static_cast<double>(place->second);
  }
  return all > 0 ? its / all : 0;
}

std::string share_text(double share) {
  return share == 0 ? "none of the right answers" : fmt::format("{:.2g} % of the right answers", 100 * share);
}

}  // namespace

std::optional<ObstacleId> obstacle_in_question(const Example& example) {
  if (!example.question.is_query()) return std::nullopt;
  if (example.judgement.obstacle) return example.judgement.obstacle;
  const Query& query = example.question.query;
  for (const Answer* answer : {&example.question.exact, &example.given})
    if (names_obstacle(*answer) &&
        !flaw_of(Query{query.x, query.v, answer->obstacle}, example.question.place->scene()))
      return answer->obstacle;
  return std::nullopt;
}

Features features_in(const Example& example) {
  return features_of(example.question, obstacle_in_question(example));
}

std::string Finding::summary() const {
  const std::string text = sentence_of(cause(), by_radii);
  // The sentence of a grazing cause says this already.
  const bool is_said = (cause() == Cause::passed_over_grazing || cause() == Cause::never_for_grazing) &&
                       circumstance && circumstance->is_of_depth;
  return circumstance && !is_said ? text + ", only " + circumstance->text : text;
}

std::string Finding::explanation() const {
  return circumstance ? fmt::format("{} (all {}, and {})", summary(), count, share_text(circumstance->share))
                      : summary();
}

void Findings::add(const Example& example, const std::string& row) {
  const auto key = std::make_pair(example.diagnosis.severity, example.diagnosis.cause);
  Finding one{example, example.question.where, 1, {}, {{row, 1}}};
  if (example.diagnosis.by_radii) one.by_radii = std::max(0.0, *example.diagnosis.by_radii);
  const auto before = findings_.find(key);
  const bool has_enough = before != findings_.end() && before->second.features.size() >= kMostFeatures;
  if (example.question.is_query() && !has_enough) one.features.push_back(features_in(example));
  add(key, one);
}

void Findings::add(const Findings& others) {
  right_.insert(right_.end(), others.right_.begin(), others.right_.end());
  for (const auto& [key, other] : others.findings_) add(key, other);
}

void Findings::add(const std::pair<Severity, Cause>& key, const Finding& other) {
  const auto [place, is_new] = findings_.try_emplace(key, other);
  if (is_new) return;
  Finding& its = place->second;
  its.count += other.count;
  for (const auto& [row, count] : other.by_row) its.by_row[row] += count;
  if (other.by_radii) its.by_radii = std::max(its.by_radii.value_or(0), *other.by_radii);
  its.features.insert(its.features.end(), other.features.begin(), other.features.end());
  if (complexity_of(other.simplest.question) >= complexity_of(its.simplest.question)) return;
  its.simplest = other.simplest;
  its.where = other.where;
}

std::vector<Finding> Findings::all(const std::deque<question::ExaminedRow>& rows) const {
  std::vector<Finding> all;
  for (const auto& [key, finding] : findings_) {
    all.push_back(finding);
    all.back().share_of_plain = share_of(finding.by_row, rows, false);
    all.back().share_of_hard = share_of(finding.by_row, rows, true);
    all.back().circumstance = circumstance_of(finding.features, right_);
  }
  const auto rank = [](const Finding& finding) {
    return std::make_tuple(finding.simplest.diagnosis.blame(), finding.severity(), -finding.share_of_plain,
                           -finding.share_of_hard);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  return all;
}

}  // namespace lorentz::judge
