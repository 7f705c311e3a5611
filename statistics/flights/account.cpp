#include "statistics/flights/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::flights {

// ---- ranges

bool Ranges::meets(std::uint64_t first, std::uint64_t last) const {
  const auto next = ranges_.upper_bound(last);  // the preceding range begins at `last` or before
  return next != ranges_.begin() && std::prev(next)->second >= first;
}

void Ranges::check_apart(std::uint64_t first, std::uint64_t last) const {
  if (last < first) throw std::invalid_argument("a range of blocks ends before it begins");
  if (meets(first, last)) throw std::invalid_argument(fmt::format("block {} is there twice", first));
}

void Ranges::insert(std::uint64_t first, std::uint64_t last) {
  check_apart(first, last);
  auto next = ranges_.upper_bound(last);
  if (next != ranges_.end() && next->first == last + 1) {
    last = next->second;
    next = ranges_.erase(next);
  }
  if (next != ranges_.begin() && std::prev(next)->second + 1 == first)
    std::prev(next)->second = last;
  else
    ranges_.emplace_hint(next, first, last);
}

void Ranges::add(const Ranges& other) {
  for (const auto& [first, last] : other.ranges_) check_apart(first, last);
  for (const auto& [first, last] : other.ranges_) insert(first, last);
}

std::uint64_t Ranges::size() const {
  std::uint64_t size = 0;
  for (const auto& [first, last] : ranges_) size += last - first + 1;
  return size;
}

// ---- the account

Account Account::begun(const FlightsPlan& plan) {
  return {{}, FlightTally(unit_exponent(plan.scene))};
}

void Account::add(const Account& other) {
  done.add(other.done);
  tally.add(other.tally);
}

namespace {

// A histogram as pairs of a bin and its count. Empty bins are omitted, because most bins are empty.
using Pairs = std::vector<std::array<json::Digits, 2>>;
Pairs pairs_of(const std::vector<std::uint64_t>& counts) {
  Pairs pairs;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) pairs.push_back({json::Digits{i}, json::Digits{counts[i]}});
  return pairs;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("is not an account of flights: " + what);
}

// Calls act(a, b) for the pairs [a,b] of an array.
template <class Act>
void for_each_pair(json::Array pairs, const Act& act) {
  json::each_element(pairs, [&](json::Value pair) {
    std::uint64_t members[2];
    std::size_t i = 0;
    json::each_element(pair.array(), [&](json::Value member) {
      const std::uint64_t number = member.natural();
      if (i < 2) members[i] = number;
      ++i;
    });
    if (i != 2) refuse("a bin, or a range, that is not two numbers");
    act(members[0], members[1]);
  });
}

void read_counts(json::Array pairs, std::vector<std::uint64_t>& counts) {
  for_each_pair(pairs, [&](std::uint64_t bin, std::uint64_t count) {
    if (bin >= counts.size() || counts[bin] != 0) refuse("a bin that does not exist, or comes twice");
    counts[bin] = count;
  });
}

ExactSum read_sum(json::Object& object, const char* key) {
  return ExactSum::of(object[key].text());
}

}  // namespace

std::string Account::text() const {
  Pairs blocks;
  for (const auto& [first, last] : done.all()) blocks.push_back({json::Digits{first}, json::Digits{last}});
  const auto digits = [](std::uint64_t n) { return json::Digits{n}; };
  const auto bits = [](double x) { return json::Digits{std::bit_cast<std::uint64_t>(x)}; };
  return json::text_of([&](json::Members& account) {
    account.add("blocks", blocks, "exponent", tally.bins.exponent(), "hits", digits(tally.hits), "never",
                digits(tally.never), "undecided", digits(tally.undecided), "inside", digits(tally.inside),
                "logarithms", digits(tally.logarithms), "shortest", bits(tally.shortest), "longest",
                bits(tally.longest), "time", tally.time.text(), "square", tally.square.text(), "log",
                tally.log.text(), "logarithmic", pairs_of(tally.bins.logarithmic), "linear",
                pairs_of(tally.bins.linear));
  });
}

