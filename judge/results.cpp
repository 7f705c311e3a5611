#include "judge/results.hpp"

#include <algorithm>
#include <cmath>

#include "src/problem/same_answer.hpp"

namespace lorentz::judge {
namespace {

// Number of questions of each row that are examined closely: the features of right answers, and how close the
// calls were.
constexpr std::size_t kCompared = 500;

bool is_binary32(double a) {
  return rounded(a, NumberFormat::binary32) == a;
}

}  // namespace

void set_speed(ExaminedRow& row) {
  if (row.tally.queries > 0)
    row.tally.speed.ns_per_query = 1e9 * row.seconds / static_cast<double>(row.tally.queries);
}

ExaminedRow& Results::row(const ExaminedRow& like) {
  const auto place = std::ranges::find(rows, like.name, &ExaminedRow::name);
  if (place != rows.end()) return *place;
  rows.push_back(like);
  rows.back().tally.name = like.name;
  return rows.back();
}

void Results::take(const Judged& judged, const std::optional<Example>& example, bool is_slowness,
                   ExaminedRow& row) {
  const auto& [question, reply, judgement] = judged;
  if (is_slowness)
    ++row.tally.counts[Count::too_slow];
  else if (example && example->diagnosis.severity == Severity::nonsense)
    ++row.tally.counts[Count::nonsense];
  else
    row.count(judged);
  if (example) findings.add(*example, row.name);
  const auto& given = reply.answer.time;
  if (reply.answer.outcome == Outcome::hit && given && std::isfinite(*given) && question.exact.time &&
      !is_binary32(*question.exact.time)) {
    ++times;
    times_in_binary32 += is_binary32(*given);
  }
  const auto off = judgement.ulps ? question::radii_off(question, reply.answer) : std::nullopt;
  if (off) row.max_radii = std::max(row.max_radii.value_or(0), *off);
  if (!question.is_query() || is_slowness || row.tally.queries > kCompared) return;
  const Features features = features_of(
      question, names_obstacle(question.exact) ? std::optional(question.exact.obstacle) : std::nullopt);
  if (judgement.verdict == oracle::Verdict::agree) findings.add_right(features, !judgement.wrong_time);
  const bool is_about_another = example && !judgement.wrong_time && example->diagnosis.by_radii;
  const double call = is_about_another ? *example->diagnosis.by_radii : features.depth;
  const double sizes[kMeasures.size()] = {call, features.distance, features.flight, features.start,
                                          features.radius};
  for (std::size_t i = 0; i < curves.size(); ++i) curves[i].add(sizes[i], judgement.verdict, off);
}

void Results::add(const Results& other) {
  for (const ExaminedRow& more : other.rows) {
    ExaminedRow& its = row({.name = more.name, .explanation = more.explanation, .is_hard = more.is_hard});
    its.add(more);
    set_speed(its);
  }
  findings.add(other.findings);
  for (std::size_t i = 0; i < curves.size(); ++i) curves[i].add(other.curves[i]);
  failed |= other.failed;
  times += other.times, times_in_binary32 += other.times_in_binary32;
}

}  // namespace lorentz::judge
