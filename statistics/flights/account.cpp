#include "statistics/flights/account.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "src/exchange/json_piece.hpp"

namespace lorentz::flights {

Account Account::begun(const FlightsPlan& plan) {
  return {{}, FlightTally(unit_exponent(plan.scene))};
}

void Account::add(const Account& other) {
  if (const Blocks twice = done & other.done; !twice.empty())
    throw std::invalid_argument(fmt::format("block {} is there twice", first(twice)));
  done += other.done;
  tally.add(other.tally);
}

static auto members_of(FlightTally& self) {
  return std::tie(self.hits, self.never, self.undecided, self.inside, self.time, self.square, self.log,
                  self.logarithms, self.shortest, self.longest, self.bins.logarithmic, self.bins.linear);
}

std::string Account::text() const {
  const int exponent = tally.bins.exponent();
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  for (const auto& range : done) ranges.emplace_back(range.lower(), range.upper());
  return json::piece_of(std::tie(exponent, ranges, tally));
}

Account Account::of(std::string_view text) {
  int exponent = 0;
  Account account;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  json::read_piece(text, std::tie(exponent, ranges, account.tally));
  for (const auto& [first, last] : ranges) account.done += Blocks::interval_type(first, last);
  Bins bins(exponent);
  bins.logarithmic = std::move(account.tally.bins.logarithmic);
  bins.linear = std::move(account.tally.bins.linear);
  account.tally.bins = std::move(bins);
  return account;
}

}  // namespace lorentz::flights
