#include "cli/query_stream.hpp"

#include <lorentz/scene_check.hpp>
#include "cli/messages.hpp"
#include "cli/scene_option.hpp"

namespace lorentz::cli {

QueryStream::QueryStream(const std::string& path, std::optional<Scene> initial, UnknownKeys unknown)
    : lines_(path), keys_(lines_.name(), unknown), scene_(std::move(initial)), initial_(scene_.has_value()) {
  reader_.on_unknown_key([this](const std::string& key) { keys_(key); });
}

void QueryStream::complain(std::size_t line, const std::string& message) {
  if (++complaints_ <= kMaxComplaints) say("{}:{}: {}", lines_.name(), line, message);
}

void QueryStream::finish() {
  if (empty_ && complaints_ == 0) {
    ++complaints_;
    say("{}: is empty: no scene and no query in it", lines_.name());
  }
  if (complaints_ > kMaxComplaints) say("{}: {} more bad lines", lines_.name(), complaints_ - kMaxComplaints);
}

// Dependent vectors make a scene bad; overlaps, and that it replaces the command line's scene, are only
// mentioned.
void QueryStream::check_scene(StreamItem& item, std::size_t line) {
  const std::string place = fmt::format("{}:{}", lines_.name(), line);
  if (auto flaw = oracle::dependence_in(item.scene)) {
    item.kind = StreamItem::Kind::bad;
    item.bad_scene = true;
    item.message = *flaw;
    return;
  }
  warn_of_overlaps(item.scene, place);
  if (initial_) say("{}: this scene takes the place of --scene", place);
  initial_ = false;
}

bool QueryStream::next(StreamItem& item) {
  LineReader::Line line;
  do {
    if (!lines_.next(line)) {
      finish();
      return false;
    }
    keys_.line = line.number;
    reader_.read_query_line(line, scene(), item);
    if (item.no_scene && bad_scene_line_ > 0)
      item.message = fmt::format("the scene in line {} was bad, so this query has none", bad_scene_line_);
    if (item.kind == StreamItem::Kind::scene) check_scene(item, line.number);
  } while (item.kind == StreamItem::Kind::nothing);
  empty_ = false;
  if (item.kind == StreamItem::Kind::scene) scene_ = item.scene;
  if (item.kind == StreamItem::Kind::bad) {
    if (item.bad_scene) {
      scene_.reset();
      bad_scene_line_ = line.number;
    }
    complain(line.number, item.message);
  }
  return true;
}

}  // namespace lorentz::cli
