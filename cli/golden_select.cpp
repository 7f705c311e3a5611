// lorentz golden merge, filter, sample: make a set from the records of other sets.
#include <algorithm>

#include "cli/app.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "golden/find_sets.hpp"
#include "golden/selection.hpp"

namespace lorentz::cli {
namespace {

struct SelectOptions {
  std::vector<std::string> sets, tags, without;
  std::string name = "selection";
  std::optional<double> margin_below;
  std::optional<std::uint64_t> count;
};

bool has_one_of(const std::vector<std::string>& tags, const golden::Record& record) {
  return std::ranges::any_of(
      tags, [&](const std::string& tag) { return std::ranges::find(record.tags, tag) != record.tags.end(); });
}

int act(const SelectOptions& options) {
  check_set_name(options.name);
  const auto takes = [&](const golden::Record& record) {
    if (!options.tags.empty() && !has_one_of(options.tags, record)) return false;
    if (has_one_of(options.without, record)) return false;
    return !options.margin_below || (record.margin && *record.margin < *options.margin_below);
  };
  golden::Selection selection;
  for (const std::string& path : golden::find_sets(options.sets)) {
    golden::Reader set(path);
    if (set.header().precision == NumberFormat::binary64 || !options.sets.empty()) selection.add(set, takes);
  }
  if (options.count) selection.thin(*options.count);
  if (selection.size() == 0) say("warning: no record is left");
  print(selection.text({.name = options.name,
                        .description = "Records of other sets.",
                        .generator = command_line(),
                        .version = LORENTZ_VERSION}));
  return kDone;
}

Option sets_row(SelectOptions& options) {
  return {"sets", &options.sets, "SET",
          "files, folders, or names of committed sets (default: all of these in binary64)"};
}

Option name_row(SelectOptions& options) {
  return {"--name", &options.name, "NAME", "of the set that is written"};
}

}  // namespace

Command golden_merge_command() {
  auto options = std::make_shared<SelectOptions>();
  return {"merge",
          "Several sets in one, on standard output; a record that is in two of them once.",
          {sets_row(*options), name_row(*options)},
          "Example:\n  lorentz golden merge ties grazing > both.ndjson",
          [options] { return act(*options); }};
}

Command golden_filter_command() {
  auto options = std::make_shared<SelectOptions>();
  return {"filter",
          "Those records of sets that have a tag, or a small margin.",
          {sets_row(*options),
           {"--tag", &options->tags, "TAG", "with this tag, or one of several", kOneAtATime},
           {"--without", &options->without, "TAG", "without it", kOneAtATime},
           {"--margin-below", Positive{&options->margin_below}, "ULPS", "with a margin below it"},
           name_row(*options)},
          "Example:\n  lorentz golden filter --margin-below 4 --without needs-judge ties > close.ndjson",
          [options] { return act(*options); }};
}

Command golden_sample_command() {
  auto options = std::make_shared<SelectOptions>();
  options->count = 100;
  return {"sample",
          "A few records of sets: in turn one of each tag of each set.",
          {sets_row(*options),
           {"--count", Whole{&options->count, 1, 1'000'000'000}, "N", "how many (default: 100)"},
           {"--without", &options->without, "TAG", "none with this tag", kOneAtATime},
           name_row(*options)},
          "Example:\n  lorentz golden sample --count 20 ties grazing > smoke.ndjson",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
