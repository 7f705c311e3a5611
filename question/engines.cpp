#include "question/engines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <lorentz/certified.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/walk.hpp>
#include "question/batch_answerer.hpp"
#include "question/command_engine.hpp"
#include "question/library_program.hpp"
#include "question/precisions/precisions.hpp"
#include "src/exchange/nearest_name.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {

void add_detail(const Query& query, const Scene& scene, Answer& answer) {
  if (answer.outcome != Outcome::hit || !answer.time) return;
  if (flaw_of(Query{query.x, query.v, answer.obstacle}, scene)) return;
  const Detail detail = collision_detail(scene, query, answer);
  // No detail is added outside the range of binary64. The oracle has it.
  if (std::isfinite(detail.point[0] + detail.point[1] + detail.point[2] + detail.impact_parameter))
    answer.detail = detail;
}

namespace {

constexpr std::string_view kCommand = "cmd:", kLibrary = "lib:";

bool is_somebody_elses(std::string_view name) {
  return name.starts_with(kCommand) || name.starts_with(kLibrary);
}

double limit_of(const oracle::Request& request) {
  return request.max_time.value_or(std::numeric_limits<double>::infinity());
}

FirstHit first_hits_of(std::shared_ptr<const Engine> engine, const Scene& scene) {
  return [engine, scene](const Query& query, const oracle::Request& request, Answer& answer) {
    engine->first_hit(query, limit_of(request), answer);
    if (request.detail) add_detail(query, scene, answer);
  };
}

FirstHit ask_certified(const Scene& scene) {
  auto certified = std::make_shared<oracle::Certified>(scene);
  return [certified](const Query& query, const oracle::Request& request, Answer& answer) {
    certified->first_hit(query, request, answer);
  };
}

FirstHit ask_oracle(const Scene& scene) {
  auto truth = std::make_shared<oracle::Oracle>(scene);
  return [truth](const Query& query, const oracle::Request& request, Answer& answer) {
    answer = truth->first_hit(query, request);
  };
}

FirstHit ask_walk(const Scene& scene) {
  auto walk = std::make_shared<oracle::Walk>(scene);
  return [walk, scene](const Query& query, const oracle::Request& request, Answer& answer) {
    answer = walk->first_hit(query, limit_of(request));
    if (request.detail) add_detail(query, scene, answer);
  };
}

// The answerer of an engine that is asked one query at a time.
class SingleAnswerer final : public Answerer {
 public:
  SingleAnswerer(std::function<FirstHit(const Scene&)> make, const oracle::Request& request)
      : make_(std::move(make)), request_(request) {}
  void ask(const Id&, const Query& query) override {
    first_hit_(query, request_, reply_.answer);
    deliver(reply_);
  }

 private:
  void enter(const Scene& scene) override { first_hit_ = make_(scene); }

  const std::function<FirstHit(const Scene&)> make_;
  const oracle::Request request_;
  FirstHit first_hit_;
  Reply reply_;
};

EngineInfo one_at_a_time(std::string name, const Traits& traits,
                         std::function<FirstHit(const Scene&)> first_hit) {
  EngineInfo engine{std::move(name), traits, EngineInfo::Kind::own, first_hit, {}};
  engine.answerer = [first_hit](const AnswererOptions& options) {
    return std::make_unique<SingleAnswerer>(first_hit, options.request);
  };
  return engine;
}

EngineInfo in_bulk(std::string name, Traits traits, std::function<FirstHit(const Scene&)> first_hit) {
  traits.in_bulk = true;
  EngineInfo engine{std::move(name), traits, EngineInfo::Kind::own, std::move(first_hit), {}};
  engine.answerer = [certified = traits.is_exact](const AnswererOptions& options) {
    return std::make_unique<BatchAnswerer>(certified, options);
  };
  return engine;
}

// An engine of the fast library.
EngineInfo fast(const std::string& name, const Traits& traits = {}) {
  return one_at_a_time(name, traits,
                       [name](const Scene& scene) { return first_hits_of(make_engine(name, scene), scene); });
}

// The engines of the fast library have their table in src/engines/make_engine.cpp.
std::vector<EngineInfo> table() {
  const Traits of_reduction{.leaves_undecided = true, .uses_reduction = true};
  std::vector<EngineInfo> all;
  for (const std::string& name : engine_names())
    all.push_back(fast(name, name == "reduction" ? of_reduction : Traits()));
  all.push_back(one_at_a_time("certified", {.is_exact = true, .uses_reduction = true}, ask_certified));
  all.push_back(in_bulk("batch", of_reduction, fast("reduction").first_hit));
  all.push_back(in_bulk("certified-batch", {.is_exact = true, .uses_reduction = true}, ask_certified));
  all.push_back(one_at_a_time("oracle", {.is_exact = true, .knows_digits = true}, ask_oracle));
  all.push_back(one_at_a_time("walk", {.is_exact = true}, ask_walk));
  for (const std::string& name : precision_names())
    all.push_back(one_at_a_time(
        name, {}, [name](const Scene& scene) { return first_hits_of(make_precision(name, scene), scene); }));
  return all;
}

}  // namespace

