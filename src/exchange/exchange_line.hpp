// What lines of all streams have in common. Private to the exchange formats.
#pragma once

#include <lorentz/line_reader.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz {

/// A line as JSON.
class JsonLine {
 public:
  /// The line's object. Throws InputError or simdjson's error if the line is not an object; every line of a
  /// stream is one.
  json::Object open(const LineReader::Line& line);

  /// Throws NotJson if something follows the object in the line.
  void close();

 private:
  json::Document document_;
};

struct CellRead {
  Cell cell{};
  std::size_t count = 0;
};

/// A cell's coordinates; throws InputError.
CellRead read_cell(json::Value value);

/// The number of a lattice or an atom; throws InputError, naming `key`.
int read_index(json::Value value, const char* key);

Id read_id(json::Value value);

/// The outcome with this name (name_of), or nothing.
std::optional<Outcome> outcome_named(std::string_view name);

struct FromRead {
  ObstacleId obstacle;
  std::size_t components = 0;
  bool lattice = false, atom = false, cell = false;
};

/// The obstacle that is left; throws InputError.
FromRead read_from(json::Value value, const OnUnknownKey& on_unknown_key);

/// Why a line is not JSON, with what its writer may have meant.
std::string not_json(const LineReader::Line& line, const std::string& why);

bool is_blank(const LineReader::Line& line);

/// For a line that is not JSON, for example because it was cut short: was it meant to be a scene? If so, the
/// queries after it are not for the scene before it.
bool begins_as_scene(std::string_view text);

/// Throws InputError unless the cell has as many coordinates as its lattice has vectors.
template <class AScene>
void check_cell(const FromRead& from, const AScene& scene) {
  const auto l = static_cast<std::size_t>(from.obstacle.lattice);
  if (l >= scene.lattices.size()) return;  // which is reported elsewhere
  const int rank = scene.dimension - scene.lattices[l].missing;
  if (from.components != static_cast<std::size_t>(rank))
    throw InputError("from.cell: has " + std::to_string(from.components) + " components, the lattice has " +
                     std::to_string(rank) + " vectors");
}

/// Throws InputError unless `count` is the scene's dimension.
void check_dimension(const char* what, std::size_t count, int dimension);

/// True for keys that golden records and files of disagreements have beside the query.
bool is_beside_query(std::string_view key);

struct ExchangeReader::Impl {
  JsonLine json_line;
  OnUnknownKey on_unknown_key;

  void read_query(const LineReader::Line& line, const Scene* scene, StreamItem& item);
  void read_start(const LineReader::Line& line, const RationalScene* scene, StartItem& item);

  /// Reads all members of the line's object by read(key, value). An error in one member does not end the
  /// reading, because the id may follow; `flaw` becomes the first error. An id that comes twice becomes
  /// `null`.
  template <class Read>
  void read_members(const LineReader::Line& line, Id& id, std::string& flaw, const Read& read) {
    const auto complain = [&](const InputError& error) {
      if (flaw.empty()) flaw = error.what();
    };
    try {
      json::each_member(json_line.open(line), [&](std::string_view key, json::Value value) {
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
    json_line.close();
  }

  /// Reads an item by read(), which throws if the line is bad.
  template <class Item, class Read>
  void read_item(const LineReader::Line& line, Item& item, const Read& read) {
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
      read();
    } catch (const json::Error& error) {
      bad(not_json(line, error.what()));
    } catch (const NotJson& error) {
      bad(not_json(line, error.what()));
    } catch (const InputError& error) {
      bad(error.what());
    }
  }
};

}  // namespace lorentz
