// The members of what the formats know, for lines that have others besides. Private to the libraries and the
// program.
#pragma once

#include <span>

#include "src/exchange/json_writer.hpp"

namespace lorentz {

void add_scene(json::Members& object, const Scene& scene);
void add_query(json::Members& object, const Query& query, int dimension);
void add_answer(json::Members& object, const Answer& answer, int dimension);

/// The same as values.
inline auto json_of(const Query& query, int dimension) {
  return [&query, dimension](json::Members& object) { add_query(object, query, dimension); };
}
inline auto json_of(const Answer& answer, int dimension) {
  return [&answer, dimension](json::Members& object) { add_answer(object, answer, dimension); };
}
inline void append_json(std::string& out, const Scene& scene) {
  json::append(out, [&](json::Members& object) { add_scene(object, scene); });
}

/// Lattice, atom and cell.
void add_obstacle(json::Members& object, const ObstacleId& obstacle, int dimension);

/// The first components of a vector or of a cell: a 2D problem has two.
template <class Three>
auto components(const Three& three, int dimension) {
  return std::span(three).first(static_cast<std::size_t>(dimension));
}

}  // namespace lorentz
