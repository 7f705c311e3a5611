// lorentz golden make: makes one set, or all committed sets.
#include <algorithm>
#include <filesystem>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/file_options.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "judge/golden/index.hpp"
#include "judge/golden/production.hpp"
#include "question/starts/free_starts.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "src/exchange/exchange_json.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

namespace {

namespace fs = std::filesystem;

struct MakeOptions {
  std::optional<std::string> set, folder, precision, queries, scene;
  std::optional<double> radius;
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

// The name of a set of given queries: that of its file, if it can be one.
std::string set_name_for(const std::string& output) {
  const std::string stem = fs::path(output).stem().string();
  return output != "-" && is_set_name(stem) ? stem : "queries";
}

// Says which set was made, and from which seed.
void report(const std::string& name, const golden::RecordCounts& counts,
            std::optional<std::uint64_t> seed = {}) {
  say("{}: {} records{}: {} hit, {} inside, {} never, {} error", name, counts.records,
      seed ? fmt::format(" (seed {})", *seed) : "", counts.hits, counts.insides, counts.nevers,
      counts.errors);
  if (const std::uint64_t answered = counts.records - counts.errors; answered > 0)
    say("{}: all {} answers agreed by their checked certificates, {} of them by walk, too", name, answered,
        counts.walked);
  if (counts.needing_judge > 0)
    say("{}: {} records have the tag {}: their acceptable answers are not listed", name, counts.needing_judge,
        golden::kNeedsJudge);
  say_unproved(counts);
}

golden::RecordCounts make(const golden::Order& order, const std::string& output) {
  std::optional<WholeFile> file;
  if (output != "-") {
    std::error_code error;
    if (fs::exists(output, error) && !fs::is_regular_file(output, error))
      throw FileError(output + ": is not a regular file; name another, or use standard output");
    refuse_other_kinds(output, OutputKind::golden_set);
    file.emplace(output);
  }
  const auto write = [&](std::string_view text) {
    if (file) return file->write(text);
    print_data(text);
    if (std::ferror(stdout)) finish_output();
  };
  Progress progress(golden::header_of(order).name, order.count, 1);
  const golden::RecordCounts counts =
      golden::produce(order, write, [&](std::uint64_t done) { progress.at(done); });
  if (file) file->commit();
  return counts;
}

// For a first check in less than a second.
std::string smoke_of(const std::vector<std::string>& files) {
  constexpr std::size_t kRecords = 100;
  return golden::smoke_of(files, kRecords,
                          {.name = "smoke",
                           .description = "Records of the sets in binary64, in turn one of each tag.",
                           .generator = "lorentz golden make --all data/golden",
                           .version = LORENTZ_VERSION});
}

// Throws InputError if the folder has an index or checksums that did not come from here.
void check_folder(const fs::path& folder) {
  const auto is_index = [](const fs::path& file) {
    try {
      const std::string text = text_of_file(file);
      json::Document document;
      document.open(text);
      bool has_sets = false;
      json::each_member(document.object(), [&](std::string_view key, json::Value value) {
        has_sets |= key == "sets" && value.type() == json::Type::array;
        skip(value);
      });
      return has_sets;
    } catch (const NotJson&) {
      return false;
    }
  };
  if (fs::exists(folder / "index.json") && is_index(folder / "index.json")) return;
  for (const char* name : {"index.json", "SHA256SUMS"})
    if (fs::exists(folder / name))
      throw InputError((folder / name).string() +
                       ": was not written by this command, and is left as it is; move it, or the sets");
}

int make_all(golden::Order order, const std::string& folder) {
  const auto in_folder = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  std::error_code error;
  check_folder(folder);
  fs::create_directories(in_folder("smoke"), error);
  std::vector<std::string> names, wide;
  for (const golden::Set& set : golden::sets()) {
    if (!set.is_committed) continue;
    order.set = &set;
    order.count = set.count;
    names.push_back(set.name + ".ndjson");
    report(set.name, make(order, in_folder(names.back())), order.seed);
    const bool is_geometry = set.name != "bad-queries";
    if (is_geometry && set.precision == NumberFormat::binary64) wide.push_back(in_folder(names.back()));
  }
  names.push_back("smoke/smoke.ndjson");
  refuse_other_kinds(in_folder(names.back()), OutputKind::golden_set);
  write_whole(in_folder(names.back()), smoke_of(wide));
  golden::write_index(folder, names);
  return kDone;
}

int make_one(golden::Order order, const MakeOptions& options) {
  order.set = &set_of(options);
  order.count = options.count.value_or(order.set->count);
  if (order.count > order.set->most) {
    say("{}: there are {} records, not {}", order.set->name, order.set->most, order.count);
    order.count = order.set->most;
  }
  report(order.set->name, make(order, options.output), order.seed);
  return kDone;
}

// `had_bad_input`: some were invalid, or their numbers do not have the header's precision.
golden::GivenQuestions given_questions(const MakeOptions& options, golden::Header header,
                                       bool& had_bad_input) {
  const NumberFormat precision = header.precision;
  std::optional<Scene> first;
  if (options.scene) first = load_scene(*options.scene, options.radius);
  if (options.radius && !options.scene)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  GivenQueries source(*options.queries, first, false);
  std::size_t others = 0;
  golden::GivenQuestions given = questions_in(source, std::move(header), others);
  given.look = true;
  if (others > 0)
    say("{}: {} queries left out, for they do not consist of numbers of {}", source.name(), others,
        lorentz::name_of(precision));
  if (given.questions.empty())
    throw InputError(source.name() + ": no question in it can be a record; nothing is written");
  had_bad_input = source.had_bad_input() || others > 0;
  return given;
}

std::string generator_of(const MakeOptions& options) {
  std::string text = "lorentz golden make --queries " + shell_quoted(*options.queries);
  if (options.scene) text += " --scene " + shell_quoted(*options.scene);
  if (options.radius) text += fmt::format(" --radius {}", *options.radius);
  if (options.precision) text += " --precision " + *options.precision;
  return text +
         (options.output == "-" ? "" : " -o " + shell_quoted(fs::path(options.output).filename().string()));
}

int make_of_queries(golden::Order order, const MakeOptions& options) {
  const golden::Header header{.name = set_name_for(options.output),
                              .description = "Given queries, answered exactly.",
                              .generator = generator_of(options),
                              .version = LORENTZ_VERSION,
                              .precision = precision_of(options)};
  bool had_bad_input = false;
  const golden::GivenQuestions given = given_questions(options, header, had_bad_input);
  order.given = &given;
  order.count = given.questions.size();
  const golden::RecordCounts counts = make(order, options.output);
  report(given.header.name, counts);
  return had_bad_input ? kBadInput : counts.left_out > 0 ? kDisagreement : kDone;
}

void check(const MakeOptions& options) {
  const int ways = options.set.has_value() + options.folder.has_value() + options.queries.has_value();
  if (ways != 1)
    throw InputError(
        "name a set (--set NAME), a file of queries (--queries FILE), or a folder for all sets (--all "
        "FOLDER)");
  if (options.folder && (options.count || options.precision || options.output != "-"))
    throw InputError("--all makes every set as it is committed; leave --count, --precision and -o out");
  if (options.queries && options.count) throw InputError("--count: not with --queries, which are all taken");
  if (options.queries && options.seed != starts::kDefaultSeed)
    throw InputError("--seed: not with --queries, which are not drawn");
  if (!options.queries && (options.scene || options.radius))
    throw InputError("--scene and --radius: need --queries");
}

int run_golden_make(const MakeOptions& options) {
  check(options);
  golden::Order order;
  order.seed = options.seed;
  order.jobs = options.jobs;
  if (options.folder) return make_all(order, *options.folder);
  return options.queries ? make_of_queries(order, options) : make_one(order, options);
}

}  // namespace

Command golden_make_command() {
  auto options = std::make_shared<MakeOptions>();
  return {
      "make",
      "Produces a set, of cases that are drawn or of queries that you have: the same, bit for bit, whatever "
      "--jobs.",
      {
          {"--set", &options->set, "SET", "which set (lorentz golden list)"},
          {"--queries", &options->queries, "FILE",
           "records of these queries, a set named as --output: a stream (- is standard input), or columns "
           "(.npy, .csv); invalid queries of a stream become records of errors"},
          {"--scene", &options->scene, "SCENE",
           "scene before the first scene line, and of columns: a file, or a name of the catalogue"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball of --scene"},
          {"--precision", &options->precision, "binary64|binary32",
           "format of the numbers of scenes and queries: cases are hard in its ulps, which margins and "
           "conditions count (default: binary64)"},
          {"--count", Whole{&options->count, 1, 1'000'000'000'000}, "N",
           "how many records (default: as many as are committed, or would be)"},
          {"--seed", Whole{&options->seed}, "N", "seed of the cases"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads"},
          {"-o,--output", &options->output, "FILE", "file to write (- is standard output)",
           kOutput | kTakesStdout},
          {"--all", &options->folder, "FOLDER",
           "make all sets in this folder as they are committed, index.json, smoke/smoke.ndjson (a "
           "hundred of their records) and SHA256SUMS"},
      },

      "Every record was agreed by two oracles: walk, where it can go, and the checked certificate.\n"
      "Example:\n  lorentz golden make --set near-rational --count 1e3 --jobs 2 -o near-rational.ndjson\n"
      "  lorentz golden make --set grazing --precision binary32 -o grazing-binary32.ndjson\n"
      "  lorentz sample --scene square --kind grazing --count 100 | lorentz golden make --queries -",
      [options] { return run_golden_make(*options); }};
}

}  // namespace lorentz::cli
