// lorentz compare: engines, and answers logged elsewhere, against the oracle.
#include <fmt/format.h>

#include <cstdio>
#include <unordered_map>

#include "app.hpp"
#include "draw.hpp"
#include "exchange.hpp"
#include "exit_status.hpp"
#include "measure.hpp"
#include "query_stream.hpp"
#include "scene_option.hpp"

namespace lorentz::cli {
namespace {

struct Options {
  std::vector<std::string> engines, answers;
  std::string scene, queries, disagreements;
  std::optional<double> radius;
  std::size_t count = 10'000;
  std::uint64_t seed = kDefaultSeed;
  bool json = false, strict = false, no_oracle = false;
};

// The wrong answers, as a query stream that can be run again: scene lines, and queries with `engine`,
// `expected` and `given` beside what they ask.
class DisagreementFile {
 public:
  DisagreementFile(const std::string& path, const CaseSet& set) : path_(path), set_(set) {
    if (path.empty()) return;
    file_ = std::fopen(path.c_str(), "w");
    if (!file_) throw FileError(path + ": cannot be written");
  }
  ~DisagreementFile() {
    if (file_) std::fclose(file_);
  }
  DisagreementFile(const DisagreementFile&) = delete;
  DisagreementFile& operator=(const DisagreementFile&) = delete;

  void add(const Case& one, const Answer& exact, const std::string& name, const Answer& given) {
    if (!file_) return;
    std::string out;
    if (one.scene != scene_) append_scene_line(out, set_.scenes[one.scene]);
    scene_ = one.scene;
    const int dimension = set_.scenes[one.scene].dimension;
    append_query_line(out, one.id, one.query, dimension);
    out.resize(out.size() - 2);  // "}\n": the object goes on
    out += ",\"engine\":" + json_quoted(name) + ",\"expected\":";
    append_answer_line(out, one.id, exact, dimension);
    out.back() = ',';
    out += "\"given\":";
    append_answer_line(out, one.id, given, dimension);
    out.back() = '}';
    std::fputs((out + '\n').c_str(), file_);
  }

  void close() {
    if (!file_) return;
    const bool failed = std::ferror(file_) != 0;
    const bool not_closed = std::fclose(file_) != 0;
    file_ = nullptr;
    if (failed || not_closed) throw FileError(path_ + ": writing failed");
  }

 private:
  std::string path_;
  const CaseSet& set_;
  std::FILE* file_ = nullptr;
  std::size_t scene_ = static_cast<std::size_t>(-1);
};

CaseSet read_cases(const std::string& path, std::optional<Scene> initial, bool& bad_input) {
  CaseSet set;
  if (initial) set.scenes.push_back(*initial);
  QueryStream stream(path, std::move(initial));
  for (StreamItem item; stream.next(item);) {
    if (item.kind == StreamItem::Kind::scene) set.scenes.push_back(item.scene);
    if (item.kind == StreamItem::Kind::query)
      set.cases.push_back({item.id, set.scenes.size() - 1, item.query});
  }
  bad_input |= stream.had_bad_input();
  return set;
}

CaseSet draw_cases(const Options& options, const Scene& scene) {
  CaseSet set;
  set.scenes.push_back(scene);
  const auto queries = draw_queries(scene, oracle::Oracle(scene), options.seed, options.count);
  for (std::size_t i = 0; i < queries.size(); ++i) set.cases.push_back({std::to_string(i), 0, queries[i]});
  return set;
}

// A logged answer stream, by id. Bad lines and ids that come twice are complained of.
std::unordered_map<Id, Answer> read_answers(const std::string& path, bool& bad_input) {
  std::unordered_map<Id, Answer> answers;
  LineReader lines(path);
  ExchangeReader reader;
  Id id;
  Answer answer;
  for (LineReader::Line line; lines.next(line);) {
    try {
      if (!reader.read_answer_line(line, id, answer)) continue;
      if (!answers.emplace(id, answer).second)
        throw InputError("the id " + id + " came before; an answer stream has one answer a query");
    } catch (const InputError& error) {
      bad_input = true;
      fmt::print(stderr, "lorentz: {}:{}: {}\n", path, line.number, error.what());
    }
  }
  if (lines.name().empty() || (answers.empty() && !bad_input)) {
    bad_input = true;
    fmt::print(stderr, "lorentz: {}: is empty: no answer in it\n", path);
  }
  return answers;
}

Tally judge_logged(const std::string& name, const std::unordered_map<Id, Answer>& answers, const CaseSet& set,
                   const std::vector<Answer>& exact, const OnWrong& on_wrong) {
  Tally tally;
  tally.name = name;
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const auto found = answers.find(set.cases[i].id);
    const bool given = found != answers.end() && set.cases[i].id != "null";
    const oracle::Judgement judgement = given ? oracle::judge(exact[i], found->second) : oracle::Judgement{};
    tally.count(judgement);
    if (judgement.verdict == oracle::Verdict::wrong) on_wrong(set.cases[i], exact[i], name, found->second);
  }
  return tally;
}

std::string json_of(const std::string& scene, const Options& options, const std::vector<Tally>& tallies) {
  std::string out = fmt::format("{{\"scene\":{},\"seed\":{},\"engines\":[", json_quoted(scene), options.seed);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const Tally& t = tallies[i];
    out += fmt::format(
        "{}{{\"engine\":{},\"queries\":{},\"agree\":{},\"ill_posed\":0,\"wrong\":{},\"undecided\":{},"
        "\"unsupported\":{},"
        "\"error\":{},\"missing\":{},\"max_ulp\":",
        i ? "," : "", json_quoted(t.name), t.queries, t.agree, t.wrong, t.undecided, t.unsupported, t.error,
        t.missing);
    append_number(out, t.max_ulp);
    out += ",\"mean_ulp\":";
    append_number(out, t.mean_ulp());
    out += ",\"ns_per_query\":";
    append_number(out, t.ns_per_query);
    out += ",\"ns_median\":";
    append_number(out, t.ns_median);
    out += '}';
  }
  return out + "]}\n";
}

