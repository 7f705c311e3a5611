// lorentz golden: sets of cases with their exact answers and proofs; lorentz golden list.
#include "cli/app.hpp"

#include <filesystem>

#include <lorentz/exchange.hpp>
#include "cli/output.hpp"
#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

int list(bool as_json) {
  report::Table table({"set", "precision", "records", "committed", "tags", "what"});
  table.with_prose();
  std::vector<std::string> json;
  for (const golden::Set& set : golden::sets()) {
    std::string committed = "-";
    std::uint64_t count = 0;
    for (const std::string& file : golden::committed_sets())
      if (fs::path(file).stem() == set.name)
        committed = std::to_string(count = golden::Reader(file).header().count);
    const bool endless = set.most > set.count;
    table.add({set.name, name_of(set.precision), endless ? "any" : std::to_string(set.most), committed,
               std::to_string(set.tags.size()), set.description});
    json.push_back(json::text_of([&](json::Members& one) {
      one.add("name", set.name, "committed", count, "description", set.description, "family", set.family,
              "precision", name_of(set.precision), "tags", [&](json::Members& tags) {
                for (const cases::Tag& tag : set.tags) tags.add_named(tag.name, tag.note);
              });
    }));
  }
  print(as_json ? json::line_of([&](json::Members& object) { object.add("sets", json::raw(json)); })
                : table.text());
  return kDone;
}

Command golden_list_command() {
  auto json = std::make_shared<bool>(false);
  return {"list",
          "The sets, and how many records of each are committed.",
          {
              {"--json", json.get(), "", "one JSON object, with all tags and what they are out to break"},
          },
          "Example:\n  lorentz golden list",
          [json] { return list(*json); }};
}

}  // namespace

Command golden_command() {
  return {
      "golden",
      "Golden sets: cases with their exact answers and the proofs of these. Make, check, verify, explain.",
      {},

      "Example:\n  lorentz golden check --engine reduction near-rational\n"
      "docs/formats.md has the format, docs/certificates.md the proofs, data/README.md the committed sets.",
      {},
      {golden_make_command(), golden_check_command(), golden_verify_command(), golden_explain_command(),
       golden_list_command()}};
}

}  // namespace lorentz::cli
