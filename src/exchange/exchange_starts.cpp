// Lines of streams of starts: like queries, but with numbers that may be rational, and directions that may be
// irrational.
#include <algorithm>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_line.hpp"

namespace lorentz {
namespace {

// The content of a line, before it is compared with the scene.
struct StartFields {
  std::optional<SceneNode> scene, x, v, direction;
  std::optional<FromRead> from;
  bool golden = false;
};

const SceneNode::Array& components_at(const SceneNode& node, const char* key, int dimension) {
  const auto* array = std::get_if<SceneNode::Array>(&node.value);
  if (!array) throw InputError(std::string(key) + ": needs an array of numbers");
  check_dimension(key, array->size(), dimension);
  return *array;
}

Surd surd_at(const SceneNode& node, const std::string& place) {
  if (const std::string* text = std::get_if<std::string>(&node.value)) {
    if (auto number = surd_from(*text)) return *number;
    throw InputError(place + ": " + json_quoted(*text) +
                     R"x( is not a known number (like "1/3", "0.1", "sqrt(2)", "golden"))x");
  }
  return Surd(rational_at(node, place));
}

void set_direction(const SceneNode& direction, int dimension, Start& start) {
  if (dimension != 2) throw InputError("direction: is for two dimensions; give v");
  const SceneNode* degrees = direction.member("degrees");
  const SceneNode* slope = direction.member("slope");
  if ((degrees != nullptr) == (slope != nullptr))
    throw InputError(R"(direction: needs one of "degrees" and "slope")");
  if (degrees) {
    start.degrees = rational_at(*degrees, "direction.degrees");
    return;
  }
  start.v[0] = Surd(1.0);
  start.v[1] = surd_at(*slope, "direction.slope");
}

Start start_from(const StartFields& fields, const RationalScene& scene) {
  if (!fields.x) throw InputError("x is missing");
  if (fields.v.has_value() == fields.direction.has_value())
    throw InputError(fields.v ? "has both v and direction; leave one out" : "v is missing (or direction)");
  Start start;
  const auto& x = components_at(*fields.x, "x", scene.dimension);
  for (std::size_t i = 0; i < x.size(); ++i) start.x[i] = rational_at(x[i], "x");
  if (fields.direction) set_direction(*fields.direction, scene.dimension, start);
  if (fields.v) {
    const auto& v = components_at(*fields.v, "v", scene.dimension);
    for (std::size_t i = 0; i < v.size(); ++i) start.v[i] = surd_at(v[i], "v");
  }
  if (fields.from) {
    check_cell(*fields.from, scene);
    start.from = fields.from->obstacle;
  }
  if (auto flaw = flaw_of(start, scene)) throw InputError(*flaw);
  return start;
}

void read_start_field(std::string_view key, json::Value value, Id& id, StartFields& fields,
                      const OnUnknownKey& on_unknown_key) {
  const std::string place(key);
  if (key == "id")
    id = read_id(value);
  else if (key == "from")
    fields.from = read_from(value, on_unknown_key);
  else if (key == "scene")
    fields.scene = read_node(value);
  else if (key == "x")
    fields.x = read_node(value, place);
  else if (key == "v")
    fields.v = read_node(value, place);
  else if (key == "direction")
    fields.direction = read_node(value, place);
  else {
    fields.golden |= key == "golden";
    skip(value);
    if (on_unknown_key && !is_beside_query(key)) on_unknown_key(place);
  }
}

}  // namespace

void ExchangeReader::Impl::read_start(const LineReader::Line& line, const RationalScene* scene,
                                      StartItem& item) {
  StartFields fields;
  std::string flaw;  // the first; reading goes on, because the id may follow
  read_members(line, item.id, flaw, [&](std::string_view key, json::Value value) {
    item.bad_scene |= key == "scene";
    read_start_field(key, value, item.id, fields, on_unknown_key);
  });
  if (!flaw.empty()) throw InputError(flaw);
  if (fields.scene) {
    item.scene = rational_scene_from(*fields.scene, on_unknown_key);
    item.bad_scene = false;
    item.kind = StreamItem::Kind::scene;
  } else if (!fields.golden || fields.x || fields.v) {
    item.no_scene = scene == nullptr;
    if (item.no_scene) throw InputError("no scene before this start");
    item.start = start_from(fields, *scene);
    item.kind = StreamItem::Kind::query;
  }
}

void ExchangeReader::read_start_line(const LineReader::Line& line, const RationalScene* scene,
                                     StartItem& item) {
  impl_->read_item(line, item, [&] { impl_->read_start(line, scene, item); });
}

}  // namespace lorentz
