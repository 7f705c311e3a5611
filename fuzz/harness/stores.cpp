// Any bytes as pieces of every kind, one per line. The harness checks that errors are of the documented type, and
// that a piece that was read is written as one that reads the same.
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

void read_account(const std::string& piece) {
  const auto account = read_or_refused([&] { return flights::Account::of(piece); });
  if (!account) return;
  const std::string text = account->text();
  require(flights::Account::of(text).text() == text, "an account is read as it was written", piece);
}

void read_cell(const std::string& piece) {
  const auto cell = read_or_refused([&] { return report::cell_of(piece); });
  if (!cell) return;
  const std::string text = piece_of(*cell);
  require(piece_of(report::cell_of(text)) == text, "a cell is read as it was written", piece);
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
