// The report of a campaign as text and as JSON.
#include <algorithm>
#include <cmath>
#include <map>

#include <lorentz/exchange.hpp>
#include "cli/fuzz.hpp"
#include "question/engines.hpp"
#include "report/claim_words.hpp"
#include "report/files/messages.hpp"
#include "report/reason.hpp"
#include "report/share.hpp"
#include "report/table.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Kind;
using fuzz::TargetTally;

// The number of cases, without variants, that the engine answered. Rates refer to these cases.
std::uint64_t answered(const TargetTally& tally) {
  const std::uint64_t unsupported = tally.counts[Kind::unsupported];
  return tally.cases > unsupported ? tally.cases - unsupported : 0;
}

// Which stages of the engine decided, over cases and variants; empty if the engine does not report stages.
std::string layers(const FuzzReport& report) {
  TargetTally all;
  for (const TargetTally& tally : report.tallies) all.add(tally);
  const std::uint64_t sum = all.stages[0] + all.stages[1] + all.stages[2];
  if (sum == 0) return {};
  const auto share = [&](std::size_t stage) {
    return fmt::format("{} ({:.3g} %)", all.stages[stage],
                       100 * static_cast<double>(all.stages[stage]) / static_cast<double>(sum));
  };
  const question::EngineInfo* engine = question::own_engine(report.manifest.engine);
  return fmt::format("decided in binary64: {}; in double-double: {}; {}: {}\n", share(0), share(1),
                     engine && engine->traits.is_exact ? "by exact arithmetic" : "not decided", share(2));
}

// The bound on the share of wrong answers that follows if no answer was wrong.
std::string bounds(const FuzzReport& report) {
  std::uint64_t n = 0;
  for (const TargetTally& tally : report.tallies) n += answered(tally);
  if (n == 0) return "no case was answered\n";
  if (report.total(Kind::wrong) > 0) return {};
  return fmt::format(
      "wrong: 0 in {}: at most {:.2g} of such cases, with 95 %; variants and other words not counted\n", n,
      report::bound_of_none(n));
}

void add_target(json::Members& object, const std::string& name, const TargetTally& tally) {
  object.add("target", name, "next", tally.next, "cases", tally.cases, "variants", tally.variants,
             "outside_domain", tally.outside, "reworded", tally.reworded);
  question::add_counts(object, tally.counts, question::Counted::campaigns);
  const std::uint64_t n = answered(tally);
  const bool none = tally.counts[Kind::wrong] == 0 && n > 0;
  object.add("binary64", tally.stages[0], "double_double", tally.stages[1], "exact", tally.stages[2],
             "smallest_margin", json::finite(tally.margin), "wrong_at_most",
             none ? std::optional(report::bound_of_none(n)) : std::nullopt);
}

// By how much the obstacle in question is hit or missed, if two answers differ.
std::string reason_in(const fuzz::CaseText& text, const Claim& claim) {
  const fuzz::ReadCase one = fuzz::case_in(text);
  const auto says_what = [](const Answer& answer) {
    return names_obstacle(answer) || answer.outcome == Outcome::never;
  };
  if (!says_what(one.given) || !says_what(one.exact)) return "";
  std::string reason;
  for (const std::string& line :
       report::reason_of(oracle::Margins(one.scene, claim.precision), one.scene, one.query, one.exact,
                         one.given, report::decisive_of(one.scene, one.query, one.exact, one.given, claim)))
    reason += line + '\n';
  return reason;
}

}  // namespace

FuzzReport report_of(const fuzz::Store& store, const fuzz::Campaign& campaign) {
  FuzzReport report;
  report.manifest = campaign.manifest;
  report.campaign = campaign.id;
  for (const std::string& target : campaign.manifest.targets)
    report.tallies.push_back(store.tally(campaign.id, target));
  for (fuzz::Stored& one : store.findings())
    if (one.campaign == campaign.id) report.findings.push_back(std::move(one));
  return report;
}

std::uint64_t FuzzReport::total(Kind kind) const {
  std::uint64_t sum = 0;
  for (const TargetTally& tally : tallies) sum += tally.counts[kind];
  return sum;
}

std::string FuzzReport::target_table() const {
  constexpr auto kBy = question::Counted::campaigns;
  report::Table table(
      question::titles_counted(kBy, {"target", "cases", "variants", "reworded"}, {"smallest margin"}));
  TargetTally all;
  const auto add = [&](const std::string& name, const TargetTally& tally) {
    table.add(question::cells_counted(
        tally.counts, kBy,
        {name, std::to_string(tally.cases), std::to_string(tally.variants), std::to_string(tally.reworded)},
        {std::isfinite(tally.margin) ? fmt::format("{:.2g}", tally.margin) : "-"},
        [](Kind, std::size_t number) { return std::to_string(number); }));
  };
  for (std::size_t t = 0; t < tallies.size(); ++t) {
    add(manifest.targets[t], tallies[t]);
    all.add(tallies[t]);
  }
  if (tallies.size() > 1) add("all", all);
  return table.text();
}

