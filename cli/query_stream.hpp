// Streams of queries and of starts. Their scenes are checked and errors are reported. All subcommands that
// read such streams use them.
#pragma once

#include <optional>
#include <string>

#include <lorentz/exchange.hpp>
#include "report/files/unknown_keys.hpp"

namespace lorentz::cli {

/// A stream of lines that are scenes, or items in them (AnItem).
template <class AnItem, class AScene>
class SceneStream {
 public:
  /// `initial` is the scene before the first scene line, if any. Throws FileError.
  SceneStream(const std::string& path, std::optional<AScene> initial, bool strict);
  /// The lines of `text`, which messages call `name`.
  SceneStream(std::string_view text, const std::string& name, std::optional<AScene> initial, bool strict);

  /// Reads the next scene, query or bad line; false at the end. Reports the first kMaxComplaints bad lines on
  /// stderr with their place.
  bool next(AnItem& item);

  /// The current scene, or null.
  const AScene* scene() const { return scene_ ? &*scene_ : nullptr; }

  /// True if a line was bad or the stream was empty (the latter is reported at the end).
  bool had_bad_input() const { return complaints_ > 0; }

  LineReader& lines() { return lines_; }
  const LineReader& lines() const { return lines_; }

  /// The line of the last item.
  std::string_view line() const { return line_; }

 private:
  static constexpr long kMaxComplaints = 20;
  void complain(std::size_t line, const std::string& message);
  void finish();
  void check_scene(AnItem& item, std::size_t line);

  LineReader lines_;
  ExchangeReader reader_;
  KeyCheck keys_;
  std::optional<AScene> scene_;
  bool initial_;  // no scene line came yet
  std::size_t bad_scene_line_ = 0;
  std::string_view line_;
  long complaints_ = 0;
  bool empty_ = true;
};

using QueryStream = SceneStream<StreamItem, Scene>;
using StartStream = SceneStream<StartItem, RationalScene>;

/// The line of the one query that the options --x and --v ask in --scene, in place of the stream in `file`;
/// nothing without them. `as_texts`: the numbers are quoted, which readers of starts take exactly. Throws
/// InputError if only one of them is given, or no scene, or a stream besides.
std::optional<std::string> one_query(const std::optional<std::string>& x, const std::optional<std::string>& v,
                                     bool has_scene, const std::string& file, bool as_texts = false);

extern template class SceneStream<StreamItem, Scene>;
extern template class SceneStream<StartItem, RationalScene>;

}  // namespace lorentz::cli
