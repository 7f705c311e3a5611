#include "cli/query_stream.hpp"

#include <unistd.h>

#include <lorentz/itinerary.hpp>
#include <lorentz/scene_check.hpp>
#include "cli/numbers.hpp"
#include "report/files/messages.hpp"
#include "report/files/scene_file.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using Kind = StreamItem::Kind;

namespace {

std::optional<std::string> dependence_in(const Scene& scene) {
  return oracle::dependence_in(scene);
}

std::optional<std::string> dependence_in(const RationalScene& scene) {
  try {
    oracle::Itinerary checks{scene};
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

const Scene& in_binary64(const Scene& scene) {
  return scene;
}

Scene in_binary64(const RationalScene& scene) {
  return oracle::nearest(scene);
}

}  // namespace

template <class AnItem, class AScene>
SceneStream<AnItem, AScene>::SceneStream(const std::string& path, std::optional<AScene> initial, bool strict)
    : lines_(queries_file(path)),
      keys_(lines_.name(), strict),
      scene_(std::move(initial)),
      initial_(scene_.has_value()) {
  reader_.on_unknown_key([this](const std::string& key) { keys_(key); });
  if (path == "-" && isatty(STDIN_FILENO) == 1)
    say("reads lines from the terminal (--help has an example); Ctrl-D ends them");
}

template <class AnItem, class AScene>
SceneStream<AnItem, AScene>::SceneStream(std::string_view text, const std::string& name,
                                         std::optional<AScene> initial, bool strict)
    : lines_(text, name), keys_(name, strict), scene_(std::move(initial)), initial_(scene_.has_value()) {}

template <class AnItem, class AScene>
void SceneStream<AnItem, AScene>::complain(std::size_t line, const std::string& message) {
  if (++complaints_ <= kMaxComplaints) say("{}:{}: {}", lines_.name(), line, message);
}

template <class AnItem, class AScene>
void SceneStream<AnItem, AScene>::finish() {
  if (empty_ && complaints_ == 0) {
    ++complaints_;
    say("{}: is empty: no scene and no query in it", lines_.name());
  }
  if (complaints_ > kMaxComplaints) say("{}: {} more bad lines", lines_.name(), complaints_ - kMaxComplaints);
}

// Dependent vectors make a scene invalid. Overlaps, and the replacement of the command line's scene, only
// give a message.
template <class AnItem, class AScene>
void SceneStream<AnItem, AScene>::check_scene(AnItem& item, std::size_t line) {
  const std::string place = fmt::format("{}:{}", lines_.name(), line);
  if (auto flaw = dependence_in(item.scene)) {
    item.kind = Kind::bad;
    item.bad_scene = true;
    item.message = *flaw;
    return;
  }
  warn_of_overlaps(in_binary64(item.scene), place);
  if (initial_) say("{}: this scene takes the place of --scene", place);
  initial_ = false;
}

template <class AnItem, class AScene>
bool SceneStream<AnItem, AScene>::next(AnItem& item) {
  LineReader::Line line;
  do {
    if (!lines_.next(line)) {
      finish();
      return false;
    }
    keys_.line = line.number;
    line_ = line.text;
    if constexpr (std::is_same_v<AnItem, StreamItem>)
      reader_.read_query_line(line, scene(), item);
    else
      reader_.read_start_line(line, scene(), item);
    if (item.no_scene && bad_scene_line_ > 0)
      item.message = fmt::format("the scene in line {} was bad, so this query has none", bad_scene_line_);
    if (item.kind == Kind::scene) check_scene(item, line.number);
  } while (item.kind == Kind::nothing);
  empty_ = false;
  if (item.kind == Kind::scene) scene_ = item.scene;
  if (item.kind == Kind::bad) {
    if (item.bad_scene) {
      scene_.reset();
      bad_scene_line_ = line.number;
    }
    complain(line.number, item.message);
  }
  return true;
}

std::optional<std::string> one_query(const std::optional<std::string>& x, const std::optional<std::string>& v,
                                     bool has_scene, const std::string& file, bool as_texts) {
  if (x.has_value() != v.has_value())
    throw InputError(x ? "--x: needs --v, the velocity" : "--v: needs --x, the position");
  if (!x) return std::nullopt;
  if (!has_scene) throw InputError("--x and --v: need --scene");
  if (file != "-") throw InputError("--x and --v: ask one query; leave them out, or the file " + file);
  return json::line_of([&](json::Members& line) {
    if (as_texts)
      line.add("x", items_of(*x, "--x"), "v", items_of(*v, "--v"));
    else
      line.add("x", numbers_in(*x, "--x"), "v", numbers_in(*v, "--v"));
  });
}

template class SceneStream<StreamItem, Scene>;
template class SceneStream<StartItem, RationalScene>;

}  // namespace lorentz::cli
