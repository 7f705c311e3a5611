// lorentz golden make: makes one set, or all committed sets.
#include <cerrno>
#include <filesystem>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/file_options.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/set_output.hpp"
#include "judge/golden/index.hpp"
#include "judge/golden/production.hpp"
#include "judge/golden/selection.hpp"
#include "question/starts/free_starts.hpp"
#include "report/files/whole_file.hpp"
#include "report/manifest.hpp"
#include "src/exchange/nearest_name.hpp"
#include "src/problem/write_error.hpp"

namespace lorentz::cli {

namespace {

namespace fs = std::filesystem;

struct MakeOptions {
  std::optional<std::string> set, folder, precision, name;
  QuestionOptions questions;
  std::optional<std::uint64_t> count;
  std::string output = "-";
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1;
};

NumberFormat precision_of(const MakeOptions& options) {
  return number_format_named(options.precision.value_or("binary64"));
}

const golden::Set& set_of(const MakeOptions& options) {
  const NumberFormat precision = precision_of(options);
  const golden::Set* set = golden::set_named(*options.set, precision);
  if (!set) {
    std::vector<std::string> names;
    for (const golden::Set& one : golden::sets()) names.push_back(one.name);
    index_of_name(*options.set, names, "--set");  // throws
  }
  if (options.precision && set->precision != precision)
    throw InputError(
        fmt::format("--precision: the set {} is of {} only", set->name, name_of(set->precision)));
  return *set;
}

std::string name_of(const golden::Order& order) {
  return golden::header_of(order).name;
}

std::string seed_of(const golden::Order& order) {
  return fmt::format(" (seed {})", order.seed);
}

golden::RecordCounts make_file(const golden::Order& order, const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    throw FileError(path + ": is not a regular file; name another, or use standard output");
  refuse_other_kinds(path, OutputKind::golden_set);
  goes_on_when_repeated();
  const std::string part = path + ".part";
  if (fs::is_symlink(fs::symlink_status(part))) throw write_error(part, ELOOP);
  golden::RecordCounts counts;
  {
    runs::Plan plan = golden::plan_of(order);
    plan.push_back(
        {"commit", report::manifest_of(order.seed, command_line()).commit});  // its records may change
    runs::PieceStore kept(part, "golden make", plan);
    WholeFile file(path);
    Progress progress(name_of(order), order.count, 1);
    counts = golden::produce(
        order, [&](std::string_view text) { file.write(text); },
        [&](std::uint64_t done) { progress.at(done); }, &kept);
    file.commit();
  }
  fs::remove(part);
  return counts;
}

// Several records of each tag, for a first check in less than a second.
std::string smoke_of(const std::vector<std::string>& files) {
  constexpr std::size_t kRecords = 100;
  golden::Selection selection;
  for (const std::string& file : files) {
    golden::Reader set(file);
    selection.add(set, [](const golden::Record& record) { return !golden::needs_judge(record); });
  }
  selection.thin(kRecords);
  return selection.text({.name = "smoke",
                         .description = "A few records of each tag of the sets in binary64.",
                         .generator = "lorentz golden make --all data/golden",
                         .version = LORENTZ_VERSION});
}

int make_all(golden::Order order, const std::string& folder) {
  const auto in_folder = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  std::error_code error;
  fs::create_directories(in_folder("smoke"), error);
  check_folder(folder);
  std::vector<std::string> names, wide;
  for (const golden::Set& set : golden::sets()) {
    if (!set.is_committed) continue;
    order.set = &set;
    order.count = set.count;
    names.push_back(set.name + ".ndjson");
    report(set.name, make_file(order, in_folder(names.back())), seed_of(order));
    const bool is_geometry = set.name != "bad-queries";
    if (is_geometry && set.precision == NumberFormat::binary64) wide.push_back(in_folder(names.back()));
  }
  names.push_back("smoke/smoke.ndjson");
  refuse_other_kinds(in_folder(names.back()), OutputKind::golden_set);
  write_whole(in_folder(names.back()), smoke_of(wide));
  golden::write_index(folder, golden::index_of(folder, names), names);
  return kDone;
}

golden::RecordCounts make(const golden::Order& order, const std::string& output) {
  if (output != "-") return make_file(order, output);
  Progress progress(name_of(order), order.count, 1);
  const auto write = [](std::string_view text) {
    print(text);
    if (std::ferror(stdout)) finish_output();
  };
  return golden::produce(order, write, [&](std::uint64_t done) { progress.at(done); });
}

int make_one(golden::Order order, const MakeOptions& options) {
  order.set = &set_of(options);
  order.count = options.count.value_or(order.set->count);
  if (order.count > order.set->most) {
    say("{}: there are {} records, not {}", order.set->name, order.set->most, order.count);
    order.count = order.set->most;
  }
  report(order.set->name, make(order, options.output), seed_of(order));
  return kDone;
}

int make_of_queries(golden::Order order, const MakeOptions& options) {
  const golden::Header header{
      .name = options.name.value_or("queries"),
      .description = "Given queries, answered exactly.",
      .generator = "lorentz golden make --queries " + shell_quoted(*options.questions.queries),
      .version = LORENTZ_VERSION,
      .precision = precision_of(options)};
  bool had_bad_input = false;
  const golden::GivenQuestions given = options.questions.read(header, had_bad_input);
  order.given = &given;
  order.count = given.questions.size();
  const golden::RecordCounts counts = make(order, options.output);
  report(given.header.name, counts);
  return had_bad_input ? kBadInput : counts.left_out > 0 ? kDisagreement : kDone;
}

void check(const MakeOptions& options) {
  const int ways =
      options.set.has_value() + options.folder.has_value() + options.questions.queries.has_value();
  if (ways != 1)
    throw InputError(
        "name a set (--set NAME), a file of queries (--queries FILE), or a folder for all sets (--all "
        "FOLDER)");
  if (options.folder && (options.count || options.precision))
    throw InputError("--all makes every set as it is committed; leave --count and --precision out");
  if (options.questions.queries && options.count)
    throw InputError("--count: not with --queries, which are all taken");
  if (options.questions.queries && options.seed != starts::kDefaultSeed)
    throw InputError("--seed: not with --queries, which are not drawn");
  if (options.name) check_set_name(*options.name);
  if (!options.questions.queries && (options.questions.are_given() || options.name))
    throw InputError("--scene, --radius, --name and --tag: need --queries");
}

int act(const MakeOptions& options) {
  check(options);
  golden::Order order;
  order.seed = options.seed;
  order.jobs = options.jobs;
  if (options.folder) return make_all(order, *options.folder);
  return options.questions.queries ? make_of_queries(order, options) : make_one(order, options);
}

}  // namespace

Command golden_make_command() {
  auto options = std::make_shared<MakeOptions>();
  return {
      "make",
      "Produces a set, of cases that are drawn or of queries that you have: the same, bit for bit, whatever "
      "--jobs.",
      joined(joined({{"--set", &options->set, "SET", "which set (lorentz golden list)"}},
                    options->questions.rows()),
             {
                 {"--name", &options->name, "NAME", "of the set that --queries become (default: queries)"},
                 {"--precision", &options->precision, "binary64|binary32",
                  "of the numbers of scenes and queries: cases are hard in its ulps, which margins and "
                  "conditions count (default: binary64)"},
                 {"--count", Whole{&options->count, 1, 1'000'000'000'000}, "N",
                  "how many records (default: as many as are committed, or would be)"},
                 {"--seed", Whole{&options->seed}, "N", "of the cases"},
                 {"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads"},
                 {"-o,--output", &options->output, "FILE",
                  "file to write (- is standard output); killed in between, the same command goes on where "
                  "it was",
                  kOutput | kTakesStdout},
                 {"--all", &options->folder, "FOLDER",
                  "make all sets in this folder as they are committed, index.json, smoke/smoke.ndjson (a few "
                  "records of each tag) and SHA256SUMS"},
             }),

      "Every record was agreed by two oracles: walk, where it can go, and the checked certificate.\n"
      "Example:\n  lorentz golden make --set near-rational --count 1e3 --jobs 2 -o near-rational.ndjson\n"
      "  lorentz golden make --set grazing --precision binary32 -o grazing-binary32.ndjson\n"
      "  lorentz sample --scene square --kind grazing --count 100 | lorentz golden make --queries - "
      "--tag mine",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
