// The parts of a finding, in the form of reports (docs/page.md) and shell lines.
#pragma once

#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

/// {"scene":{..}}: a line of a query stream, without the line end.
std::string scene_line(const Scene& scene);

/// The members of a query without braces and id, with hexadecimal numbers.
std::string query_members(const Query& query, const Components& count);

/// The shell command that prints a query stream: the scene, and the query `times` times.
std::string printed(const Scene& scene, const std::string& query_members, std::size_t times = 1);

/// The lines of a text; each must end with a line end.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace lorentz::report
