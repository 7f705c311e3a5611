#include "cli/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "fuzz/families/family.hpp"
#include "judge/golden/sets.hpp"
#include "question/engines.hpp"
#include "report/files/scene_file.hpp"

namespace lorentz::cli {
namespace {

struct Word {
  std::string text, meaning;
};

// The possible values of an option or an argument.
struct Values {
  std::vector<Word> words;
  bool or_file = false;
};

// Chosen by the value's name in help: ENGINE, FILE, .., or the values themselves, a|b|c.
Values values_of(const Option& option) {
  const std::string& type = option.type;
  Values values{{}, type == "SCENE" || type == "SET" || type == "FILE" || type == "FOLDER"};
  const auto add = [&](std::string_view text, std::string_view meaning) {
    values.words.push_back({std::string(text), std::string(meaning)});
  };
  if (type == "ENGINE")
    for (const std::string& name : question::own_names()) add(name, "an engine");
  if (type == "SCENE")
    for (const auto& [name, file] : catalogue()) add(name, "a scene of the catalogue");
  if (type == "SET")
    for (const golden::Set& set : golden::sets())
      if (set.is_committed) add(set.name, set.description);
  if (type == "TARGET")
    for (const cases::Target& target : cases::targets()) add(target.name(), target.description());
  std::istringstream words(type.find('|') == std::string::npos ? "" : type);
  for (std::string one; std::getline(words, one, '|');) add(one, "");
  return values;
}

// The position in the typed line: the command, and the option to which the last word belongs.
struct Cursor {
  const Command* command;
  const Option* option = nullptr;  // the last word is its value
  std::size_t arguments = 0;       // before the last word
  bool only_arguments = false;     // after --
};

void pass(Cursor& place, const std::string& word) {
  if (place.option) {
    if (word != "=") place.option = nullptr;  // bash makes three words of --engine=classical
  } else if (word == "--") {
    place.only_arguments = true;
  } else if (word.starts_with('-') && word.size() > 1 && !place.only_arguments) {
    const Option* option = place.command->option_called(word);
    if (option && option->takes_value()) place.option = option;
  } else if (const Command* command = place.command->called(word); command && place.arguments == 0) {
    place.command = command;
  } else {
    ++place.arguments;
  }
}

Values options_of(const Command& command) {
  Values values;
  for (const Option& option : command.options)
    for (const std::string& name : option.long_names())
      if (!option.is_hidden()) values.words.push_back({name, option.help});
  return values;
}

// Subcommands, or the values of the next argument. Surplus arguments belong to the last argument.
Values arguments_of(const Cursor& place) {
  Values values;
  if (place.arguments == 0)
    for (const Command& command : place.command->commands)
      values.words.push_back({command.name, command.description});
  std::vector<const Option*> arguments;
  for (const Option& option : place.command->options)
    if (option.is_argument()) arguments.push_back(&option);
  if (arguments.empty()) return values;
  const Values more = values_of(*arguments[std::min(place.arguments, arguments.size() - 1)]);
  values.words.insert(values.words.end(), more.words.begin(), more.words.end());
  values.or_file |= more.or_file;
  return values;
}

// The part of the last word that stays unchanged: "--engine=" in an option with its value, "classical," in a
// list.
std::string kept_part(const std::string& word, const Cursor& place, const Option* joined) {
  const std::size_t equals = joined ? word.find('=') + 1 : 0;
  const Option* option = joined ? joined : place.option;
  const bool is_list = option && option->takes_many();
  const std::size_t comma = is_list ? word.rfind(',') : std::string::npos;
  return word.substr(0, comma == std::string::npos ? equals : std::max(equals, comma + 1));
}

}  // namespace

std::string completions(const Command& program, const std::vector<std::string>& words) {
  Cursor place{&program};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) pass(place, words[i]);
  std::string last = words.empty() ? "" : words.back();
  if (place.option && last == "=") last.clear();
  const Option* joined = nullptr;  // --engine=..
  if (!place.option && !place.only_arguments && last.starts_with("--"))
    if (const auto equals = last.find('='); equals != std::string::npos)
      joined = place.command->option_called(last.substr(0, equals));
  const Values values = joined                                           ? values_of(*joined)
                        : place.option                                   ? values_of(*place.option)
                        : last.starts_with('-') && !place.only_arguments ? options_of(*place.command)
                                                                         : arguments_of(place);
  const std::string kept = kept_part(last, place, joined), typed = last.substr(kept.size());
  std::string text = values.or_file ? "files\n" : "words\n";
  for (const Word& word : values.words)
    if (word.text.starts_with(typed)) text += fmt::format("{}{}\t{}\n", kept, word.text, word.meaning);
  return text;
}

}  // namespace lorentz::cli
