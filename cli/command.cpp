#include "cli/command.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

std::vector<std::string> names_with(const std::string& names, const std::string& dashes) {
  std::vector<std::string> result;
  for (const std::string& name : items_of(names, "an option"))
    if (name.starts_with(dashes) && !name.substr(dashes.size()).starts_with('-')) result.push_back(name);
  return result;
}

}  // namespace

std::vector<std::string> Option::long_names() const {
  return names_with(names, "--");
}

std::string Option::name() const {
  return is_argument() ? names : long_names().at(0);
}

bool Option::is_called(const std::string& word) const {
  const auto is_in = [&](const std::vector<std::string>& all) { return std::ranges::count(all, word) > 0; };
  return is_in(long_names()) || is_in(names_with(names, "-"));
}

std::string Option::default_text() const {
  if (traits & kToldDefault) return "";
  if (const auto* text = std::get_if<std::string*>(&target)) return **text;
  if (const auto* whole = std::get_if<Whole>(&target)) {
    const auto* to = std::get_if<std::uint64_t*>(&whole->to);
    return to ? fmt::format("{}", **to) : "";
  }
  const auto* many = std::get_if<std::vector<std::string>*>(&target);
  return many && !(*many)->empty() ? fmt::format("[{}]", fmt::join(**many, ",")) : "";
}

std::vector<std::string> Option::values() const {
  if (const auto* text = std::get_if<std::string*>(&target)) return {**text};
  if (const auto* some = std::get_if<std::optional<std::string>*>(&target))
    return *some && **some ? std::vector<std::string>{***some} : std::vector<std::string>{};
  const auto* many = std::get_if<std::vector<std::string>*>(&target);
  return many ? **many : std::vector<std::string>{};
}

std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

const Command* Command::called(const std::string& one) const {
  const auto found = std::ranges::find(commands, one, &Command::name);
  return found == commands.end() ? nullptr : &*found;
}

const Option* Command::option_called(const std::string& word) const {
  const auto found = std::ranges::find_if(options, [&](const Option& row) { return row.is_called(word); });
  return found == options.end() ? nullptr : &*found;
}

}  // namespace lorentz::cli
