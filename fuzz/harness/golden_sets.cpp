// Any bytes as a golden set. Promised: no crash, no wait; an error is of the documented type; each record is
// either a query or says why it is none; and the set that is written of what was read reads the same again.
#include "harness.hpp"
#include "input_file.hpp"
#include "reader.hpp"

namespace lorentz::harness {
namespace {

// What a reader makes of a file, as it is written again; nothing if it was refused, for this reason. (A file
// that is bad from some line on is refused as a whole.)
std::optional<std::string> rewritten(const InputFile& file, std::string& reason) {
  try {
    golden::Reader reader(file.path());
    std::string text;
    append_header_line(text, reader.header());
    std::size_t scenes = 0;
    for (golden::ReadRecord read; reader.next(read);) {
      require(read.query.has_value() == read.flaw.empty(), "a record is a query, or says why it is none",
              read.text);
      require(read.line > 0 && !read.record.id.empty(), "a record has a place and an id", read.text);
      if (read.query) require(!flaw_of(*read.query, reader.scene()), "a query has no flaw", read.text);
      if (reader.scene_number() != scenes) append_scene_line(text, reader.scene());
      scenes = reader.scene_number();
      append_record_line(text, read.record, reader.scene().dimension);
    }
    return text;
  } catch (const InputError& error) {
    reason = error.what();
    return std::nullopt;
  }
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz::harness;
  static InputFile file, again;
  file.set(text_of(data, size));
  std::string reason;
  const auto first = rewritten(file, reason);
  if (!first) return 0;
  again.set(*first);
  const auto second = rewritten(again, reason);
  require(second.has_value(), "a set that was read can be read again", *first + reason);
  require(*second == *first, "a set that is read again is the same", *first + "\nnow\n" + *second);
  return 0;
}