const std::vector<EngineInfo>& own_engines() {
  static const std::vector<EngineInfo> all = table();
  return all;
}

std::vector<std::string> own_names() {
  return names_of(own_engines());
}

std::string names_for_help() {
  return fmt::format(
      "{}, cmd:COMMAND (an external program), lib:FILE.so (a shared library); docs/command_engines.md",
      fmt::join(own_names(), ", "));
}

const EngineInfo* own_engine(std::string_view name) {
  for (const EngineInfo& engine : own_engines())
    if (engine.name == name) return &engine;
  return nullptr;
}

namespace {

// The name of an engine whose introduction is bad is put in front of the message.
template <class Read>
std::optional<Introduction> read_of(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(name + " says of itself: " + error.what());
  }
}

EngineInfo command_named(const std::string& name, double seconds) {
  const std::string command = name.substr(kCommand.size());
  if (command.find_first_not_of(" \t\n") == std::string::npos)
    throw InputError("cmd: needs the command that runs the engine behind it");
  EngineInfo engine{name, {}, EngineInfo::Kind::command};
  engine.answerer = [command](const AnswererOptions& options) { return command_engine(command, options); };
  engine.introduce = [name, command, seconds] {
    return read_of(name, [&] { return introduction_of_command(command, seconds); });
  };
  return engine;
}

// Loads the library, so that one that cannot be loaded is refused before anything is asked.
std::string claim_line_of_library(const std::string& name, const std::string& file, double seconds) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw FileError(name + ": there is no such file; lib: is followed by the path of a shared library");
  const FirstWords said = first_words_of(library_program(file, 1, false), seconds);
  if (!said.line)
    throw FileError(
        fmt::format("{}: {} while it was loaded; mend what it does before its first call", name, said.fate));
  if (!said.line->starts_with(R"({"id":null,)")) return *said.line;
  const std::string padded = *said.line + std::string(LineReader::kPadding, ' ');
  Id id;
  Answer refusal;
  std::size_t components = 0;
  ExchangeReader().read_answer_line({std::string_view(padded).substr(0, said.line->size())}, id, refusal,
                                    components);
  throw FileError(fmt::format("{}: {}", name, printable(refusal.message)));
}

EngineInfo library_named(const std::string& name, double seconds) {
  const std::string file = name.substr(kLibrary.size());
  if (file.empty()) throw InputError("lib: needs the path of a shared library behind it");
  const std::string claim = claim_line_of_library(name, file, seconds);
  EngineInfo engine{name, {}, EngineInfo::Kind::library};
  engine.answerer = [file](const AnswererOptions& options) { return library_engine(file, options); };
  engine.introduce = [name, claim] { return read_of(name, [&] { return introduction_in(claim); }); };
  return engine;
}

}  // namespace

EngineInfo engine_named(const std::string& name, std::optional<double> timeout) {
  const double seconds = timeout.value_or(AnswererOptions::kDefaultTimeout);
  if (const EngineInfo* own = own_engine(name)) return *own;
  if (name.starts_with(kCommand)) return command_named(name, seconds);
  if (name.starts_with(kLibrary)) return library_named(name, seconds);
  const std::vector<std::string> names = own_names();
  throw InputError(
      fmt::format("no engine is called {}{}; there are {}, cmd:COMMAND for an external program, and "
                  "lib:FILE.so for a shared library",
                  json_quoted(name), did_you_mean(name, names), fmt::join(names, ", ")));
}

std::vector<EngineInfo> engines_named(const std::vector<std::string>& arguments,
                                      std::optional<double> timeout) {
  std::vector<EngineInfo> named;
  for (const std::string& argument : arguments)
    for (const std::string& name : items_of(argument, "--engine", is_somebody_elses))
      named.push_back(engine_named(name, timeout));
  return named;
}

std::vector<std::string> names_of(const std::vector<EngineInfo>& engines) {
  std::vector<std::string> names;
  for (const EngineInfo& engine : engines) names.push_back(engine.name);
  return names;
}

Truth truth_named(const std::string& name, const std::vector<EngineInfo>& judged) {
  if (index_of_name(name, {"oracle", "certified"}, "--judge") == 0) return Truth::oracle;
  for (const EngineInfo& engine : judged)
    if (engine.traits.uses_reduction)
      throw InputError(fmt::format(
          "--judge: certified rests on reduction, and cannot judge the engine {}; use oracle", engine.name));
  return Truth::certified;
}

EngineInfo guest_engine(std::string name,
                        std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> make) {
  if (own_engine(name) || is_somebody_elses(name))
    throw InputError("an engine called " + json_quoted(name) + " is there already");
  return {std::move(name), {.in_bulk = true}, EngineInfo::Kind::guest, {}, std::move(make)};
}

}  // namespace lorentz::question
