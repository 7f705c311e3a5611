// Any bytes as a golden set. The harness checks that nothing crashes or hangs, that errors are of the
// documented type, that each record is a query or says why it is invalid, and that the set, written and read
// again, is the same.
#include "fuzz/harness/harness.hpp"
#include "fuzz/harness/input_file.hpp"
#include "fuzz/harness/same.hpp"
#include "golden/reader.hpp"

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

bool same_proof(const oracle::Certificate& a, const oracle::Certificate& b) {
  if (a.windows.size() != b.windows.size() || a.rows.size() != b.rows.size()) return false;
  for (std::size_t i = 0; i < a.windows.size(); ++i) {
    const oracle::Window &one = a.windows[i], &two = b.windows[i];
    if (one.lattice != two.lattice || one.atom != two.atom || one.basis != two.basis) return false;
    for (const auto end : {&oracle::Window::from, &oracle::Window::to}) {
      // An end may be written in several ways: compared as a number if it is one, otherwise as text.
      const auto value = oracle::binary64_of(one.*end), other = oracle::binary64_of(two.*end);
      if (value != other || (!value && oracle::text_of(one.*end) != oracle::text_of(two.*end))) return false;
    }
  }
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    const oracle::Rows &one = a.rows[i], &two = b.rows[i];
    if (one.lattice != two.lattice || one.atom != two.atom || one.basis != two.basis) return false;
  }
  return true;
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
  const bool as_many = second->records.size() == first->records.size();
  require(as_many && second->text == first->text, "a set that is read again is the same", first->text);
  for (std::size_t i = 0; i < first->records.size(); ++i)
    require(same_record(first->records[i], second->records[i]), "a record that is read again is the same",
            first->text);
  return 0;
}
