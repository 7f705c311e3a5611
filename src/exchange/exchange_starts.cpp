// Lines of streams of starts: like queries, but with numbers that may be rational, and directions that may be
// irrational.

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_line.hpp"

namespace lorentz {
namespace {

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

// The content of a line.
struct StartFields : LineFields {
  static constexpr const char* kName = "start";
  std::optional<SceneNode> x, v, direction;

  void read(std::string_view key, json::Value value, Id& id, const OnUnknownKey& on_unknown_key) {
    if (key == "x")
      x = read_node(value, "x");
    else if (key == "v")
      v = read_node(value, "v");
    else if (key == "direction")
      direction = read_node(value, "direction");
    else
      LineFields::read(key, value, id, on_unknown_key);
    if (on_unknown_key && key == "direction")
      check_keys(*direction, "direction.", {"degrees", "slope"}, on_unknown_key);
  }

  void set(StartItem& item, const RationalScene& scene) const {
    if (!x) throw InputError("x is missing");
    if (v.has_value() == direction.has_value())
      throw InputError(v ? "has both v and direction; leave one out" : "v is missing (or direction)");
    Start start;
    const auto& place = components_at(*x, "x", scene.dimension);
    for (std::size_t i = 0; i < place.size(); ++i) start.x[i] = rational_at(place[i], "x");
    if (direction) set_direction(*direction, scene.dimension, start);
    if (v) {
      const auto& velocity = components_at(*v, "v", scene.dimension);
      for (std::size_t i = 0; i < velocity.size(); ++i) start.v[i] = surd_at(velocity[i], "v");
    }
    if (from) {
      check_cell(*from, scene);
      start.from = from->obstacle;
    }
    if (auto flaw = flaw_of(start, scene)) throw InputError(*flaw);
    item.start = std::move(start);
  }
};

}  // namespace

void ExchangeReader::read_start_line(const LineReader::Line& line, const RationalScene* scene,
                                     StartItem& item) {
  impl_->read_item<StartFields>(line, scene, item);
}

}  // namespace lorentz
