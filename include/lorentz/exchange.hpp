// The exchange formats: NDJSON streams of scenes, queries and answers, and scene files in TOML or JSON. No
// other part knows the formats. Numbers round-trip bit for bit. Wherever a number is read, a string with a
// hexadecimal float ("0x1.8p-1") is accepted. Unknown keys are ignored; a callback may observe them.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/line_reader.hpp>
#include <lorentz/rational.hpp>

namespace lorentz {

/// An id as JSON text: a quoted string, an integer, or null if the line has none.
using Id = std::string;

/// Called with each key that the format does not have, once per occurrence. A nested key comes with its path,
/// such as "from.kell" or "lattices.atoms.colour". Also called with "a query in the line of a scene", where
/// x, v and `from` have no meaning. If it throws InputError, the line or the scene file is bad.
using OnUnknownKey = std::function<void(const std::string& key)>;

/// The content of one line of a query stream.
struct StreamItem {
  enum class Kind { scene, query, bad, nothing };  ///< nothing: a blank line or a `golden` header
  Kind kind = Kind::nothing;
  Id id = "null";
  Scene scene;
  Query query;
  double max_time =
      std::numeric_limits<double>::infinity();  ///< the query's limit; its answer may be `later`
  std::string message;                          ///< set for `bad`
  bool no_scene = false;                        ///< `bad` because the stream has no current scene
  bool bad_scene = false;                       ///< the bad line was a scene, so the lines after it have none
};

/// The content of one line of a stream of starts, whose numbers may be rational.
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
///  2. Written values read back as the same bits.
///  3. Bad lines are reported by name and place, and never stop a stream.
///
/// A reader has its own buffers, so use one per thread.
class ExchangeReader {
 public:
  ExchangeReader();
  ~ExchangeReader();

  /// Sets the callback for unknown keys from now on. Without one they are ignored.
  void on_unknown_key(OnUnknownKey listener);

  /// Reads a line of a query stream. `scene` is the current scene; if it is null, every query is bad. The
  /// item is also bad if its scene or query is invalid (flaw_of).
  void read_query_line(const LineReader::Line& line, const Scene* scene, StreamItem& item);

  /// Reads a line of a stream of starts. Wherever a number is expected, a string with a rational number is
  /// accepted ("1/3", see rational_from); in v, one with a square root is accepted, too (surd_from). In 2D, v
  /// may be replaced by "direction": {"degrees": 36}, or {"slope": "golden"}, which is v = (1, slope).
  void read_start_line(const LineReader::Line& line, const RationalScene* scene, StartItem& item);

  /// Reads a line of an answer stream. Returns false for a blank line or a `golden` header. `components`
  /// becomes the number of coordinates of the answer's cell (0: no cell), which the caller must compare with
  /// the scene's dimension. Throws InputError if the line is bad.
  bool read_answer_line(const LineReader::Line& line, Id& id, Answer& answer, std::size_t& components);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a scene file in TOML or JSON (also as a `scene` line). Throws FileError, or InputError with the
/// place.
Scene read_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key = {});

/// The same for the text of such a file, whose place is the line, or the key.
Scene read_scene_text(const std::string& text, const OnUnknownKey& on_unknown_key = {});

/// The same for a scene file whose numbers may be strings with rational numbers (rational_from).
RationalScene read_rational_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key = {});

/// Append a line, with its line end. `components` is the scene, or its dimension if all lattices are
/// crystals.
void append_scene_line(std::string& out, const Scene& scene);
void append_query_line(std::string& out, const Id& id, const Query& query, const Components& components,
                       double max_time = std::numeric_limits<double>::infinity());
void append_answer_line(std::string& out, const Id& id, const Answer& answer, const Components& components);

/// The outcome's name in all formats: "hit", "never", ..
std::string_view name_of(Outcome outcome);

/// Names and versions of the libraries that read the formats.
std::string exchange_libraries();

/// Appends a JSON number, or a decimal string if |n| is beyond 2^53.
void append_integer(std::string& out, const Integer& n);

/// The text as a JSON string, with its quotes.
std::string json_quoted(std::string_view text);

/// Appends the shortest text that reads back as the same binary64; an infinity becomes "inf", in quotes.
void append_number(std::string& out, double value);

/// Parses all of the text as a decimal or hexadecimal ("0x...") float. Throws InputError.
double parse_number(std::string_view text);

}  // namespace lorentz
