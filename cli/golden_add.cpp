// lorentz golden add: adds records of further queries to a set.
#include "cli/app.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/set_output.hpp"
#include "golden/find_sets.hpp"
#include "golden/selection.hpp"

namespace lorentz::cli {
namespace {

struct AddOptions {
  std::string set, output = "-";
  QuestionOptions questions;
  std::uint64_t jobs = 1;
};

bool is_any(const golden::Record& /*record*/) {
  return true;
}

// Adds records of the questions that the selection does not have. Returns how many were left out.
std::uint64_t add_records(golden::Selection& selection, golden::GivenQuestions given, std::uint64_t jobs) {
  std::erase_if(given.questions, [&](const golden::SetQuestion& question) {
    return selection.has(golden::id_of(golden::scene_line_of(question.scene), question.text));
  });
  if (given.questions.empty()) return 0;
  Progress progress("new records", given.questions.size(), 1);
  const MadeSet made = made_set(given, jobs, [&](std::uint64_t done) { progress.at(done); });
  golden::Reader records(made.text, "the new records");
  selection.add(records, is_any);
  report("new", made.counts);
  return made.counts.left_out;
}

int act(const AddOptions& options) {
  if (!options.questions.queries) throw InputError("--queries: name a file of queries (- is standard input)");
  std::optional<SetOutput> output;
  if (options.output != "-") output.emplace(options.output, "set");
  golden::Reader reader(golden::find_set(options.set));
  golden::Header header = reader.header();
  golden::Selection selection;
  selection.add(reader, is_any);
  const std::size_t before = selection.size();
  bool had_bad_input = false;
  golden::GivenQuestions given = options.questions.read(header, had_bad_input);
  const std::size_t asked = given.questions.size();
  const std::uint64_t left_out = add_records(selection, std::move(given), options.jobs);
  const std::size_t added = selection.size() - before;
  if (asked > added + left_out)
    say("{}: has {} of the questions already", reader.path(), asked - added - left_out);
  header.tags.clear();
  header.generator = command_line();
  header.version = LORENTZ_VERSION;
  const std::string text = selection.text(header);
  if (output)
    output->write([&] { return text; });
  else
    print(text);
  return had_bad_input ? kBadInput : left_out > 0 ? kDisagreement : kDone;
}

}  // namespace

Command golden_add_command() {
  auto options = std::make_shared<AddOptions>();
  return {"add", "A set, and records of more queries: those that it has already are not answered again.",
          joined(joined({{"set", &options->set, "SET", "a file, or the name of a committed set", kRequired}},
                        options->questions.rows()),
                 {{"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads"},
                  {"-o,--output", &options->output, "FILE", kSetOutputHelp, kOutput | kTakesStdout}}),
          "Example:\n  lorentz sample --scene square --kind grazing --count 20 | lorentz golden add ties "
          "--queries - --tag mine",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
