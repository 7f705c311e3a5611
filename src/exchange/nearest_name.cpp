#include "src/exchange/nearest_name.hpp"

#include <algorithm>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>

namespace lorentz {
namespace {

// Optimal string alignment: rows of the table of distances between prefixes of the two.
std::size_t mistakes_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

std::string lower_case(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

}  // namespace

std::string nearest_name(std::string_view typed, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 100;  // a longer text is not a mistyped name
  std::string nearest;
  std::size_t fewest = typed.size() / 3 + 1;
  if (typed.size() > kLongest) return nearest;
  const std::string small = lower_case(typed);
  for (const std::string& name : names) {
    const std::size_t mistakes = mistakes_between(small, lower_case(name));
    if (mistakes >= fewest && !(nearest.empty() && mistakes == 1 && typed.size() >= 2)) continue;
    fewest = mistakes;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view typed, const std::vector<std::string>& names) {
  const std::string name = nearest_name(typed, names);
  return name.empty() || name == typed ? "" : " (did you mean " + name + "?)";
}

std::size_t index_of_name(const std::string& name, const std::vector<std::string>& names,
                          std::string_view what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
  throw InputError(std::string(what) + ": " + json_quoted(name) + " is not one of " + known +
                   did_you_mean(name, names));
}

std::vector<std::string> items_of(std::string_view list, std::string_view what,
                                  bool (*is_rest)(std::string_view)) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= list.size(); begin += items.back().size() + 1) {
    const std::string_view rest = list.substr(begin);
    items.emplace_back(is_rest && is_rest(rest) ? rest : rest.substr(0, rest.find(',')));
    if (!items.back().empty()) continue;
    throw InputError(std::string(what) + ": " +
                     (list.empty() ? "is empty" : "an item is empty in the list " + json_quoted(list)));
  }
  return items;
}

}  // namespace lorentz
