// Any bytes as pieces of every kind, one per line. The harness checks that errors are of the documented type,
// that a piece that was read is written as one that reads the same, and that an account or a cell without a
// flaw can be added up and written.
#include "fuzz/harness/harness.hpp"
#include "fuzz/harness/input_file.hpp"
#include "report/cell.hpp"
#include "statistics/chaos/groups.hpp"
#include "statistics/flights/account.hpp"

#include <lorentz/errors.hpp>

namespace lorentz::harness {
namespace {

// Nothing if read() throws an InputError; any other exception ends the program.
template <class Read>
auto read_or_refused(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

// The plan of the committed store of flights.
const flights::FlightsPlan& plan() {
  static const flights::FlightsPlan plan = [] {
    flights::FlightsPlan made;
    made.scene = unit_scene(2, 0.25);
    made.seed = 1, made.count = 140'000;
    return made;
  }();
  return plan;
}

void read_account(const std::string& piece) {
  const auto account = read_or_refused([&] { return flights::Account::of(piece); });
  if (!account) return;
  require(flights::Account::of(account->text()) == *account, "an account is read as it was written", piece);
  const bool fits = read_or_refused([&] { return account->check(plan()), true; }).has_value();
  if (!fits) return;
  flights::Account sum = flights::Account::begun(plan());
  sum.add(*account);
  require(sum == *account, "an account that fits a plan is added to none of it", piece);
  require(sum.tally.flights() <= plan().count, "an account has no more flights than its plan", piece);
  if (sum.tally.hits > 0)
    require(sum.tally.mean() >= sum.tally.shortest && sum.tally.mean() <= sum.tally.longest,
            "the mean lies between the extremes", piece);
}

void read_cell(const std::string& piece) {
  const auto cell = read_or_refused([&] { return report::cell_of(piece); });
  if (!cell || !flaw_of(*cell, 1'000'000).empty()) return;
  std::string text;
  append_json(text, *cell);
  const auto again = read_or_refused([&] { return report::cell_of(text); });
  require(again && *again == *cell, "a cell is read as it was written", piece);
}

void read_group(const std::string& piece) {
  std::uint64_t group = 0, same = 0;
  const auto sums = read_or_refused([&] { return chaos::sums_in(piece, group); });
  if (!sums) return;
  const std::string text = chaos::text_of(group, *sums);
  const chaos::Sums again = chaos::sums_in(text, same);
  require(same == group && chaos::text_of(same, again) == text, "a group is read as it was written", piece);
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz;
  using namespace lorentz::harness;
  std::string_view text = text_of(data, size);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string piece(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    read_account(piece);
    read_cell(piece);
    read_group(piece);
  }
  return 0;
}
