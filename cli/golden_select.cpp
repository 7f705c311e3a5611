// lorentz golden filter: makes a set from the records of other sets.
#include <algorithm>

#include "cli/app.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "judge/golden/find_sets.hpp"
#include "judge/golden/selection.hpp"

namespace lorentz::cli {
namespace {

struct SelectOptions {
  std::vector<std::string> sets, tags, without;
  std::string name = "selection";
  std::optional<double> margin_below;
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
  if (selection.size() == 0) say("warning: no record is left");
  print(selection.text({.name = options.name,
                        .description = "Records of other sets.",
                        .generator = command_line(),
                        .version = LORENTZ_VERSION}));
  return kDone;
}

}  // namespace

Command golden_filter_command() {
  auto options = std::make_shared<SelectOptions>();
  return {"filter",
          "Several sets in one: all records once, or those that have a tag, or a small margin.",
          {{"sets", &options->sets, "SET",
            "files, folders, or names of committed sets (default: all of these in binary64)"},
           {"--tag", &options->tags, "TAG", "with this tag, or one of several", kOneAtATime},
           {"--without", &options->without, "TAG", "without it", kOneAtATime},
           {"--margin-below", Positive{&options->margin_below}, "ULPS", "with a margin below it"},
           {"--name", &options->name, "NAME", "of the set that is written"}},
          "Example:\n  lorentz golden filter --margin-below 4 --without needs-judge ties > close.ndjson",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
