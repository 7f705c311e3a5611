// lorentz golden check: checks an engine with golden sets.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/verdict.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/compare_table.hpp"
#include "cli/help_texts.hpp"
#include "cli/known_failures.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/terminal.hpp"
#include "golden/find_sets.hpp"
#include "golden/questions.hpp"
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/tally.hpp"
#include "report/claim_words.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

struct CheckOptions {
  std::vector<std::string> engines, sets;
  std::optional<std::string> id;
  FailureFiles files;
  std::optional<double> ulps, timeout;
  std::optional<std::uint64_t> first;
  std::uint64_t failures = 10, jobs = 1;
  ClaimOptions claim;
  bool strict = false, times = false, json = false, markdown = false;
};

// One engine's tally for a set and for each of its tags.
struct SetTally {
  std::vector<std::pair<std::string, std::string>> notes;  // about the tags
  Claim claim;
  std::string label;            // the name; also the precision if the set has one and the name does not
  std::string claim_arguments;  // arguments that give this claim
  Tally all;
  std::map<std::string, Tally> by_tag;
  bool failed = false;               // the program failed
  std::size_t given_up_before = 0;   // records that were therefore not asked
  std::size_t of_other_numbers = 0;  // records not asked because their numbers are not the engine's

  std::size_t not_asked() const { return given_up_before + of_other_numbers; }
};

// The first records of a set, filtered by the beginning of the id. Those that do not consist of the engine's
// numbers are left out and counted.
Source records_of(const Source& records, const std::optional<std::string>& id, std::uint64_t first,
                  Progress& progress, std::size_t& of_other_numbers) {
  return [=, &progress, &of_other_numbers, read = std::uint64_t{0}]() mutable -> std::optional<Question> {
    while (read < first) {
      std::optional<Question> question = records();
      progress.at(++read);
      if (!question) break;
      if (id && !question->where.starts_with(*id)) continue;
      if (question->place->has_numbers_for(question->query)) return question;
      ++of_other_numbers;
    }
    return std::nullopt;
  };
}

std::string short_answer(const Answer& answer, const Components& count) {
  std::string text = json::text_of(json_of(answer, count));
  text = text.substr(1, text.size() - 2);
  constexpr std::size_t kLongest = 160;
  return shortened(text, kLongest);
}

// The margin in the record, or a computed one if the record's is in ulps of another precision.
std::optional<double> margin_of(const Question& question) {
  if (question.margin || !question.is_query()) return question.margin;
  const auto decision = question.place->margins().hardest_decision(question.query, question.exact);
  return decision ? std::optional(decision->margin) : std::nullopt;
}

// True if the time, of the right obstacle, is when the line leaves it: a thousand times nearer to that than to
// the entry. The line turned round meets its exit first.
bool is_exit(const Question& question, const Answer& given) {
  const Query& query = question.query;
  const Query turned{query.x, {-query.v[0], -query.v[1], -query.v[2]}, {}};
  const std::string time = question.place->margins().crossing(turned, question.exact.obstacle).time_decimal;
  const double exit = -std::strtod(time.c_str(), nullptr);
  return 1000 * std::fabs(*given.time - exit) < std::fabs(*given.time - *question.exact.time);
}

// A failure for people, with the command that asks again. `claim`: as arguments of that command.
std::string describe(const Judged& judged, const std::string& engine, const std::string& set,
                     const std::string& claim) {
  const auto& [question, reply, judgement] = judged;
  const Answer &expect = question.exact, &given = reply.answer;
  const Place& place = *question.place;
  const Components count(place.scene());
  const std::string tags = fmt::format("{}", fmt::join(question.tags, ", "));
  std::string text =
      fmt::format("  {} {} ({}): expected {}, got {}\n    ", printable(set), printable(question.where),
                  printable(tags), short_answer(expect, count), short_answer(given, count));
  if (const auto margin = margin_of(question))
    text += fmt::format("margin of the case: {:.4g} ulps; ", *margin);
  const bool is_wrong = judgement.verdict == oracle::Verdict::wrong;
  if (given.outcome == Outcome::hit && expect.outcome == Outcome::hit && given.obstacle == expect.obstacle)
    text += fmt::format("{}: off by {:.3g} times what an ulp in each input makes of the time\n",
                        is_exit(question, given) ? "the time of the exit from that obstacle, not of the entry"
                        : judgement.other_quantity ? "another quantity than the time of that collision"
                                                   : "a wrong time of the right obstacle",
                        judgement.departs);
  else if (std::isfinite(judgement.departs) && is_wrong)
    text += fmt::format("right only if the inputs moved by {:.4g} ulps\n", judgement.departs);
  else if (judgement.verdict == oracle::Verdict::error)
    text += "the question is a good one\n";
  else
    text += "no error in the inputs explains it\n";
  if (question.is_query() && is_wrong)
    text += report::reason_of(place.margins(), place.scene(), question.query, expect, given,
                              judgement.obstacle, "    ");
  return text + fmt::format("    again: lorentz golden check --engine {}{} --id {} {}\n",
                            shell_quoted(engine), claim, shell_quoted(question.where), shell_quoted(set));
}

