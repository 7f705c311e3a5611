// Any bytes as a golden set. The harness checks that nothing crashes or hangs, that errors are of the
// documented type, that each record is a query or says why it is invalid, and that the set, written and read
// again, is the same.
#include "judge/golden/reader.hpp"
#include "tests/harness/harness.hpp"
#include "tests/harness/input_file.hpp"
#include "tests/harness/same.hpp"

namespace lorentz::harness {
namespace {

// What a reader finds in a file, and that set written again.
struct ReadSet {
  std::vector<golden::Record> records;
  std::string text;
};

// Nothing if the set was refused, for this reason: as a whole, even if it is bad only from some line on.
std::optional<ReadSet> set_in(const BytesAsFile& file, std::string& reason) {
  try {
    golden::Reader reader(file.path());
    ReadSet set;
    append_header_line(set.text, reader.header());
    std::size_t scenes = 0;
    for (golden::ReadRecord read; reader.next(read);) {
      require(read.query.has_value() == read.flaw.empty(), "a record is a query, or says why it is not one",
              read.text);
      require(read.line > 0 && !read.record.id.empty(), "a record has a place and an id", read.text);
      if (read.query) require(!flaw_of(*read.query, reader.scene()), "a query has no flaw", read.text);
      if (reader.scene_number() != scenes) append_scene_line(set.text, reader.scene());
      scenes = reader.scene_number();
      append_record_line(set.text, read.record, reader.scene());
      set.records.push_back(std::move(read.record));
    }
    return set;
  } catch (const InputError& error) {
    reason = error.what();
    return std::nullopt;
  }
}

// An end may be written in several ways: compared as a number if it is one, otherwise as text.
bool same_end(const oracle::WindowEnd& a, const oracle::WindowEnd& b) {
  const auto value = oracle::binary64_of(a), other = oracle::binary64_of(b);
  return value == other && (value || oracle::text_of(a) == oracle::text_of(b));
}

bool same_proof(const oracle::Certificate& a, const oracle::Certificate& b) {
  const auto same_place = [](const auto& one, const auto& two) {
    return one.lattice == two.lattice && one.atom == two.atom && one.basis == two.basis;
  };
  const auto same_window = [&](const oracle::Window& one, const oracle::Window& two) {
    return same_place(one, two) && same_end(one.from, two.from) && same_end(one.to, two.to);
  };
  return std::ranges::equal(a.windows, b.windows, same_window) &&
         std::ranges::equal(a.rows, b.rows, same_place);
}

bool same_record(const golden::Record& a, const golden::Record& b) {
  return a.id == b.id && a.tags == b.tags && a.question == b.question && same(a.expect, b.expect) &&
         a.expect.time_decimal == b.expect.time_decimal && same(a.margin, b.margin) &&
         same(a.condition, b.condition) && a.certificate.has_value() == b.certificate.has_value() &&
         (!a.certificate || same_proof(*a.certificate, *b.certificate));
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz::harness;
  static BytesAsFile file, again;
  file.set(text_of(data, size));
  std::string reason;
  const auto first = set_in(file, reason);
  if (!first) return 0;
  again.set(first->text);
  const auto second = set_in(again, reason);
  require(second.has_value(), "a set that was read can be read again", first->text + reason);
  require(second->text == first->text, "a set that is read again is the same", first->text);
  require(std::ranges::equal(first->records, second->records, same_record),
          "a record that is read again is the same", first->text);
  return 0;
}