Account Account::of(std::string_view text) {
  try {
    json::Document document;
    document.open(text);
    json::Object object = document.object();
    Account account;
    for_each_pair(object["blocks"].array(),
                  [&](std::uint64_t first, std::uint64_t last) { account.done.insert(first, last); });
    const std::int64_t exponent = object["exponent"].integer();
    if (exponent < -1000 || exponent > 900) refuse("its unit of time");
    FlightTally& tally = account.tally = FlightTally(static_cast<int>(exponent));
    tally.hits = object["hits"].natural();
    tally.never = object["never"].natural();
    tally.undecided = object["undecided"].natural();
    tally.inside = object["inside"].natural();
    tally.logarithms = object["logarithms"].natural();
    tally.shortest = std::bit_cast<double>(object["shortest"].natural());
    tally.longest = std::bit_cast<double>(object["longest"].natural());
    tally.time = read_sum(object, "time");
    tally.square = read_sum(object, "square");
    tally.log = read_sum(object, "log");
    read_counts(object["logarithmic"].array(), tally.bins.logarithmic);
    read_counts(object["linear"].array(), tally.bins.linear);
    return account;
  } catch (const json::Error& error) {
    refuse(error.what());
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

// ---- consistency of an account

namespace {

// The number of flights in the blocks. Refuses blocks that are not in the plan.
std::uint64_t flights_in(const Ranges& blocks, const FlightsPlan& plan) {
  if (blocks.all().empty()) return 0;
  if (blocks.all().rbegin()->second >= plan.blocks()) refuse("a block that the plan has not");
  const bool has_last = blocks.contains(plan.blocks() - 1);
  return blocks.size() * kBlock - (has_last ? plan.blocks() * kBlock - plan.count : 0);
}

// Whether no count is above n and their sum is n.
bool add_up_to(std::uint64_t n, const std::vector<std::uint64_t>& counts) {
  if (std::any_of(counts.begin(), counts.end(), [&](std::uint64_t count) { return count > n; })) return false;
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) == n;
}

// Whether the sum is possible for n numbers from `least` to `most`. Rounding preserves this order.
bool lies_between(const ExactSum& sum, std::uint64_t n, double least, double most) {
  const auto number = static_cast<double>(n);
  return n == 0 ? sum == ExactSum() : number * least <= sum.value() && sum.value() <= number * most;
}

double squared(double t) {
  return std::min(t * t, std::numeric_limits<double>::max());
}

// Whether the first and the last non-empty bin are those of the extremes.
bool has_extremes(const Bins& bins, double shortest, double longest) {
  Bins ends(bins.exponent());
  ends.count(shortest), ends.count(longest);
  for (const auto counts : {&Bins::logarithmic, &Bins::linear}) {
    const auto is_filled = [](std::uint64_t count) { return count != 0; };
    const auto &all = bins.*counts, &two = ends.*counts;
    if (std::find_if(all.begin(), all.end(), is_filled) - all.begin() !=
            std::find_if(two.begin(), two.end(), is_filled) - two.begin() ||
        std::find_if(all.rbegin(), all.rend(), is_filled) - all.rbegin() !=
            std::find_if(two.rbegin(), two.rend(), is_filled) - two.rbegin())
      return false;
  }
  return true;
}

// The slack is needed because the last digits of logarithms may differ between machines.
bool has_logarithms(const FlightTally& tally) {
  const double slack = 1e-9 * 745 * static_cast<double>(tally.logarithms);
  const double least = tally.shortest > 0 ? std::log(tally.shortest) : std::log(0x1p-1074);
  const double most = tally.longest > 0 ? std::log(tally.longest) : 0,
               n = static_cast<double>(tally.logarithms);
  if (tally.logarithms > tally.hits || (tally.shortest > 0 && tally.logarithms < tally.hits)) return false;
  return tally.logarithms == 0
             ? tally.log == ExactSum()
             : n * least - slack <= tally.log.value() && tally.log.value() <= n * most + slack;
}

}  // namespace

void Account::check(const FlightsPlan& plan) const {
  const FlightTally& t = tally;
  const std::uint64_t flights = flights_in(done, plan);
  if (t.bins.exponent() != unit_exponent(plan.scene)) refuse("its unit of time is not that of the scene");
  if (!add_up_to(flights, {t.hits, t.never, t.undecided}))
    refuse("outcomes that are not those of its blocks");
  if (t.inside / starts::Candidates::kMostAttempts > flights) refuse("more draws than a run makes");
  if (!add_up_to(t.hits, t.bins.logarithmic) || !add_up_to(t.hits, t.bins.linear))
    refuse("bins that do not add up to its hits");
  const FlightTally none;
  const bool has_times = t.hits == 0 ? t.shortest == none.shortest && t.longest == none.longest
                                     : t.shortest >= 0 && t.shortest <= t.longest && std::isfinite(t.longest);
  if (!has_times || (t.hits > 0 && !has_extremes(t.bins, t.shortest, t.longest)))
    refuse("times that are not in its bins");
  if (!lies_between(t.time, t.hits, t.shortest, t.longest) ||
      !lies_between(t.square, t.hits, squared(t.shortest), squared(t.longest)) || !has_logarithms(t))
    refuse("sums that its times exclude");
}

}  // namespace lorentz::flights
