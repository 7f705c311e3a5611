#include "cli/finding_json.hpp"

#include <fmt/format.h>

#include <cmath>

#include <lorentz/exchange.hpp>
#include "cli/messages.hpp"

namespace lorentz::cli {
namespace {

// {"id":0,..} as {..}
std::string without_id(std::string line) {
  line.pop_back();
  return '{' + line.substr(std::string_view("{\"id\":0,").size());
}

std::string vector_of(const Vec& a, int dimension) {
  std::string out = "[";
  for (int i = 0; i < dimension; ++i) out += fmt::format("{}\"{:a}\"", i ? "," : "", a[i]);
  return out + ']';
}

}  // namespace

std::string scene_line(const Scene& scene) {
  std::string line;
  append_scene_line(line, scene);
  line.pop_back();
  return line;
}

std::string scene_object(const Scene& scene) {
  constexpr std::string_view kScene = "{\"scene\":";
  const std::string line = scene_line(scene);
  return line.substr(kScene.size(), line.size() - kScene.size() - 1);
}

std::string query_members(const Query& query, int dimension) {
  std::string out =
      fmt::format("\"x\":{},\"v\":{}", vector_of(query.x, dimension), vector_of(query.v, dimension));
  if (!query.from) return out;
  const std::string object = query_object(query, dimension);
  const std::size_t from = object.find(",\"from\":");
  return out + object.substr(from, object.size() - from - 1);  // it is the last member
}

std::string query_object(const Query& query, int dimension) {
  std::string line;
  append_query_line(line, "0", query, dimension);
  return without_id(std::move(line));
}

std::string answer_object(const Answer& answer, int dimension) {
  std::string line;
  append_answer_line(line, "0", answer, dimension);
  return without_id(std::move(line));
}

std::string printed(const Scene& scene, const std::string& query_members, std::size_t times) {
  const std::string first = fmt::format("printf '%s\\n' {}", shell_quoted(scene_line(scene))),
                    query = shell_quoted("{\"id\":1," + query_members + '}');
  return times == 1 ? fmt::format("{} {}", first, query)
                    : fmt::format("{{ {}; yes {} | head -n {}; }}", first, query, times);
}

std::string array_of(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? "," : "") + json_quoted(text);
  return out + ']';
}

std::string number_or_null(const std::optional<double>& value) {
  std::string out;
  if (value && std::isfinite(*value)) append_number(out, *value);
  return out.empty() ? "null" : out;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

}  // namespace lorentz::cli
