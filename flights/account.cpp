#include "flights/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz::flights {

// ---- ranges

namespace {

using Pairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

// In order, neighbours joined.
Pairs joined(Pairs ranges) {
  std::sort(ranges.begin(), ranges.end());
  Pairs joined;
  for (const auto& [first, last] : ranges) {
    if (!joined.empty() && first <= joined.back().second)
      throw std::invalid_argument(fmt::format("block {} is there twice", first));
    if (!joined.empty() && first == joined.back().second + 1)
      joined.back().second = last;
    else
      joined.emplace_back(first, last);
  }
  return joined;
}

}  // namespace

void Ranges::insert(std::uint64_t number) {
  Ranges one;
  one.ranges_ = {{number, number}};
  add(one);
}

void Ranges::add(const Ranges& other) {
  Pairs all = ranges_;
  all.insert(all.end(), other.ranges_.begin(), other.ranges_.end());
  ranges_ = joined(std::move(all));
}

bool Ranges::contains(std::uint64_t number) const {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](const auto& range) { return range.first <= number && number <= range.second; });
}

std::uint64_t Ranges::size() const {
  std::uint64_t size = 0;
  for (const auto& [first, last] : ranges_) size += last - first + 1;
  return size;
}

void Ranges::append(std::uint64_t first, std::uint64_t last) {
  if (last < first || (!ranges_.empty() && first <= ranges_.back().second))
    throw std::invalid_argument("ranges of blocks are not in order");
  Pairs all = ranges_;
  all.emplace_back(first, last);
  ranges_ = joined(std::move(all));
}

// ---- the account

void Account::add(const Account& other) {
  if (plan != other.plan) throw std::invalid_argument("they are not parts of one run");
  done.add(other.done);
  tally.add(other.tally);
}

namespace {

// A histogram as pairs of a bin and its count; most are empty.
std::string text_of(const std::vector<std::uint64_t>& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) text += fmt::format("{}[{},{}]", text.empty() ? "" : ",", i, counts[i]);
  return text;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("no account of flights: " + what);
}

void read_counts(json::array pairs, std::vector<std::uint64_t>& counts) {
  for (json::array pair : pairs) {
    std::uint64_t members[2];
    std::size_t i = 0;
    for (std::uint64_t member : pair) {
      if (i == 2) refuse("a bin is a number and a count");
      members[i++] = member;
    }
    if (i != 2 || members[0] >= counts.size()) refuse("a bin that there is not");
    counts[members[0]] = members[1];
  }
}

void read_ranges(json::array pairs, Ranges& ranges) {
  for (json::array pair : pairs) {
    std::vector<std::uint64_t> members;
    for (std::uint64_t member : pair) members.push_back(member);
    if (members.size() != 2) refuse("a range of blocks is two numbers");
    ranges.append(members[0], members[1]);
  }
}

ExactSum read_sum(json::object& object, const char* key) {
  return ExactSum::of(std::string_view(object[key]));
}

}  // namespace

std::string Account::text() const {
  std::string ranges;
  for (const auto& [first, last] : done.all())
    ranges += fmt::format("{}[{},{}]", ranges.empty() ? "" : ",", first, last);
  return fmt::format(
      "{{\"flights\":1,\"plan\":{},\"blocks\":[{}],\"exponent\":{},\"hits\":{},\"never\":{},\"undecided\":{},"
      "\"inside\":{},\"logarithms\":{},\"shortest\":{},\"longest\":{},\"time\":\"{}\","
      "\"square\":\"{}\",\"log\":\"{}\",\"logarithmic\":[{}],\"linear\":[{}]}}\n",
      json_quoted(plan), ranges, tally.bins.exponent(), tally.hits, tally.never, tally.undecided,
      tally.inside, tally.logarithms, std::bit_cast<std::uint64_t>(tally.shortest),
      std::bit_cast<std::uint64_t>(tally.longest), tally.time.text(), tally.square.text(), tally.log.text(),
      text_of(tally.bins.logarithmic), text_of(tally.bins.linear));
}

Account Account::of(std::string_view text) {
  try {
    const simdjson::padded_string padded(text);
    json::parser parser;
    json::document document = parser.iterate(padded);
    json::object object = document.get_object();
    if (std::uint64_t(object["flights"]) != 1) refuse("of another version");
    Account account;
    account.plan = std::string(std::string_view(object["plan"]));
    read_ranges(object["blocks"].get_array(), account.done);
    const auto exponent = std::int64_t(object["exponent"]);
    if (exponent < -1000 || exponent > 900) refuse("its unit of time");
    Tally& tally = account.tally = Tally(static_cast<int>(exponent));
    tally.hits = object["hits"], tally.never = object["never"], tally.undecided = object["undecided"];
    tally.inside = object["inside"], tally.logarithms = object["logarithms"];
    tally.shortest = std::bit_cast<double>(std::uint64_t(object["shortest"]));
    tally.longest = std::bit_cast<double>(std::uint64_t(object["longest"]));
    tally.time = read_sum(object, "time");
    tally.square = read_sum(object, "square");
    tally.log = read_sum(object, "log");
    read_counts(object["logarithmic"].get_array(), tally.bins.logarithmic);
    read_counts(object["linear"].get_array(), tally.bins.linear);
    return account;
  } catch (const simdjson::simdjson_error&) {  // what that says means nothing to who named the file
    refuse("it is of another kind, or was cut off; name another file, or delete it");
  } catch (const std::logic_error& error) {
    refuse(error.what());
  }
}

}  // namespace lorentz::flights
