// lorentz golden check: checks engines with golden sets.
#include <algorithm>
#include <limits>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/lineup.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "report/claim_words.hpp"
#include "report/table.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

// A set, and what it was asked by.
struct CheckedSet {
  std::string label;  // the name; also the precision if the set has one and the name does not
  Claim claim;
  std::size_t of_other_numbers = 0;  // records not asked because their numbers are not the engine's
  std::size_t outside_domain = 0;    // records not asked because the engine does not claim to do them
};

std::string label_of(const golden::Header& header, const Claim& claim, const ExaminationOptions& options) {
  const std::string precision = name_of(claim.precision);
  const bool is_told = options.claim.precision || claim.precision == NumberFormat::binary64 ||
                       header.name.ends_with(precision);
  return is_told ? header.name : header.name + ", in " + precision;
}

// Asks the lineup the first records of a set, filtered by the beginning of the id, and returns how many that
// were. Records that do not consist of the engine's numbers are left out and counted.
std::size_t ask_set(const std::string& path, const ExaminationOptions& options, Lineup& lineup,
                    std::vector<CheckedSet>& sets) {
  constexpr std::size_t kTogether = 4096;
  golden::Reader reader(path, KeyCheck(path, options.strict));
  const golden::Header& header = reader.header();
  const Claim claim = options.claim.claim(header.precision);
  CheckedSet& set = sets.emplace_back(CheckedSet{label_of(header, claim, options), claim});
  AskedPart part{
      {}, path, report::arguments_of(claim, options.tolerance()) + (options.times ? " --times" : "")};
  if (claim.precision == NumberFormat::binary64 && header.precision != claim.precision)
    part.claim += " --precision binary64";
  const std::uint64_t first = options.first.value_or(std::numeric_limits<std::uint64_t>::max());
  Progress progress(header.name, header.count);
  const Source records = golden::questions_of(reader, claim);
  std::size_t asked = 0;
  lineup.begin(header.name);
  std::uint64_t read = 0;
  for (; read < first; progress.at(++read)) {
    std::optional<Question> question = records();
    if (!question) break;
    if (options.id && !question->where.starts_with(*options.id)) continue;
    ++asked;
    const Place& place = *question->place;
    if (!place.has_numbers_for(question->query))
      ++set.of_other_numbers;
    else if (!is_in_domain(*question))
      ++set.outside_domain;
    else
      part.questions.push_back(std::move(*question));
    if (part.questions.size() == kTogether) lineup.ask(part), part.questions.clear();
  }
  if (read < first ? read != header.count : read > header.count)
    throw InputError(
        fmt::format("{}: the header says {} records, there are {}{}; lorentz golden verify says more", path,
                    header.count, read, read < first ? "" : " or more"));
  lineup.ask(part);
  lineup.end(!options.id && first >= header.count && set.of_other_numbers + set.outside_domain == 0);
  return asked;
}

std::vector<std::string> cells_of(const std::string& set, const std::string& tag, const Tally& t) {
  return cells_counted(t.counts, Counted::examinations, {set, tag, std::to_string(t.queries)}, {},
                       dash_for_none);
}

void add_counts(json::Members& object, const Tally& t) {
  object.add("records", t.queries);
  question::add_counts(object, t.counts, Counted::examinations);
}

std::size_t not_asked_of(const ExaminedRow& row, const CheckedSet& set) {
  return row.not_asked + set.of_other_numbers;
}

// The claim by which all sets were judged; not added if the sets have several precisions.
void add_common_claim(json::Members& object, const Claim& claim, const std::vector<CheckedSet>& sets) {
  Claim its = claim;
  if (!sets.empty()) its.precision = sets.front().claim.precision;
  if (std::ranges::all_of(sets, [&](const CheckedSet& set) { return set.claim.precision == its.precision; }))
    report::add_claim(object, its);
  else
    object.add("precision", std::optional<double>(), "time_tolerance", claim.time_tolerance);
}

