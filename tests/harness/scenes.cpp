// Any bytes as a scene file, TOML or JSON. The harness checks that nothing crashes or hangs, that errors are
// of the documented type and name the file, and that a scene that is read is free of flaws and the same after
// being written and read again, as a file and as a line of a stream.
#include <lorentz/exchange.hpp>
#include <lorentz/scene_check.hpp>
#include "tests/harness/harness.hpp"
#include "tests/harness/input_file.hpp"
#include "tests/harness/same.hpp"

namespace lorentz::harness {
namespace {

// Nothing if the scene was refused, as it should be.
std::optional<Scene> scene_in(const BytesAsFile& file) {
  try {
    return read_scene_file(file.path());
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with(file.path() + ": ") && message.size() > file.path().size() + 2,
            "an error names the file and says what is wrong", std::string(message));
    return std::nullopt;
  }
}

void check(const Scene& scene) {
  static BytesAsFile file;
  std::string line;
  append_scene_line(line, scene);
  require(!flaw_of(scene), "a scene that is read has no flaw", line);
  (void)oracle::dependence_in(scene);
  file.set(line);
  const std::optional<Scene> again = scene_in(file);
  require(again && same(*again, scene), "a scene file that is read again is the same", line);
  StreamItem item;
  ExchangeReader().read_query_line(LoneLine(line.substr(0, line.size() - 1)).line(), nullptr, item);
  require(item.kind == StreamItem::Kind::scene && same(item.scene, scene),
          "a scene line holds the same as the file", line);
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz::harness;
  static BytesAsFile file;
  file.set(text_of(data, size));
  if (const auto scene = scene_in(file)) check(*scene);
  return 0;
}
