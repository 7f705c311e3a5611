#include "cli/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

double number(const std::string& text, const char* option) {
  try {
    return parse_number(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

double tolerance(const std::string& text, const char* option) {
  const double ulps = number_from_zero(text, option);
  if (ulps > oracle::kLargestMargin)
    throw InputError(fmt::format("{}: {} is above {}, up to which margins are known", option, ulps,
                                 oracle::kLargestMargin));
  return ulps;
}

}  // namespace

std::uint64_t whole_number(const std::string& text, const char* option, std::uint64_t least,
                           std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool good = status == std::errc{} && end == text.data() + text.size();
  if (!good && status != std::errc::result_out_of_range) {
    double real = -1;
    try {
      real = parse_number(text);
    } catch (const InputError&) {
    }
    if (real >= 0x1p53 && most >= std::uint64_t{1} << 53)
      throw InputError(
          fmt::format("{}: {} is 2^53 or more; write all its digits", option, json_quoted(text)));
    good = real >= 0 && real < 0x1p53 && real == std::floor(real);
    if (good) value = static_cast<std::uint64_t>(real);
  }
  if (!good || value < least || value > most)
    throw InputError(
        fmt::format("{}: {} is not a whole number from {} to {}", option, json_quoted(text), least, most));
  return value;
}

std::optional<double> positive_number(const std::optional<std::string>& text, const char* option) {
  if (!text) return std::nullopt;
  const double value = number(*text, option);
  if (!(value > 0)) throw InputError(fmt::format("{}: must be above zero", option));
  return value;
}

double number_from_zero(const std::string& text, const char* option) {
  const double value = number(text, option);
  if (!(value >= 0)) throw InputError(fmt::format("{}: must not be below zero", option));
  return value;
}

PictureSize picture_size(const std::string& text) {
  const auto pixels = [](const std::string& part) {
    return static_cast<double>(whole_number(part, "--size", 200, 20'000));
  };
  const auto cross = text.find('x');
  if (cross == std::string::npos) return {pixels(text), {}};
  return {pixels(text.substr(0, cross)), pixels(text.substr(cross + 1))};
}

std::vector<double> numbers_in(const std::string& list, const char* option) {
  std::vector<double> numbers;
  for (const std::string& item : items_of(list, option))
    numbers.push_back(number(item.substr(std::min(item.find_first_not_of(' '), item.size())), option));
  return numbers;
}

void take_number(const Option& option, const std::string& text) {
  const std::string name = option.name();
  if (const auto* whole = std::get_if<Whole>(&option.target))
    std::visit([&](auto* to) { *to = whole_number(text, name.c_str(), whole->least, whole->most); },
               whole->to);
  else if (const auto* positive = std::get_if<Positive>(&option.target))
    *positive->to = positive_number(text, name.c_str());
  else if (const auto* k = std::get_if<Tolerance>(&option.target))
    *k->to = tolerance(text, name.c_str());
}

void split_at_commas(const Option& option) {
  auto& values = *std::get<std::vector<std::string>*>(option.target);
  std::vector<std::string> all;
  for (const std::string& list : values)
    std::ranges::copy(items_of(list, option.name()), std::back_inserter(all));
  values = std::move(all);
}

}  // namespace lorentz::cli