// An engine that is given up for good has fewer rows than there are sets.
std::string json_of(const LineupEntry& one, const Claim& claim, const std::vector<CheckedSet>& sets) {
  const auto& rows = one.examination.rows();
  std::size_t not_asked = 0, outside = 0;
  const auto add_set = [&](json::Members& object, std::size_t i) {
    object.add("set", rows[i].name);
    add_counts(object, rows[i].tally);
    not_asked += not_asked_of(rows[i], sets[i]);
    outside += sets[i].outside_domain;
    object.add("not_asked", not_asked_of(rows[i], sets[i]), "outside_domain", sets[i].outside_domain,
               "precision", name_of(sets[i].claim.precision), "tags", [&](json::Members& tags) {
                 for (const auto& [tag, tally] : rows[i].by_tag)
                   tags.add_named(tag, [&](json::Members& counts) { add_counts(counts, tally); });
               });
  };
  std::vector<std::size_t> numbers(rows.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  return json::line_of([&](json::Members& object) {
    object.add("engine", one.examination.name(), "sets", json::objects(numbers, add_set));
    add_common_claim(object, claim, sets);
    object.add("records_not_asked", not_asked, "records_outside_domain", outside, "not_asked",
               sets.size() - rows.size());
  });
}

std::string text_of(const LineupEntry& one, const Claim& claim, const std::vector<CheckedSet>& sets) {
  const auto& rows = one.examination.rows();
  report::Table table(titles_counted(Counted::examinations, {"set", "tag", "records"}, {}));
  std::size_t of_other_numbers = 0, outside = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table.add(cells_of(sets[i].label, "all", rows[i].tally));
    for (const auto& [tag, tally] : rows[i].by_tag) table.add(cells_of("", tag, tally));
    of_other_numbers += sets[i].of_other_numbers, outside += sets[i].outside_domain;
  }
  if (sets.size() > rows.size())
    table.add(cells_of(fmt::format("{} sets not asked", sets.size() - rows.size()), "", {}));
  const Tally total = one.total();
  table.add(cells_of("total", "", total));
  std::string text =
      fmt::format("{}{}\n\n{}\n", one.examination.name(), report::words_of(claim), table.text());
  if (of_other_numbers > 0)
    text += fmt::format("{} records were not asked: their numbers are of another precision\n\n",
                        of_other_numbers);
  if (outside > 0)
    text += fmt::format("{} records were not asked: they are outside of the declared domain\n\n", outside);
  if (!one.failures.empty()) text += fmt::format("The first failures:\n{}\n", fmt::join(one.failures, ""));
  return text + verdict_of(total) + '\n';
}

int run_golden_check(ExaminationOptions options) {
  const std::vector<EngineInfo> engines = options.named_engines();
  options.claim.ask(engines, options.strict);
  Lineup lineup(options, engines);
  std::vector<CheckedSet> sets;
  std::size_t records = 0;
  for (const std::string& path : golden::find_sets(options.sets))
    records += ask_set(path, options, lineup, sets);
  if (options.id && records == 0)
    throw InputError("--id: no record has the id, or one that begins with, " + json_quoted(*options.id));
  const int status = lineup.finish();
  for (const LineupEntry& one : lineup.all()) {
    if (const std::size_t left = sets.size() - one.examination.rows().size(); left > 0)
      say("{}: given up; {} sets were not asked", one.examination.name(), left);
    const Claim claim = options.claim.claim();
    print(options.json ? json_of(one, claim, sets) : text_of(one, claim, sets));
  }
  return status;
}

}  // namespace

Command golden_check_command() {
  auto options = std::make_shared<ExaminationOptions>();
  options->failures = 10;
  return {
      "check", "Checks engines against sets: a table by set and tag, the first failures.",
      options->rows({"--engine", "sets", "--first", "--id", "--jobs", "--disagreements", "--ulps",
                     "--precision", "--time-tolerance", "--domain", "--starts-inside", "--timeout", "--json",
                     "--failures", "--times", "--strict", "--baseline", "--junit"}),

      "The precision is each set's own, unless --precision or the engine says another one. Exit status 1: an "
      "answer is wrong, an error or missing; 3: a cmd: or lib: engine broke.\n"
      "Examples:\n  lorentz golden check --engine 'cmd:python3 docs/examples/naive_engine.py' --first 64 "
      "generic-3d\n  lorentz golden check -e published --baseline known.txt published-faults\n"
      "The first time this writes known.txt; from then on the same line fails only for what is new.",
      [options] { return run_golden_check(*options); }};
}

}  // namespace lorentz::cli