// Asks an engine the questions of sets, and keeps the results.
class EngineCheck {
 public:
  EngineCheck(const EngineInfo& engine, const CheckOptions& options, const AnswererOptions& asking)
      : engine_(engine.name), options_(options), ledger_(options.files, options.files.baseline_text()) {
    for (std::uint64_t job = 0; job < (engine.is_own() ? options.jobs : 1); ++job)
      answerers_.push_back(engine.answerer(asking));
  }

  /// A program that was given up is tried again on the next set, unless it never answered anything.
  bool is_worth_asking() {
    answerers_[0]->try_again();
    return !answerers_[0]->is_hopeless();
  }

  SetTally run(const std::string& path) {
    golden::Reader reader(path);
    const golden::Header& header = reader.header();
    const std::uint64_t first = options_.first.value_or(std::numeric_limits<std::uint64_t>::max());
    const Claim claim = options_.claim.claim(header.precision);
    SetTally tally;
    tally.claim = claim;
    tally.claim_arguments = report::arguments_of(claim);
    if (claim.precision == NumberFormat::binary64 && header.precision != claim.precision)
      tally.claim_arguments += " --precision binary64";
    tally.all.name = tally.label = header.name;
    if (const std::string precision = name_of(claim.precision); !options_.claim.precision &&
                                                                claim.precision != NumberFormat::binary64 &&
                                                                !tally.label.ends_with(precision))
      tally.label += ", in " + precision;
    tally.notes = header.tags;
    Progress progress(engine_, header.count);
    const Source records =
        records_of(golden::questions_of(reader, claim), options_.id, first, progress, tally.of_other_numbers);
    const double ulps = options_.ulps.value_or(oracle::kDefaultUlps);
    for (std::vector<Question> part; !(part = some_of(records, kTogether)).empty();)
      examine(part, answerers_, ulps, [&](const Judged& judged) { take(judged, path, tally); });
    tally.failed = answerers_[0]->failed();
    if (!options_.id && first >= header.count && tally.not_asked() == 0) ledger_.end(tally.all.name);
    return tally;
  }

  void finish() {
    for (const auto& answerer : answerers_) answerer->finish();
    ledger_.finish(engine_);
  }
  const std::vector<std::string>& failures() const { return failures_; }  ///< the first ones
  std::size_t new_failures() const { return ledger_.new_failures(); }

 private:
  static constexpr std::size_t kTogether = 4096;

  void take(const Judged& judged, const std::string& set, SetTally& tally) {
    const auto& [question, reply, judgement] = judged;
    if (!reply.was_asked()) {
      ++tally.given_up_before;
      return;
    }
    tally.all.count(judgement);
    for (const std::string& tag : question.tags) tally.by_tag[tag].count(judgement);
    const bool is_new =
        ledger_.take(tally.all.name, question.where, failure_of(judgement, options_.times, options_.strict));
    const bool is_lenient =
        judgement.verdict == oracle::Verdict::ill_posed || judgement.verdict == oracle::Verdict::undecided;
    if (!is_new || is_lenient || options_.json || failures_.size() >= options_.failures) return;
    failures_.push_back(describe(judged, engine_, set, tally.claim_arguments));
  }

  const std::string engine_;
  const CheckOptions& options_;
  FailureLedger ledger_;
  std::vector<std::unique_ptr<Answerer>> answerers_;  // one per thread
  std::vector<std::string> failures_;
};

std::vector<std::string> cells_of(const std::string& set, const std::string& tag, const Tally& t) {
  return cells_counted(t.counts, Counted::examinations, {set, tag, std::to_string(t.queries)}, {},
                       dash_for_none);
}

void add_counts(json::Members& object, const Tally& t) {
  object.add("records", t.queries);
  question::add_counts(object, t.counts, Counted::examinations);
}

void add_set(json::Members& object, const SetTally& set) {
  object.add("set", set.all.name);
  add_counts(object, set.all);
  object.add("not_asked", set.not_asked(), "precision", name_of(set.claim.precision), "tags",
             [&](json::Members& tags) {
               for (const auto& [tag, tally] : set.by_tag)
                 tags.add_named(tag, [&](json::Members& counts) { add_counts(counts, tally); });
             });
}

