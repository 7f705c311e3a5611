// The exchange formats: NDJSON streams of scenes, queries and answers, and scene files in TOML or JSON. The
// one place that knows them. Numbers round-trip bit for bit; wherever a number is read, a string with a
// hexadecimal float ("0x1.8p-1") will do; keys that are not known are ignored, but somebody may be told.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/line_reader.hpp>
#include <lorentz/rational.hpp>

namespace lorentz {

/// An id as JSON text: a quoted string, an integer, or null where there was none.
using Id = std::string;

/// Called with each key that the format does not have, as often as it comes; with its place if it is inside
/// of another, "from.kell" or "lattices.atoms.colour"; also with "a query in the line of a scene", where x, v
/// and `from` mean nothing. What it throws as an InputError makes the line, or the scene file, bad.
using OnUnknownKey = std::function<void(const std::string& key)>;

/// What a line of a query stream turned out to be.
struct StreamItem {
  enum class Kind { scene, query, bad, nothing };  ///< nothing: a blank line or a `golden` header
  Kind kind = Kind::nothing;
  Id id = "null";
  Scene scene;
  Query query;
  std::string message;     ///< of `bad`
  bool no_scene = false;   ///< `bad` because no scene holds
  bool bad_scene = false;  ///< the bad line was a scene: what follows has none
};

/// The same of a stream of starts, whose numbers may be rational.
struct StartItem {
  StreamItem::Kind kind = StreamItem::Kind::nothing;
  Id id = "null";
  RationalScene scene;
  Start start;
  std::string message;
  bool no_scene = false, bad_scene = false;
};

/// Reads the lines of query and answer streams.
///
///  1. A number is the binary64 nearest to its text, ties to even, however many digits it has.
///     held by "Numbers: midpoints between neighbours, and what is beside them",
///             "Numbers: 1 to 800 digits, with points and exponents that make up for each other"
///  2. What is written reads back as the same bits.
///     held by "Queries round-trip bit for bit, in decimal and in hexadecimal",
///             "Scenes round-trip"
///  3. Bad lines are told by name and place, and never stop a stream.
///     held by "Every sort of bad line is told by name, and keeps its id where it can be read"
///
/// A reader has buffers of its own: one a thread.
class ExchangeReader {
 public:
  ExchangeReader();
  ~ExchangeReader();

  /// Who is told of unknown keys from now on; without anybody they are ignored.
  void on_unknown_key(OnUnknownKey listener);

  /// A line of a query stream. `scene` is the scene that holds, or null: then every query is bad. Scenes and
  /// queries are free of flaws (flaw_of), or the item is bad.
  void read_query_line(const LineReader::Line& line, const Scene* scene, StreamItem& item);

  /// The same of a stream of starts: wherever a number is, a text with a rational number will do ("1/3", see
  /// rational_from), in v one with a square root, too (surd_from); in place of v, in 2D, "direction":
  /// {"degrees": 36}, or {"slope": "golden"}, which is v = (1, slope).
  void read_start_line(const LineReader::Line& line, const RationalScene* scene, StartItem& item);

  /// A line of an answer stream. `components` becomes the number of its cell's coordinates (0: no cell),
  /// which is for the caller to hold against the scene's dimension. Throws InputError. False for a blank line
  /// or a `golden` header.
  bool read_answer_line(const LineReader::Line& line, Id& id, Answer& answer, std::size_t& components);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A scene file, TOML or JSON (also as a `scene` line). Throws FileError, or InputError with the place.
Scene read_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key = {});

/// The same of a scene whose numbers may be texts with rational numbers (rational_from).
RationalScene read_rational_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key = {});

/// Appends a line, with its line end. `components`: the scene, or among crystals the dimension.
void append_scene_line(std::string& out, const Scene& scene);
void append_query_line(std::string& out, const Id& id, const Query& query, const Components& components);
void append_answer_line(std::string& out, const Id& id, const Answer& answer, const Components& components);

/// What all formats call it: "hit", "never", ..
std::string_view name_of(Outcome outcome);

/// What the formats are read with, and its versions.
std::string exchange_libraries();

/// A JSON number; beyond 2^53 in absolute value a decimal string.
void append_integer(std::string& out, const Integer& n);

/// A JSON string with its quotes.
std::string json_quoted(std::string_view text);

/// Shortest text that reads back as the same binary64; "inf" in quotes for an infinity.
void append_number(std::string& out, double value);

/// A decimal or ("0x...") hexadecimal float, all of the text; throws InputError.
double parse_number(std::string_view text);

}  // namespace lorentz
