// Scenes and queries for people: to copy, exact to the bit, in the exchange format; and the name of a scene.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <lorentz/margin.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

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

/// The one question to which a finding reduces: a ray, and one ball or ellipsoid. All numbers exactly, the true
/// answer, and a snippet of C++ with the same numbers.
struct Primitive {
  std::string
      json;  ///< origin, direction, centre, radius or semiaxes (hexadecimal), discriminant, entry_time
  std::string cpp;
};

/// The obstacle must exist.
Primitive primitive_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                       const ObstacleId& obstacle);

}  // namespace lorentz::report
