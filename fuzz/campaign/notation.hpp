// The same scene and query in another notation: after reading, they must have the same numbers.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <lorentz/exchange.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::fuzz {

/// A line that is not read as what it says.
struct Misreading {
  std::string notation;  ///< like "digits %.20f"
  std::string line;
};

/// Reads a line of a query stream; a scene's line is read without a scene.
using ReadLine = std::function<StreamItem(const std::string& line, const Scene* scene)>;

/// A ReadLine by this program's own reader.
StreamItem read_line(const std::string& line, const Scene* scene);

/// Writes the scene and the query as lines of a query stream, in a drawn notation: digits, order and escapes
/// of keys, blanks, line ends. Nothing if both are read back as they are, by this program's reader or another
/// one.
std::optional<Misreading> misreading(cases::Random& random, const Scene& scene, const Query& query,
                                     const ReadLine& read = read_line);

}  // namespace lorentz::fuzz
