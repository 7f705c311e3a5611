// lorentz compare: engines, and answers logged elsewhere, against the oracle.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include "app.hpp"
#include "draw.hpp"
#include "exchange.hpp"
#include "exit_status.hpp"
#include "measure.hpp"
#include "messages.hpp"
#include "numbers.hpp"
#include "query_stream.hpp"
#include "scene_option.hpp"

namespace lorentz::cli {
namespace {

struct Options {
  std::vector<std::string> engines, answers;
  std::optional<std::string> scene, radius, queries, disagreements;
  std::string count = "10000", seed = std::to_string(kDefaultSeed);
  bool json = false, strict = false, no_oracle = false;
};

// The wrong answers, as a query stream that can be run again: scene lines, and queries with `engine`,
// `expected` and `given` beside what they ask.
class DisagreementFile {
 public:
  DisagreementFile(const std::optional<std::string>& path, const CaseSet& set) : set_(set) {
    if (!path) return;
    path_ = *path;
    file_ = std::fopen(path_.c_str(), "w");
    if (!file_) throw FileError(path_ + ": " + std::strerror(errno));
    if (!set_.scenes.empty()) write_scene(0);  // so that it is a stream even if nothing disagrees
  }
  ~DisagreementFile() {
    if (file_) std::fclose(file_);
  }
  DisagreementFile(const DisagreementFile&) = delete;
  DisagreementFile& operator=(const DisagreementFile&) = delete;

