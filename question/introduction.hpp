// What an external engine reports about itself, and about the time of its own calls
// (docs/command_engines.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>
#include "question/process.hpp"

namespace lorentz::question {

/// `{"engine":{"name":..,"version":..,"precision":..,"time_tolerance":..,"dimensions":[..],"domain":{"speed":[a,b],
/// "coordinates":[a,b],"radius":[a,b],"flight":[a,b],"shapes":["ball","ellipsoid"],"limits":true},"inside":..}}`; each
/// key may be left out.
struct Introduction {
  std::string name = {}, version = {};
  std::optional<NumberFormat> precision = {};
  std::optional<double> time_tolerance = {};  ///< as Claim::time_tolerance
  std::vector<int> dimensions = {};           ///< empty: not stated
  std::optional<Domain> domain = {};          ///< with the dimensions
  std::optional<StartInside> inside = {};
  std::vector<std::string> unknown = {};  ///< keys that no introduction has
};

/// The format with this name. Throws InputError if there is none.
NumberFormat format_called(std::string_view name);

/// Reads an introduction. Returns nothing if the line is not an object with the key "engine". Throws InputError for
/// impossible values, and for a line on which an object begins that does not end there.
std::optional<Introduction> introduction_in(std::string_view line);

/// What a program writes first when its input is empty.
struct FirstWords {
  std::optional<std::string> line = {};  ///< nothing: it wrote none, or one beyond LineBuffer::kMaxLine
  std::string fate = {};                 ///< if it wrote none: "died (exit 3)", "gave no answer within 5 s"
};
FirstWords first_words_of(const Executable& program, double seconds);

/// The introduction that the program writes when its input is empty. Nothing if it writes none, fails, or
/// takes longer than `seconds`, or than ten seconds.
std::optional<Introduction> introduction_of_command(const std::string& command, double seconds);

/// The time of an engine's own calls, without pipes and text.
struct OwnTime {
  double seconds = 0;
  double queries = 0;

  /// Nothing if there were no queries.
  std::optional<double> ns_per_query() const {
    return queries > 0 ? std::optional(1e9 * seconds / queries) : std::nullopt;
  }
};

/// Reads `{"engine_time":{"seconds":..,"queries":..}}`. Returns nothing for another line; throws InputError
/// for impossible numbers.
std::optional<OwnTime> own_time_in(std::string_view line, const OnUnknownKey& on_unknown_key = {});

/// Reads `{"library":{"does":..}}`, by which the program of a library says what the library is called for.
/// Returns nothing for another line.
std::optional<std::string> doing_in(std::string_view line);

}  // namespace lorentz::question
