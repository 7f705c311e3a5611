// Any bytes as a query stream and as an answer stream. The harness checks that nothing crashes or hangs, that
// errors are of the documented type and their messages make a line of an answer stream, and that what is read
// is free of flaws and the same after being written and read again.
#include <lorentz/exchange.hpp>
#include <lorentz/scene_check.hpp>
#include "tests/harness/harness.hpp"
#include "tests/harness/input_file.hpp"
#include "tests/harness/same.hpp"

namespace lorentz::harness {
namespace {

// The line that `append` appends, without its end.
template <class Append>
std::string written(const Append& append) {
  std::string line;
  append(line);
  if (!line.ends_with('\n')) fail("a line that is written ends", line);
  line.pop_back();
  if (line.find('\n') != std::string::npos) fail("a line that is written is one line", line);
  return line;
}

void check_scene(const Scene& scene) {
  const std::string line = written([&](std::string& to) { append_scene_line(to, scene); });
  require(!flaw_of(scene), "a scene that is read has no flaw", line);
  StreamItem again;
  ExchangeReader().read_query_line(LoneLine(line).line(), nullptr, again);
  require(again.kind == StreamItem::Kind::scene, "a scene that was read can be read again", line);
  require(same(again.scene, scene), "a scene that is read again is the same", line);
}

void check_query(const StreamItem& item, const Scene& scene) {
  const std::string line =
      written([&](std::string& to) { append_query_line(to, item.id, item.query, scene.dimension); });
  require(!flaw_of(item.query, scene), "a query that is read has no flaw", line);
  StreamItem again;
  ExchangeReader().read_query_line(LoneLine(line).line(), &scene, again);
  require(again.kind == StreamItem::Kind::query, "a query that was read can be read again", line);
  require(again.id == item.id && same(again.query, item.query), "a query that is read again is the same",
          line);
}

void check_answer(const Id& id, const Answer& answer, int dimension) {
  const std::string line = written([&](std::string& to) { append_answer_line(to, id, answer, dimension); });
  Id id_again;
  Answer again;
  std::size_t components = 0;
  try {
    const bool is_answer =
        ExchangeReader().read_answer_line(LoneLine(line).line(), id_again, again, components);
    require(is_answer, "an answer that was read can be read again", line);
  } catch (const InputError& error) {
    fail("an answer that was read can be read again", line + '\n' + error.what());
  }
  require(id_again == id && same(again, answer), "an answer that is read again is the same", line);
}

// Reads a query stream as its user does: a bad scene leaves the reader without a scene.
class QueryStreamCheck {
 public:
  void see(const LineReader::Line& line) {
    StreamItem item;
    reader_.read_query_line(line, scene_ ? &*scene_ : nullptr, item);
    if (item.kind == StreamItem::Kind::scene) {
      check_scene(item.scene);
      scene_ = std::move(item.scene);
      if (oracle::dependence_in(*scene_)) scene_.reset();
    } else if (item.kind == StreamItem::Kind::query) {
      require(scene_.has_value(), "a query without a scene is bad", std::string(line.text));
      check_query(item, *scene_);
    } else if (item.kind == StreamItem::Kind::bad) {
      require(!item.message.empty(), "a bad line is told why", std::string(line.text));
      check_answer(item.id, Answer::error(item.message), 2);
      if (item.bad_scene) scene_.reset();
    }
  }

 private:
  ExchangeReader reader_;
  std::optional<Scene> scene_;
};

void see_answer(ExchangeReader& reader, const LineReader::Line& line) {
  Id id;
  Answer answer;
  std::size_t components = 0;
  try {
    if (!reader.read_answer_line(line, id, answer, components)) return;
  } catch (const InputError&) {
    return;
  }
  const bool names_obstacle = answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
  if (!names_obstacle || components == 2) check_answer(id, answer, 2);
  if (names_obstacle && components == 3) check_answer(id, answer, 3);
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz;
  using namespace lorentz::harness;
  static BytesAsFile file;
  const std::string_view input = text_of(data, size);
  file.set(input);
  QueryStreamCheck queries;
  ExchangeReader answers;
  std::string all;
  LineReader lines(file.path());
  for (LineReader::Line line; lines.next(line);) {
    if (line.number == 1 && input.starts_with("\xef\xbb\xbf")) all += "\xef\xbb\xbf";
    all.append(line.text);
    all += '\n';
    const LoneLine lone(line.text, line.number);
    queries.see(lone.line());
    see_answer(answers, lone.line());
  }
  const bool ended = input.empty() || input.back() == '\n';
  require(all == std::string(input) + (ended ? "" : "\n"), "the lines together are the file", all);
  return 0;
}
