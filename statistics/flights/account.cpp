#include "statistics/flights/account.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

#include "src/exchange/json_piece.hpp"

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

static auto members_of(FlightTally& self) {
  return std::tie(self.hits, self.never, self.undecided, self.inside, self.time, self.square, self.log,
                  self.logarithms, self.shortest, self.longest, self.bins.logarithmic, self.bins.linear);
}

std::string Account::text() const {
  const int exponent = tally.bins.exponent();
  return json::piece_of(std::tie(exponent, done, tally));
}

Account Account::of(std::string_view text) {
  int exponent = 0;
  Account account;
  json::read_piece(text, std::tie(exponent, account.done, account.tally));
  Bins bins(exponent);
  bins.logarithmic = std::move(account.tally.bins.logarithmic);
  bins.linear = std::move(account.tally.bins.linear);
  account.tally.bins = std::move(bins);
  return account;
}

}  // namespace lorentz::flights
