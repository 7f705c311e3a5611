// Scenes and queries for people: to copy, exact to the bit, in the exchange format; and the name of a scene.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

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

/// The radius that all obstacles have, or nothing.
std::optional<double> common_radius(const Scene& scene);

/// "square", or "square, r = 0.1" if all obstacles are balls of one radius.
std::string name_with_radius(const std::string& name, const Scene& scene);

}  // namespace lorentz::report
