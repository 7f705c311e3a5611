#include "judge/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "fuzz/campaign/shrink.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::judge {
namespace {

// True if |v|, and all numbers of x, v and the scene that are not 0, are of the sizes of every day.
bool is_everyday(const Question& question) {
  constexpr double kLeast = 1e-6, kMost = 1e6;
  bool all = true;
  const auto see = [&](double a) { all &= a == 0 || (kLeast <= std::fabs(a) && std::fabs(a) <= kMost); };
  const auto see_each = [&](const Vec& a) { std::ranges::for_each(a, see); };
  see_each(question.query.x), see_each(question.query.v);
  for (const Lattice& lattice : question.place->scene().lattices)
    for (const Vec& vector : lattice.vectors) see_each(vector);
  for_each_atom(question.place->scene(), [&](const Atom& atom) {
    see(atom.radius), see_each(atom.position);
    for (const Vec& axis : atom.semiaxes) see_each(axis);
  });
  return all;
}

// Valid questions come before invalid ones, and numbers of every day before others. Invalid questions have no
// numbers, so the shortest text is the simplest.
std::tuple<bool, bool, long> complexity_of(const Question& question) {
  if (!question.is_query()) return {true, false, static_cast<long>(question.text.size())};
  return {false, !is_everyday(question), fuzz::complexity(question.place->scene(), question.query)};
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

std::string number_of(std::size_t number, std::size_t all) {
  return number == all ? fmt::format("all {}", all) : fmt::format("{} of {}", number, all);
}

std::vector<Features> features_of_all(const std::vector<Example>& examples) {
  std::vector<Features> all;
  for (const Example& example : examples)
    if (example.question.is_query()) all.push_back(example.features);
  return all;
}

using Belongs = std::function<bool(const Example&)>;

// The answers of a finding that belong together. Only the first of each row are known; the others are shared out
// in proportion.
Finding part_of(const Finding& whole, const Belongs& belongs) {
  Finding part = whole;
  part.is_part = true;
  std::erase_if(part.examples, [&](const Example& example) { return !belongs(example); });
  std::map<std::string, std::size_t> known, its;
  for (const Example& example : whole.examples) ++known[example.row];
  for (const Example& example : part.examples) ++its[example.row];
  part.by_row.clear(), part.count = 0;
  for (const auto& [row, number] : its) {
    part.by_row[row] = number * whole.by_row.at(row) / known[row];
    part.count += part.by_row[row];
  }
  if (whole.count > whole.examples.size()) return part;  // the largest may be of an answer that is not known
  part.by_radii.reset();
  for (const Example& example : part.examples)
    if (const auto radii = example.diagnosis.by_radii)
      part.by_radii = std::max(part.by_radii.value_or(0), *radii);
  return part;
}

// The two parts of a finding.
std::pair<Finding, Finding> parts_of(const Finding& whole, const Belongs& belongs) {
  std::pair parts{part_of(whole, belongs), part_of(whole, std::not_fn(belongs))};
  auto& [first, second] = parts;
  for (const auto& [row, number] : whole.by_row) {  // what was rounded down
    const std::size_t left = number - first.by_row[row];
    second.count += left - second.by_row[row];
    second.by_row[row] = left;
  }
  for (Finding* part : {&first, &second})
    std::erase_if(part->by_row, [](const auto& its) { return its.second == 0; });
  return parts;
}

// ---- Quantities

// Sets what nearly all give in place of the time; or takes those apart that give it, if they are a clear
// part.
std::optional<std::pair<Finding, Finding>> split_by_quantity(Finding& finding) {
  constexpr std::size_t kFewest = 3;
  for (const std::string_view quantity : {kDistance, kExit, kNearest, kFraction}) {
    const Belongs gives = [=](const Example& example) { return example.diagnosis.quantity == quantity; };
    const auto number = static_cast<std::size_t>(std::ranges::count_if(finding.examples, gives));
    const double part = static_cast<double>(number) / static_cast<double>(finding.examples.size());
    if (number < kFewest || part < kClearPart) continue;
    if (part < kNearlyAll) {
      auto parts = parts_of(finding, gives);
      parts.first.quantity = quantity, parts.first.of_quantity = number;
      return parts;
    }
    finding.quantity = quantity, finding.of_quantity = number;
    return std::nullopt;
  }
  return std::nullopt;
}

// ---- Circumstances

// The circumstance that sets a clear part of a finding apart: none of nearly all questions does better, or what is
// left has one without exception. The part must be no accident of a few.
std::optional<Circumstance> clear_part(const std::vector<Features>& failing,
                                       const std::vector<Features>& right,
                                       const std::optional<Circumstance>& of_all) {
  constexpr double kClearlyBetter = 1.5;
  constexpr std::size_t kFewest = 4;
  const auto part = circumstance_of(failing, right, kClearPart, kNearlyAll);
  if (!part || part->number < kFewest) return std::nullopt;
  if (!of_all || part->weight >= kClearlyBetter * of_all->weight) return part;
  if (of_all->part() == 1) return std::nullopt;
  std::vector<Features> left = failing;
  std::erase_if(left, [&](const Features& f) { return part->can_hold(f) && part->holds(f); });
  const auto of_left = circumstance_of(left, right);
  return of_left && of_left->part() == 1 ? part : std::nullopt;
}

// Adds the finding with its circumstance; as several, if circumstances set clear parts apart, up to `most`.
void add_parts(Finding finding, const std::vector<Features>& right, int most, std::vector<Finding>& all) {
  if (auto parts = finding.quantity.empty() ? split_by_quantity(finding) : std::nullopt) {
    add_parts(std::move(parts->first), right, 1, all);
    return add_parts(std::move(parts->second), right, most - 1, all);
  }
  const std::vector<Features> failing = features_of_all(finding.examples);
  auto of_all = circumstance_of(failing, right);
  if (of_all && of_all->is_of_scene && finding.by_row.size() == 1) of_all.reset();
  const auto part = most > 1 && finding.quantity.empty() ? clear_part(failing, right, of_all) : std::nullopt;
  if (!part) {
    finding.circumstance = of_all;
    all.push_back(std::move(finding));
    return;
  }
  auto parts = parts_of(finding, [&](const Example& example) {
    return example.question.is_query() && part->can_hold(example.features) && part->holds(example.features);
  });
  parts.first.circumstance = part;
  all.push_back(std::move(parts.first));
  add_parts(std::move(parts.second), right, most - 1, all);
}

// Sets the simplest example that the sentence is true of.
void choose_simplest(Finding& finding) {
  const Example* simplest = nullptr;
  for (const Example& example : finding.examples)
    if (finding.is_about(example) &&
        (!simplest || complexity_of(example.question) < complexity_of(simplest->question)))
      simplest = &example;
  if (simplest) finding.simplest = *simplest;
  finding.where = finding.simplest.question.where;
}

}  // namespace

std::optional<ObstacleId> obstacle_in_question(const Example& example) {
  if (!example.question.is_query()) return std::nullopt;
  if (example.judgement.obstacle) return example.judgement.obstacle;
  for (const Answer* answer : {&example.question.exact, &example.given})
    if (names_obstacle(*answer, example.question.query, example.question.place->scene()))
      return answer->obstacle;
  return std::nullopt;
}

Features features_in(const Example& example) {
  return features_of(example.question, obstacle_in_question(example));
}

bool Finding::is_about(const Example& example) const {
  return (quantity.empty() || example.diagnosis.quantity == quantity) &&
         (!circumstance || (example.question.is_query() && circumstance->can_hold(example.features) &&
                            circumstance->holds(example.features)));
}

std::string Finding::summary() const {
  const std::string text =
      quantity.empty()
          ? sentence_of(cause(), by_radii)
          : fmt::format("names the right obstacle, with {} in place of the time of the entry", quantity);
  // The sentences of some causes say this already.
  const std::string_view name = circumstance ? circumstance->name : "";
  const bool is_grazing = cause() == Cause::passed_over_grazing || cause() == Cause::never_for_grazing,
             is_said = (is_grazing && name == "depth") || (cause() == Cause::leaving && name == "from");
  if (!circumstance || is_said) return is_part ? text + ", in other cases" : text;
  const char* how = circumstance->part() == 1 ? "only" : is_part ? "in part" : "nearly always";
  return fmt::format("{}, {} {}", text, how, circumstance->text);
}

std::string Finding::explanation() const {
  std::vector<std::string> numbers;
  if (!quantity.empty()) numbers.push_back(number_of(of_quantity, examples.size()) + " times");
  if (circumstance) {
    numbers.push_back(number_of(circumstance->number, circumstance->of) + ", and " +
                      share_text(circumstance->share));
  }
  return numbers.empty() ? summary() : fmt::format("{} ({})", summary(), fmt::join(numbers, "; "));
}

void Findings::add(Example example, const std::string& row) {
  const auto key = std::make_pair(example.diagnosis.severity, example.diagnosis.cause);
  Finding one{example, example.question.where, 1, {}, {{row, 1}}};
  if (example.diagnosis.by_radii) one.by_radii = std::max(0.0, *example.diagnosis.by_radii);
  const auto before = findings_.find(key);
  const bool has_enough = before != findings_.end() && before->second.by_row[row] >= Finding::kKept;
  if (!has_enough) {
    example.row = row;
    if (example.question.is_query()) example.features = features_in(example);
    one.examples.push_back(std::move(example));
  }
  add(key, one);
}

void Findings::add(const Findings& others) {
  right_.insert(right_.end(), others.right_.begin(), others.right_.end());
  mistimed_.insert(mistimed_.end(), others.mistimed_.begin(), others.mistimed_.end());
  for (const auto& [key, other] : others.findings_) add(key, other);
}

void Findings::add(const std::pair<Severity, Cause>& key, const Finding& other) {
  const auto [place, is_new] = findings_.try_emplace(key, other);
  if (is_new) return;
  Finding& its = place->second;
  its.count += other.count;
  for (const auto& [row, count] : other.by_row) its.by_row[row] += count;
  if (other.by_radii) its.by_radii = std::max(its.by_radii.value_or(0), *other.by_radii);
  its.examples.insert(its.examples.end(), other.examples.begin(), other.examples.end());
}

std::vector<Finding> Findings::all(const std::deque<question::ExaminedRow>& rows) const {
  std::vector<Finding> all;
  constexpr int kMostParts = 3;
  constexpr std::size_t kFewTimes = 20;
  // An engine whose times are wrong has few right answers. If they tell nothing, all right obstacles may.
  std::vector<Features> right_obstacles = right_;
  right_obstacles.insert(right_obstacles.end(), mistimed_.begin(), mistimed_.end());
  for (const auto& [key, finding] : findings_) {
    const std::size_t before = all.size();
    add_parts(finding, right_, kMostParts, all);
    if (key.first == Severity::wrong_time || all.size() > before + 1 || all.back().circumstance) continue;
    all.pop_back();
    add_parts(finding, right_obstacles, kMostParts, all);
  }
  for (Finding& finding : all) {
    choose_simplest(finding);
    finding.share_of_plain = share_of(finding.by_row, rows, false);
    finding.share_of_hard = share_of(finding.by_row, rows, true);
  }
  std::map<Blame, std::size_t> largest;
  for (const Finding& finding : all) {
    std::size_t& count = largest[finding.simplest.diagnosis.blame()];
    count = std::max(count, finding.count);
  }
  const auto rank = [&](const Finding& finding) {
    const Blame blame = finding.simplest.diagnosis.blame();
    const bool is_rare = kFewTimes * finding.count < largest[blame];
    return std::make_tuple(blame, is_rare, finding.severity(),
                           -finding.share_of_plain - finding.share_of_hard);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  return all;
}

}  // namespace lorentz::judge