// The claim by which all sets were judged; not added if the sets have several precisions.
void add_common_claim(json::Members& object, const Claim& claim, const std::vector<SetTally>& tallies) {
  const NumberFormat first = tallies.empty() ? claim.precision : tallies.front().claim.precision;
  if (std::ranges::all_of(tallies, [&](const SetTally& set) { return set.claim.precision == first; }))
    report::add_claim(object, {first, claim.time_tolerance});
  else
    object.add("precision", std::optional<double>(), "time_tolerance", claim.time_tolerance);
}

std::string json_of(const std::string& engine, const Claim& claim, const std::vector<SetTally>& tallies,
                    std::size_t not_asked) {
  return json::line_of([&](json::Members& object) {
    object.add("engine", engine, "sets", json::objects(tallies, add_set));
    add_common_claim(object, claim, tallies);
    std::size_t records = 0;
    for (const SetTally& set : tallies) records += set.not_asked();
    object.add("records_not_asked", records, "not_asked", not_asked);
  });
}

void show(const std::string& engine, const Claim& claim, const std::vector<SetTally>& tallies,
          const std::vector<std::string>& failures, std::size_t not_asked) {
  report::Table table(titles_counted(Counted::examinations, {"set", "tag", "records"}, {}));
  for (const SetTally& set : tallies) {
    table.add(cells_of(set.label, "all", set.all));
    for (const auto& [tag, tally] : set.by_tag) table.add(cells_of("", tag, tally));
  }
  if (not_asked > 0) table.add(cells_of(fmt::format("{} sets not asked", not_asked), "", {}));
  Tally total;
  std::size_t of_other_numbers = 0;
  for (const SetTally& set : tallies) {
    total.add(set.all);
    of_other_numbers += set.of_other_numbers;
  }
  table.add(cells_of("total", "", total));
  print(fmt::format("{}{}\n\n{}\n", engine, report::words_of(claim), table.text()));
  if (of_other_numbers > 0)
    print(fmt::format("{} records were not asked: their numbers are of another precision\n\n",
                      of_other_numbers));
  if (!failures.empty()) {
    print("The first failures:\n");
    for (const std::string& failure : failures) print(failure);
    print("\n");
  }
  total.name = engine;
  print(verdict_of(total) + '\n');
}

// ---- A documentation page

// For example "12 wrong, 3 ill-posed"; empty if all answers agree.
std::string troubles(const Tally& t) {
  return counted_text(t.counts, {Count::wrong, Count::wrong_time, Count::other_quantity, Count::ill_posed,
                                 Count::undecided, Count::unsupported, Count::error, Count::missing});
}

// Text for a table cell: printable, without characters that end a cell or begin markup.
std::string in_markdown(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) out += c == '|' ? "\\|" : c == '<' ? "&lt;" : std::string(1, c);
  return out;
}

std::string summary_page(const std::vector<EngineInfo>& engines,
                         const std::vector<std::vector<SetTally>>& tallies) {
  std::string page = "| set | records |";
  for (const EngineInfo& engine : engines) page += fmt::format(" {} |", in_markdown(engine.name));
  page += "\n|---|---|" + fmt::format("{}", fmt::join(std::vector<std::string>(engines.size(), "---|"), "")) +
          '\n';
  for (std::size_t s = 0; s < tallies.front().size(); ++s) {
    page +=
        fmt::format("| {} | {} |", in_markdown(tallies.front()[s].all.name), tallies.front()[s].all.queries);
    for (const auto& of_engine : tallies) {
      const std::string text = s < of_engine.size() ? troubles(of_engine[s].all) : "not run";
      page += fmt::format(" {} |", text.empty() ? "all agree" : text);
    }
    page += '\n';
  }
  return page;
}

// The tags on which an engine is wrong, with what their cases are designed to break.
std::string faults_page(const std::string& engine, const std::vector<SetTally>& tallies,
                        const std::vector<std::string>& failures) {
  std::string rows;
  for (const SetTally& set : tallies)
    for (const auto& [tag, note] : set.notes) {
      const auto found = set.by_tag.find(tag);
      if (found == set.by_tag.end() || found->second.counts.sum({Count::wrong, Count::error}) == 0) continue;
      rows += fmt::format("| {} | {} | {} | {} | {} |\n", in_markdown(set.all.name), in_markdown(tag),
                          found->second.queries, troubles(found->second), in_markdown(note));
    }
  std::string page = fmt::format("\n## {}\n\n", in_markdown(engine));
  if (rows.empty()) return page + "No wrong answer.\n";
  page += "| set | tag | records | of these | what the tag is out to break |\n|---|---|---|---|---|\n" + rows;
  if (failures.empty()) return page;
  page += "\nThe first failures:\n\n```\n";
  for (const std::string& failure : failures) page += failure;
  return page + "```\n";
}

