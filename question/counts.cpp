#include "question/counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lorentz::question {

static_assert(static_cast<int>(Count::missing) == static_cast<int>(oracle::Verdict::missing));

const CountName& name_of(Count count) {
  return *std::ranges::find(kCountNames, count, &CountName::count);
}

void Counts::add(const oracle::Judgement& judgement) {
  ++(*this)[static_cast<Count>(judgement.verdict)];
  (*this)[Count::wrong_time] += judgement.wrong_time;
  (*this)[Count::other_quantity] += judgement.other_quantity;
}

Counts& Counts::operator+=(const Counts& other) {
  for (std::size_t i = 0; i < number_.size(); ++i) number_[i] += other.number_[i];
  return *this;
}

std::size_t Counts::sum(std::initializer_list<Count> some) const {
  std::size_t sum = 0;
  for (const Count count : some) sum += (*this)[count];
  return sum;
}

std::size_t Counts::total() const {
  return std::accumulate(number_.begin(), number_.begin() + static_cast<int>(Count::missing) + 1,
                         std::size_t{0});
}

std::vector<CountName> names_counted(Counted by) {
  std::vector<CountName> names;
  for (const CountName& name : kCountNames)
    if (name.is_counted(by)) names.push_back(name);
  return names;
}

void add_counts(json::Members& object, const Counts& counts, Counted by, bool judged) {
  for (const CountName& name : names_counted(by))
    object.add_named(name.key, judged ? std::optional(counts[name.count]) : std::nullopt);
}

namespace {

// The names that are columns.
std::vector<CountName> columns_counted(Counted by) {
  std::vector<CountName> names = names_counted(by);
  std::erase_if(names, [](const CountName& name) { return name.is_counted(Counted::no_column); });
  return names;
}

}  // namespace

std::vector<std::string> titles_counted(Counted by, std::vector<std::string> before,
                                        const std::vector<std::string>& after) {
  for (const CountName& name : columns_counted(by)) before.emplace_back(name.words);
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

std::vector<std::string> cells_counted(const Counts& counts, Counted by, std::vector<std::string> before,
                                       const std::vector<std::string>& after, const CellText& text) {
  for (const CountName& name : columns_counted(by)) before.push_back(text(name.count, counts[name.count]));
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

std::string dash_for_none(Count, std::size_t number) {
  return number ? std::to_string(number) : "-";
}

std::string counted_text(const Counts& counts, std::initializer_list<Count> some) {
  std::string text;
  for (const Count count : some) {
    const CountName& name = name_of(count);
    const std::size_t number = counts[count];
    const std::string_view words = number == 1 || name.many.empty() ? name.words : name.many;
    if (number > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, words);
  }
  return text;
}

}  // namespace lorentz::question
