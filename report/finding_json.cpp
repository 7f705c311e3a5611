#include "report/finding_json.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "files/messages.hpp"
#include "report/query_text.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
std::string scene_line(const Scene& scene) {
  std::string line;
  append_scene_line(line, scene);
  line.pop_back();
  return line;
}

std::string query_members(const Query& query, const Components& count) {
  const std::string object = report::hexadecimal_query(query, count);
  return object.substr(1, object.size() - 2);
}

std::string printed(const Scene& scene, const std::string& query_members, std::size_t times) {
  const std::string first = fmt::format("printf '%s\\n' {}", shell_quoted(scene_line(scene))),
                    query = shell_quoted(json::text_of(
                        [&](json::Members&line) { line.add("id", 1).add_members(query_members); }));
  return times == 1 ? fmt::format("{} {}", first, query)
                    : fmt::format("{{ {}; yes {} | head -n {}; }}", first, query, times);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

}  // namespace lorentz::report
