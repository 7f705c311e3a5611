// The parts of a finding, as reports (docs/page.md) and shell lines have them.
#pragma once

#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

/// {"scene":{..}}, a line of a query stream without its end.
std::string scene_line(const Scene& scene);

/// The members of a query without braces and id, its numbers in hexadecimal.
std::string query_members(const Query& query, const Components& count);

/// The shell command that prints a query stream: the scene, and the query `times` times.
std::string printed(const Scene& scene, const std::string& query_members, std::size_t times = 1);

/// The lines of a text in which all of them end.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace lorentz::report
