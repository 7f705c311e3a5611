// lorentz golden verify: checks that the certificates of sets prove their answers.
#include <set>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "judge/golden/maker.hpp"
#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "report/files/unknown_keys.hpp"

namespace lorentz::cli {
namespace {

constexpr std::size_t kMostComplaints = 20;

// The flaw of a record within its set: ids must be unique, tags must be explained.
std::optional<std::string> flaw_in_set(const golden::Header& header, const golden::Record& record,
                                       std::set<std::string>& ids) {
  if (!ids.insert(record.id).second) return "the id came before";
  if (record.tags.empty()) return "it has no tag";
  for (const std::string& tag : record.tags)
    if (!header.explains(tag)) return "the header does not explain its tag " + json_quoted(tag);
  return std::nullopt;
}

// Prints a line about the set, and returns the number of its flaws.
std::size_t verify(const std::string& path, bool walk) {
  golden::Reader reader(path, KeyCheck(path, false));
  Progress progress(path.c_str(), reader.header().count);
  std::size_t records = 0, flaws = 0;
  std::set<std::string> ids;
  std::optional<golden::Maker> maker;
  std::size_t scene = 0;
  const auto complain = [&](std::size_t line, const std::string& what) {
    if (++flaws <= kMostComplaints) say("{}:{}: {}", reader.path(), line, what);
  };
  for (golden::ReadRecord read; reader.next(read); progress.at(records)) {
    ++records;
    if (scene != reader.scene_number())
      maker.emplace(reader.scene(), reader.scene_line(), golden::Others{}, reader.header().precision);
    scene = reader.scene_number();
    auto flaw = flaw_in_set(reader.header(), read.record, ids);
    if (!flaw) flaw = maker->flaw_of(read.record, read.query, walk, reader.header().format);
    if (flaw) complain(read.line, "id " + read.record.id + ": " + *flaw);
  }
  if (records != reader.header().count)
    complain(1, fmt::format("the header says {} records, there are {}", reader.header().count, records));
  if (flaws > kMostComplaints) say("{}: {} more", path, flaws - kMostComplaints);
  print(fmt::format("{}: {} records, {}\n", path, records,
                    flaws ? fmt::format("{} REFUTED", flaws) : "all verified"));
  return flaws;
}

int run_golden_verify(const std::vector<std::string>& names, bool walk) {
  std::size_t flaws = 0;
  bool bad = false;
  for (const std::string& path : golden::find_sets(names)) {
    try {
      flaws += verify(path, walk);
    } catch (const InputError& error) {  // the other sets are still checked
      say("{}", error.what());
      bad = true;
    }
  }
  return bad ? kBadInput : flaws ? kDisagreement : kDone;
}

}  // namespace

Command golden_verify_command() {
  auto names = std::make_shared<std::vector<std::string>>();
  auto walk = std::make_shared<bool>(false);
  return {
      "verify",
      "Checks each record: its certificate proves the answer, its id, margin and condition are right.",
      {
          {"sets", names.get(), "SET", "files, folders, or names of committed sets (default: all of these)"},
          {"--walk", walk.get(), "", "ask walk, too, where it can go"},
      },

      "The code that checks the certificates shares integers with the code that wrote them, but no search; "
      "data/check.py, which shares nothing with this program, does the same.\n"
      "Exit status 1: a record is refuted.\n"
      "Example:\n  lorentz golden verify ties grazing",
      [names, walk] { return run_golden_verify(*names, *walk); }};
}

}  // namespace lorentz::cli