int act(CheckOptions options) {
  const std::vector<EngineInfo> engines = engines_named(options.engines, options.timeout);
  if (engines.empty()) throw InputError("--engine: name one (" + names_for_help() + ")");
  if (const auto option = options.files.first_option(); option && engines.size() > 1)
    throw InputError(*option + ": is of one engine; name one");
  options.claim.ask(engines);
  const Claim claim = options.claim.claim();
  const double timeout = options.timeout.value_or(AnswererOptions::kDefaultTimeout);
  const std::vector<std::string> files = golden::find_sets(options.sets);
  int status = kDone;
  std::size_t records = 0;
  std::vector<std::vector<SetTally>> all_tallies;
  std::string pages;
  for (const EngineInfo& info : engines) {
    const std::string& engine = info.name;
    EngineCheck examination(info, options, {{}, timeout, terminal(), options.strict});
    std::vector<SetTally> tallies;
    for (const std::string& file : files) {
      if (!examination.is_worth_asking()) {
        say("{}: given up; {} sets were not asked", engine, files.size() - tallies.size());
        break;
      }
      tallies.push_back(examination.run(file));
      const SetTally& its = tallies.back();
      records += its.all.queries + its.not_asked();
      if (its.given_up_before > 0)
        say("{}: given up in {}: {} records were not asked", engine, its.all.name, its.given_up_before);
    }
    examination.finish();
    const bool failed = std::ranges::any_of(tallies, &SetTally::failed);
    status = std::max<int>(status, failed ? kFailed : examination.new_failures() > 0 ? kDisagreement : kDone);
    if (options.json)
      print(json_of(engine, claim, tallies, files.size() - tallies.size()));
    else if (!options.markdown)
      show(engine, claim, tallies, examination.failures(), files.size() - tallies.size());
    else
      pages += faults_page(engine, tallies, examination.failures());
    all_tallies.push_back(std::move(tallies));
  }
  if (options.markdown) print(summary_page(engines, all_tallies) + pages);
  if (options.id && records == 0)
    throw InputError("--id: no record has the id, or one that begins with, " + json_quoted(*options.id));
  return status;
}

}  // namespace

Command golden_check_command() {
  auto options = std::make_shared<CheckOptions>();
  return {"check",
          "Checks an engine against sets: a table by set and tag, the first failures.",
          {
              {"-e,--engine", &options->engines, "ENGINE",
               names_for_help() + "; several with commas, or once each", kOneAtATime},
              {"sets", &options->sets, "SET",
               "files, folders, or names of committed sets (default: all of these)"},
              {"--ulps", Tolerance{&options->ulps}, "K",
               "the tolerance k of the verdicts; 0 forgives nothing (default: 4)"},
              options->claim.precision_row("else each set's own"),
              options->claim.time_tolerance_row(),
              {"--first", Whole{&options->first, 1, 1'000'000'000'000}, "N",
               "only the first N records of each set"},
              {"--id", &options->id, "ID", "only this record; the beginning of its id will do"},
              {"--failures", Whole{&options->failures, 0, 1'000'000}, "N",
               "list at most N failures of each engine"},
              {"--jobs", Whole{&options->jobs, 1, 1024}, "N",
               "threads, of engines of this program: the same results"},
              {"--timeout", Positive{&options->timeout}, "SECONDS", kTimeoutHelp},
              {"--times", &options->times, "", "wrong times count: exit status 1, and among the failures"},
              {"--strict", &options->strict, "", "exit status 1 also for ill-posed and undecided answers"},
              options->files.baseline_row(),
              options->files.write_baseline_row(),
              options->files.junit_row(),
              {"--json", &options->json, "", "one JSON object an engine"},
              {"--markdown", &options->markdown, "", "a page of documentation: which engine fails which set"},
          },

          "Exit status 1: an answer is wrong, an error or missing; 3: a cmd: or lib: engine broke.\n"
          "Examples:\n  lorentz golden check --engine 'cmd:python3 examples/naive_engine.py' --first 64 "
          "generic-3d\n  lorentz golden check -e published --write-baseline known.txt published-faults\n"
          "From then on the same line with --baseline known.txt fails only for what is new.",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
