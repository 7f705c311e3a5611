// Scenes and queries for people to copy, exact to the bit, in the exchange format.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

/// {"scene":{..}}: a line of a query stream, without the line end.
std::string scene_line(const Scene& scene);

/// The first `dimension` components, as "0x1.8p-1".
std::vector<std::string> hexadecimal(const Vec& a, int dimension);

/// {"x":["0x1.8p-1","0x0p+0"],"v":[..]}, with `from` if the query has it. A 2D query has two components.
std::string hexadecimal_query(const Query& query, const Components& count,
                              double max_time = std::numeric_limits<double>::infinity());

/// The same without braces.
std::string query_members(const Query& query, const Components& count,
                          double max_time = std::numeric_limits<double>::infinity());

/// The shell command that prints a query stream: the scene, and the query `times` times.
std::string printed(const Scene& scene, const std::string& query_members, std::size_t times = 1);

/// The lines of a text; each must end with a line end.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace lorentz::report
