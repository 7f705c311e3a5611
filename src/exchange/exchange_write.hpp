// The members of scenes, queries and answers, for lines that have other members, too. Private to the
// libraries and the program.
#pragma once

#include <span>

#include "src/exchange/json_writer.hpp"

namespace lorentz {

void add_scene(json::Members& object, const Scene& scene);

/// {"scene":{..}}: a line of a query stream, without the line end.
std::string scene_line(const Scene& scene);

void add_query(json::Members& object, const Query& query, const Components& count,
               double max_time = std::numeric_limits<double>::infinity());
void add_answer(json::Members& object, const Answer& answer, const Components& count);

/// The same as values.
inline auto json_of(const Query& query, const Components& count) {
  return [&query, count](json::Members& object) { add_query(object, query, count); };
}
inline auto json_of(const Answer& answer, const Components& count) {
  return [&answer, count](json::Members& object) { add_answer(object, answer, count); };
}
inline void append_json(std::string& out, const Scene& scene) {
  json::append(out, [&](json::Members& object) { add_scene(object, scene); });
}

/// The outcome with this name (name_of), or nothing.
std::optional<Outcome> outcome_named(std::string_view name);

/// Adds lattice, atom and cell.
void add_obstacle(json::Members& object, const ObstacleId& obstacle, const Components& count);

/// The first components of a vector or of a cell: a 2D problem has two.
template <class Three>
auto components(const Three& three, int dimension) {
  return std::span(three).first(static_cast<std::size_t>(dimension));
}

/// "2, -1"
std::string decimals(std::span<const Integer> numbers, const char* separator = ", ");

}  // namespace lorentz