  void add(const Case& one, const Answer& exact, const std::string& name, const Answer& given) {
    if (!file_) return;
    if (one.scene != scene_) write_scene(one.scene);
    const int dimension = set_.scenes[one.scene].dimension;
    std::string out;
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
  void write_scene(std::size_t scene) {
    std::string out;
    append_scene_line(out, set_.scenes[scene]);
    std::fputs(out.c_str(), file_);
    scene_ = scene;
  }

  std::string path_;
  const CaseSet& set_;
  std::FILE* file_ = nullptr;
  std::size_t scene_ = 0;
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

CaseSet draw_cases(const Scene& scene, std::uint64_t seed, std::size_t count) {
  CaseSet set;
  set.scenes.push_back(scene);
  const auto queries = draw_queries(scene, oracle::Oracle(scene), seed, count);
  for (std::size_t i = 0; i < queries.size(); ++i) set.cases.push_back({std::to_string(i), 0, queries[i]});
  return set;
}

using Answers = std::unordered_map<Id, Answer>;

// A logged answer stream, by id. Bad lines and ids that come twice are complained of; answers without an id
// (to lines that were no queries) are passed over.
Answers read_answers(const std::string& path, bool& bad_input) {
  Answers answers;
  LineReader lines(path);
  ExchangeReader reader;
  Id id;
  Answer answer;
  bool empty = true;
  for (LineReader::Line line; lines.next(line);) {
    try {
      if (!reader.read_answer_line(line, id, answer)) continue;
      empty = false;
      if (id != "null" && !answers.emplace(id, answer).second)
        throw InputError("the id " + id + " came before; an answer stream has one answer a query");
    } catch (const InputError& error) {
      empty = false;
      bad_input = true;
      say("{}:{}: {}", path, line.number, error.what());
    }
  }
  if (empty) {
    bad_input = true;
    say("{}: is empty: no answer in it", path);
  }
  return answers;
}

// Answers are matched by id, so the queries' must be unique, and the answers' must be among them.
void check_ids(const CaseSet& set, bool& bad_input) {
  std::unordered_set<Id> ids;
  for (const Case& one : set.cases)
    if (one.id != "null" && !ids.insert(one.id).second) {
      bad_input = true;
      say("the query id {} comes twice: answers cannot be matched to its queries", one.id);
    }
}

Tally judge_logged(const std::string& name, const Answers& answers, const CaseSet& set,
                   const std::vector<Answer>& exact, const OnWrong& on_wrong) {
  Tally tally;
  tally.name = name;
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const auto found = answers.find(set.cases[i].id);
    const bool given = found != answers.end();
    const oracle::Judgement judgement = given ? oracle::judge(exact[i], found->second) : oracle::Judgement{};
    tally.count(judgement);
    if (judgement.verdict == oracle::Verdict::wrong) on_wrong(set.cases[i], exact[i], name, found->second);
  }
  return tally;
}

// Says what did not match; nothing matched at all is bad input, the wrong file most likely.
void check_matches(const std::string& file, const Tally& tally, std::size_t answers, bool& bad_input) {
  const std::size_t matched = tally.queries - tally.missing;
  if (answers > matched) say("{}: {} answers have an id that no query has", file, answers - matched);
  if (matched == 0 && answers > 0) {
    bad_input = true;
    say("{}: no answer matches any query; is it the right file?", file);
  }
}

std::string json_of(const std::string& scene, const std::string& seed, const std::vector<Tally>& tallies,
                    bool judged) {
  std::string out = fmt::format("{{\"scene\":{},\"seed\":{},\"engines\":[", json_quoted(scene), seed);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const Tally& t = tallies[i];
    const auto count = [&](std::size_t n) { return judged ? std::to_string(n) : std::string("null"); };
    out += fmt::format(
        "{}{{\"engine\":{},\"queries\":{},\"agree\":{},\"ill_posed\":{},\"wrong\":{},\"undecided\":{},"
        "\"unsupported\":{},"
        "\"error\":{},\"missing\":{},\"max_ulp\":",
        i ? "," : "", json_quoted(t.name), t.queries, count(t.agree), count(0), count(t.wrong),
        count(t.undecided), count(t.unsupported), count(t.error), count(t.missing));
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

struct Logged {
  std::string name, file;
};

std::vector<Logged> logged_answers(const Options& options) {
  std::vector<Logged> all;
  for (const std::string& argument : options.answers) {
    const auto equals = argument.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size())
      throw InputError("--answers: " + json_quoted(argument) + " is not NAME=FILE");
    all.push_back({argument.substr(0, equals), argument.substr(equals + 1)});
  }
  return all;
}

// The scene's name for the heading; the number of scenes if a file has several.
std::string title(const Options& options, const CaseSet& set) {
  if (set.scenes.size() > 1) return fmt::format("{} scenes", set.scenes.size());
  const std::string name = options.scene.value_or(options.queries.value_or("square"));
  return options.radius ? fmt::format("{} (radius {})", name, *options.radius) : name;
}

int exit_status(const std::vector<Tally>& tallies, bool strict) {
  for (const Tally& t : tallies)
    if (t.wrong > 0 || (strict && t.undecided > 0)) return kDisagreement;
  return kDone;
}

int act(const Options& options) {
  const std::vector<Logged> logged = logged_answers(options);
  std::vector<std::string> engines = options.engines;
  if (engines.empty() && logged.empty()) engines = {"classical", "published"};
  for (const std::string& name : engines) check_name(name);
  if (options.no_oracle && !logged.empty())
    throw InputError("--answers needs the oracle; leave --no-oracle out");
  const std::uint64_t seed = whole_number(options.seed, "--seed", 0, ~std::uint64_t{0});
  const std::uint64_t count = whole_number(options.count, "--count", 0, 1'000'000'000);
  const std::optional<double> radius = positive_number(options.radius, "--radius");

  bool bad_input = false;
  std::optional<Scene> scene;
  const bool drawn = !options.queries;
  if (options.scene || drawn)
    scene = load_scene(options.scene.value_or("square"), radius);
  else if (radius)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  const CaseSet set =
      drawn ? draw_cases(*scene, seed, count) : read_cases(*options.queries, scene, bad_input);
  if (!logged.empty()) check_ids(set, bad_input);

  DisagreementFile disagreements(options.disagreements, set);
  const OnWrong on_wrong = [&](const Case& one, const Answer& exact, const std::string& name,
                               const Answer& given) { disagreements.add(one, exact, name, given); };
  const std::vector<Answer> exact = options.no_oracle ? std::vector<Answer>{} : exact_answers(set);
  std::vector<Tally> tallies = measure(set, exact, engines, on_wrong);
  for (const auto& [name, file] : logged) {
    const Answers answers = read_answers(file, bad_input);
    tallies.push_back(judge_logged(name, answers, set, exact, on_wrong));
    check_matches(file, tallies.back(), answers.size(), bad_input);
  }
  disagreements.close();

  if (options.json) {
    print(json_of(title(options, set),
                  seed <= 1ull << 53 ? std::to_string(seed) : json_quoted(std::to_string(seed)), tallies,
                  !options.no_oracle));
  } else {
    print(fmt::format("{}: {} {} queries{}\n\n{}", title(options, set), set.cases.size(),
                      drawn ? "drawn" : "given", drawn ? fmt::format(", seed {}", seed) : "",
                      table_of(tallies, !options.no_oracle)));
  }
  return bad_input ? kBadInput : exit_status(tallies, options.strict);
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
  command->add_option("--radius", options->radius, "radius of every ball of --scene")->type_name("R");
  CLI::Option* queries = command->add_option(
      "--queries", options->queries, "query stream (NDJSON) instead of drawn queries; - is standard input");
  command->add_option("--count", options->count, "how many queries to draw")
      ->capture_default_str()
      ->type_name("N")
      ->excludes(queries);
  command->add_option("--seed", options->seed, "of the drawn queries")->capture_default_str()->type_name("N");
  command
      ->add_option("--disagreements", options->disagreements,
                   "write each wrong answer there, as a query stream")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "one JSON object instead of a table");
  command->add_flag("--strict", options->strict, "exit status 1 also for undecided answers");
  command->add_flag("--no-oracle", options->no_oracle, "only take times, judge nothing");
  command->footer(
      "Errors of t are in ulps from the correctly rounded time. Times are of the engine alone, on one thread."
      "\nExample:\n  lorentz compare --scene cubic --radius 0.2 --count 20000 --engine published,classical");
  command->callback([options, &action] { action = [options] { return act(*options); }; });
}

}  // namespace lorentz::cli
