#include "question/engines.hpp"

#include <fmt/format.h>

#include <filesystem>

#include <lorentz/engine.hpp>
#include <lorentz/exchange.hpp>
#include "question/command_engine.hpp"
#include "src/exchange/nearest_name.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {

namespace {

constexpr std::string_view kCommand = "cmd:", kLibrary = "lib:";

bool is_somebody_elses(std::string_view name) {
  return name.starts_with(kCommand) || name.starts_with(kLibrary);
}

}  // namespace

std::vector<std::string> own_names() {
  return names_of(own_engines());
}

const EngineInfo* own_engine(std::string_view name) {
  if (name == "certified-gpu") name = "gpu";
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

EngineInfo guest_engine(std::string name,
                        std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> make) {
  if (own_engine(name) || is_somebody_elses(name))
    throw InputError("an engine called " + json_quoted(name) + " is there already");
  return {std::move(name), {.together = 4096}, EngineInfo::Kind::guest, {}, std::move(make)};
}

}  // namespace lorentz::question
