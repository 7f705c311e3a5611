#include "cli/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cases/families/target.hpp"
#include "cli/golden.hpp"
#include "cli/scene_option.hpp"
#include "compare/registry.hpp"
#include "golden/sets.hpp"

namespace lorentz::cli {
namespace {

struct Word {
  std::string text, meaning;
};

// What an option's value, or an argument, may be.
struct Values {
  std::vector<Word> words;
  bool or_file = false;
};

std::vector<Word> engines() {
  std::vector<Word> words;
  for (const std::string& name : compare::answerer_names()) words.push_back({name, "an engine"});
  return words;
}

std::vector<Word> scenes() {
  std::vector<Word> words;
  for (const CatalogueEntry& entry : catalogue()) words.push_back({entry.name, "a scene of the catalogue"});
  return words;
}

std::vector<Word> sets() {
  std::vector<Word> words;
  for (const golden::Set& set : golden::sets()) words.push_back({set.name, set.description});
  return words;
}

std::vector<Word> targets() {
  std::vector<Word> words;
  for (const cases::Target& target : cases::targets())
    words.push_back({std::string(target.name()), std::string(target.description())});
  return words;
}

// By the name that help gives to the value: ENGINE, FILE, .., or the values themselves, a|b|c.
Values values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == "ENGINE") return {engines()};
  if (type == "SCENE") return {scenes(), true};
  if (type == "SET") return {sets(), true};
  if (type == "TARGET") return {targets()};
  if (type == "FILE" || type == "FOLDER") return {{}, true};
  Values values;
  if (type.find('|') == std::string::npos) return values;
  for (const std::string& one : CLI::detail::split(type, '|')) values.words.push_back({one, ""});
  return values;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

bool is_hidden(const CLI::Option& option) {
  return option.get_group().empty();
}

// The line as far as it has been typed: whose it is, and what its last word belongs to.
struct Place {
  const CLI::App* app;
  const CLI::Option* option = nullptr;  // the last word is its value
  std::size_t arguments = 0;            // before the last word
  bool only_arguments = false;          // after --
};

const CLI::App* subcommand_called(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

void pass(Place& place, const std::string& word) {
  if (place.option) {
    if (word != "=") place.option = nullptr;  // bash makes three words of --engine=classical
  } else if (word == "--") {
    place.only_arguments = true;
  } else if (word.starts_with('-') && word.size() > 1 && !place.only_arguments) {
    const CLI::Option* option = place.app->get_option_no_throw(word);
    if (option && takes_value(*option)) place.option = option;
  } else if (const CLI::App* command = subcommand_called(*place.app, word); command && place.arguments == 0) {
    place.app = command;
  } else {
    ++place.arguments;
  }
}

Values options_of(const CLI::App& app) {
  Values values;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      if (!is_hidden(*option)) values.words.push_back({"--" + name, option->get_description()});
  return values;
}

// A subcommand, or what the next argument may be; more arguments than there are belong to the last.
Values arguments_of(const Place& place) {
  Values values;
  if (place.arguments == 0)
    for (const CLI::App* command : place.app->get_subcommands({}))
      values.words.push_back({command->get_name(), command->get_description()});
  std::vector<const CLI::Option*> positionals;
  for (const CLI::Option* option : place.app->get_options())
    if (option->get_positional()) positionals.push_back(option);
  if (positionals.empty()) return values;
  const Values more = values_of(*positionals[std::min(place.arguments, positionals.size() - 1)]);
  values.words.insert(values.words.end(), more.words.begin(), more.words.end());
  values.or_file |= more.or_file;
  return values;
}

// What of the last word stays as it is: --engine= of an option with its value, classical, of a list.
std::string kept_part(const std::string& word, const Place& place, const CLI::Option* joined) {
  const std::size_t equals = joined ? word.find('=') + 1 : 0;
  const CLI::Option* option = joined ? joined : place.option;
  const bool is_list = option && option->get_expected_max() > 1;
  const std::size_t comma = is_list ? word.rfind(',') : std::string::npos;
  return word.substr(0, comma == std::string::npos ? equals : std::max(equals, comma + 1));
}

}  // namespace

std::string completions(const CLI::App& app, const std::vector<std::string>& words) {
  Place place{&app};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) pass(place, words[i]);
  std::string last = words.empty() ? "" : words.back();
  if (place.option && last == "=") last.clear();
  const CLI::Option* joined = nullptr;  // --engine=..
  if (!place.option && !place.only_arguments && last.starts_with("--"))
    if (const auto equals = last.find('='); equals != std::string::npos)
      joined = place.app->get_option_no_throw(last.substr(0, equals));
  const Values values = joined                                           ? values_of(*joined)
                        : place.option                                   ? values_of(*place.option)
                        : last.starts_with('-') && !place.only_arguments ? options_of(*place.app)
                                                                         : arguments_of(place);
  const std::string kept = kept_part(last, place, joined), typed = last.substr(kept.size());
  std::string text = values.or_file ? "files\n" : "words\n";
  for (const Word& word : values.words)
    if (word.text.starts_with(typed)) text += fmt::format("{}{}\t{}\n", kept, word.text, word.meaning);
  return text;
}

}  // namespace lorentz::cli