std::pair<std::string, std::string> name_and_file(const std::string& argument) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("--answers: " + json_quoted(argument) + " is not NAME=FILE");
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

// The scene's name for the heading; the number of scenes if a file has several.
std::string title(const Options& options, const CaseSet& set) {
  if (set.scenes.size() > 1) return fmt::format("{} scenes", set.scenes.size());
  const std::string name =
      options.scene.empty() ? (options.queries.empty() ? "square" : options.queries) : options.scene;
  return options.radius ? fmt::format("{} (radius {})", name, *options.radius) : name;
}

int act(const Options& options) {
  std::vector<std::string> engines = options.engines;
  if (engines.empty() && options.answers.empty()) engines = {"classical", "published"};
  for (const std::string& name : engines) check_name(name);
  if (options.no_oracle && !options.answers.empty())
    throw InputError("--answers needs the oracle; leave --no-oracle out");

  bool bad_input = false;
  std::optional<Scene> scene;
  const bool drawn = options.queries.empty();
  if (!options.scene.empty() || drawn)
    scene = load_scene(options.scene.empty() ? "square" : options.scene, options.radius);
  else if (options.radius)
    throw InputError("--radius: needs --scene");
  const CaseSet set = drawn ? draw_cases(options, *scene) : read_cases(options.queries, scene, bad_input);

  DisagreementFile disagreements(options.disagreements, set);
  const OnWrong on_wrong = [&](const Case& one, const Answer& exact, const std::string& name,
                               const Answer& given) { disagreements.add(one, exact, name, given); };
  const std::vector<Answer> exact = options.no_oracle ? std::vector<Answer>{} : exact_answers(set);
  std::vector<Tally> tallies = measure(set, exact, engines, on_wrong);
  for (const std::string& argument : options.answers) {
    const auto [name, file] = name_and_file(argument);
    tallies.push_back(judge_logged(name, read_answers(file, bad_input), set, exact, on_wrong));
  }
  disagreements.close();

  if (options.json) {
    fmt::print("{}", json_of(title(options, set), options, tallies));
  } else {
    fmt::print("{}: {} {} queries{}\n\n{}", title(options, set), set.cases.size(), drawn ? "drawn" : "given",
               drawn ? fmt::format(", seed {}", options.seed) : "", table_of(tallies, !options.no_oracle));
  }
  if (bad_input) return kBadInput;
  for (const Tally& t : tallies)
    if (t.wrong > 0 || (options.strict && t.undecided > 0)) return kDisagreement;
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compare",
                                         "Engines, and answers that other programs logged, against the exact "
                                         "oracle: right or wrong, error, speed.");
  command
      ->add_option("-e,--engine", options->engines,
                   "classical, published, oracle, walk; several, or once each")
      ->delimiter(',')
      ->type_name("E");
  command
      ->add_option("--answers", options->answers,
                   "judge an answer stream that some program wrote, as an engine NAME")
      ->type_name("NAME=FILE");
  command->add_option("--scene", options->scene,
                      "a scene file, or a name of the catalogue (default: square)");
  command->add_option("--radius", options->radius, "radius of every ball of --scene");
  command->add_option("--queries", options->queries,
                      "query stream (NDJSON) instead of drawn queries; - is standard input");
  command->add_option("--count", options->count, "how many queries to draw")->capture_default_str();
  command->add_option("--seed", options->seed, "of the drawn queries")->capture_default_str();
  command->add_option("--disagreements", options->disagreements,
                      "write each wrong answer there, as a query stream");
  command->add_flag("--json", options->json, "one JSON object instead of a table");
  command->add_flag("--strict", options->strict, "exit status 1 also for undecided answers");
  command->add_flag("--no-oracle", options->no_oracle, "only take times, judge nothing");
  command->footer(
      "Errors of t are in ulps from the correctly rounded time. Times are of the engine alone, on one thread."
      "\nExample:\n  lorentz compare --scene cubic --radius 0.2 --count 20000 --engine published,classical");
  command->callback([options, &action] { action = [options] { return act(*options); }; });
}

}  // namespace lorentz::cli