std::string FuzzReport::text() const {
  std::string out = fmt::format(
      "{}, seed {}: cases, and variants of some, judged by the oracle{}\n\n{}\n{}{}", manifest.engine,
      manifest.seed, report::words_of(manifest.claim), target_table(), layers(*this), bounds(*this));
  if (findings.empty()) return out + "no findings\n";
  out += table_of(causes_of(findings));
  if (is_stored) return out;
  out += "\nthe simplest finding of each cause (--store FILE keeps all):\n";
  for (const FindingCause& cause : causes_of(findings))
    out += fmt::format("\n{}: {}\n{}", cause.simplest->label(), cause.name,
                       text_of(cause.simplest->finding.shrunk, manifest.claim));
  return out;
}

void FuzzReport::add_targets(json::Members& object) const {
  object.add("version", manifest.version, "engine", manifest.engine, "seed", manifest.seed, "options",
             manifest.options);
  report::add_claim(object, manifest.claim);
  object.add("targets", json::objects(tallies, [&](json::Members& one, const TargetTally& tally) {
               add_target(one, manifest.targets[static_cast<std::size_t>(&tally - tallies.data())], tally);
             }));
}

std::string FuzzReport::json() const {
  const auto cause = [](json::Members& one, const FindingCause& its) {
    one.add("cause", its.name, "findings", its.findings, "simplest", its.simplest->label(), "bits",
            its.simplest->finding.bits);
  };
  return json::line_of([&](json::Members& object) {
    add_targets(object);
    object.add("causes", json::objects(causes_of(findings), cause), "findings",
               json::objects(findings, add_finding));
  });
}

std::vector<FindingCause> causes_of(const std::vector<fuzz::Stored>& findings) {
  std::map<std::string, FindingCause> causes;
  for (const fuzz::Stored& one : findings) {
    FindingCause& cause = causes[one.finding.cause];
    cause.name = one.finding.cause;
    ++cause.findings;
    if (std::find(cause.targets.begin(), cause.targets.end(), one.finding.target) == cause.targets.end())
      cause.targets.push_back(one.finding.target);
    if (!cause.simplest || one.finding.complexity < cause.simplest->finding.complexity) cause.simplest = &one;
  }
  std::vector<FindingCause> all;
  for (auto& [name, cause] : causes) all.push_back(std::move(cause));
  std::stable_sort(all.begin(), all.end(), [](const FindingCause& a, const FindingCause& b) {
    return fuzz::rank_of(a.simplest->finding.kind) < fuzz::rank_of(b.simplest->finding.kind);
  });
  return all;
}

std::string table_of(const std::vector<FindingCause>& causes) {
  report::Table table({"simplest finding", "bits", "kept", "targets", "cause"});
  table.with_prose();
  for (const FindingCause& cause : causes)
    table.add({cause.simplest->label(), std::to_string(cause.simplest->finding.bits),
               std::to_string(cause.findings), std::to_string(cause.targets.size()), cause.name});
  return table.text();
}

std::string text_of(const fuzz::CaseText& text, const Claim& claim) {
  std::string out =
      fmt::format("{}\n{}\nsays  {}\ntruth {}\n", text.scene, text.query, text.given, text.exact);
  if (std::isinf(text.departs))
    out += "no error in the inputs explains it\n";
  else if (text.departs > 0)
    out += fmt::format("departs by {:.3g} ulps at least\n", text.departs);
  if (text.margin) out += fmt::format("margin of the exact answer: {:.3g} ulps\n", *text.margin);
  return out + reason_in(text, claim);
}

void add_finding(json::Members& object, const fuzz::Stored& stored) {
  const fuzz::Finding& f = stored.finding;
  const auto lines = [](const fuzz::CaseText& text) {
    return [&text](json::Members& one) {
      one.add("scene_line", json::Raw{text.scene}, "query_line", json::Raw{text.query}, "given",
              json::Raw{text.given}, "exact", json::Raw{text.exact}, "departs", text.departs, "margin",
              text.margin);
    };
  };
  constexpr const char* kShrinking[] = {"due", "cut short", "done"};
  object.add("id", stored.label(), "words", f.words.empty() ? std::nullopt : std::optional(f.words), "kind",
             f.kind, "cause", f.cause, "shrinking", kShrinking[static_cast<int>(f.shrinking)], "bits", f.bits,
             "tries", f.tries, "case", lines(f.text), "shrunk", lines(f.shrunk));
}

}  // namespace lorentz::cli
