// What lines of all streams have in common. Private to the exchange formats.
#pragma once

#include <lorentz/line_reader.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz {

Id read_id(json::Value value);

/// An obstacle, and which of its parts were read.
struct ObstacleRead {
  ObstacleId obstacle;
  std::size_t components = 0;  ///< of the cell
  bool lattice = false, atom = false, cell = false;

  bool is_whole() const { return lattice && atom && cell; }
  /// Reads the value if the key is one of the parts; else returns false. Throws InputError, which names the
  /// key with `place` before it.
  bool read(std::string_view key, json::Value value, const std::string& place = "");
};

/// What lines of queries and lines of starts have in common, before it is compared with the scene.
struct LineFields {
  std::optional<SceneNode> scene;
  std::optional<ObstacleRead> from;
  bool golden = false;

  /// Reads the value of a key that the line may have, or passes over it.
  void read(std::string_view key, json::Value value, Id& id, const OnUnknownKey& on_unknown_key);
};

/// Why a line is not JSON, with what its writer may have meant.
std::string not_json(const LineReader::Line& line, const std::string& why);

bool is_blank(const LineReader::Line& line);

/// For a line that is not JSON, for example because it was cut short: was it meant to be a scene? If so, the
/// queries after it are not for the scene before it.
bool begins_as_scene(std::string_view text);

/// Throws InputError unless the cell has as many coordinates as its lattice has vectors.
template <class AScene>
void check_cell(const ObstacleRead& from, const AScene& scene) {
  const auto l = static_cast<std::size_t>(from.obstacle.lattice);
  if (l >= scene.lattices.size()) return;  // which is reported elsewhere
  const int rank = scene.lattices[l].rank_in(scene.dimension);
  if (from.components != static_cast<std::size_t>(rank))
    throw InputError("from.cell: has " + std::to_string(from.components) + " components, the lattice has " +
                     std::to_string(rank) + " vectors");
}

/// Throws InputError unless `count` is the scene's dimension.
void check_dimension(const char* what, std::size_t count, int dimension);

struct ExchangeReader::Impl {
  json::Document document;
  OnUnknownKey on_unknown_key;

  /// The line's object. Throws InputError or NotJson if the line is not an object; every line of a
  /// stream is one.
  json::Value open(const LineReader::Line& line);
  /// Throws NotJson if something follows the object in the line.
  void close();

  /// Reads all members of the line's object by read(key, value). An error in one member does not end the
  /// reading, because the id may follow; `flaw` becomes the first error. An id that comes twice becomes
  /// `null`.
  template <class Read>
  void read_members(const LineReader::Line& line, Id& id, std::string& flaw, const Read& read) {
    const auto complain = [&](const InputError& error) {
      if (flaw.empty()) flaw = error.what();
    };
    try {
      json::each_member(open(line), [&](std::string_view key, json::Value value) {
        try {
          read(key, value);
        } catch (const InputError& error) {
          complain(error);
        }
      });
    } catch (const KeyTwice& error) {
      if (error.key == "id") id = "null";
      complain(error);
    }
    close();
  }

  /// Reads a line that holds a scene, or else a query or a start. Fields, derived from LineFields, reads its
  /// members and sets the item (kName, read, set, x, v). Throws if the line is bad.
  template <class Fields, class AScene, class Item>
  void read_fields(const LineReader::Line& line, const AScene* scene, Item& item) {
    Fields fields;
    std::string flaw;  // the first; reading goes on, because the id may follow
    bool has_query = false;
    read_members(line, item.id, flaw, [&](std::string_view key, json::Value value) {
      item.bad_scene |= key == "scene";
      has_query |= key == "x" || key == "v" || key == "from" || key == "max_time" || key == "direction";
      fields.read(key, value, item.id, on_unknown_key);
    });
    if (!flaw.empty()) throw InputError(flaw);
    if (fields.scene) {
      if (on_unknown_key && has_query) on_unknown_key("a query in the line of a scene");
      item.scene = scene_from<AScene>(*fields.scene, on_unknown_key);
      item.bad_scene = false;
      item.kind = StreamItem::Kind::scene;
    } else if (!fields.golden || fields.x || fields.v) {
      item.no_scene = scene == nullptr;
      if (item.no_scene) throw InputError(std::string("no scene before this ") + Fields::kName);
      fields.set(item, *scene);
      item.kind = StreamItem::Kind::query;
    }
  }

  /// Reads an item by read_fields().
  template <class Fields, class AScene, class Item>
  void read_item(const LineReader::Line& line, const AScene* scene, Item& item) {
    item.kind = StreamItem::Kind::nothing;
    item.id = "null";
    item.no_scene = item.bad_scene = false;
    if (is_blank(line)) return;
    const auto bad = [&](std::string message) {
      item.kind = StreamItem::Kind::bad;
      item.message = std::move(message);
      item.bad_scene |= begins_as_scene(line.text);
      if (item.bad_scene) item.id = "null";
    };
    try {
      read_fields<Fields>(line, scene, item);
    } catch (const NotJson& error) {
      bad(not_json(line, error.what()));
    } catch (const InputError& error) {
      bad(error.what());
    }
  }
};

}  // namespace lorentz
