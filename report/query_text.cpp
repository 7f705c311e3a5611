#include "report/query_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include <lorentz/exchange.hpp>
#include "report/files/messages.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::report {

std::vector<std::string> hexadecimal(const Vec& a, int dimension) {
  std::vector<std::string> texts;
  for (const double x : components(a, dimension)) texts.push_back(fmt::format("{:a}", x));
  return texts;
}

std::string hexadecimal_query(const Query& query, const Components& count, double max_time) {
  return json::text_of([&](json::Members& object) {
    object.add("x", hexadecimal(query.x, count.of_vectors()), "v", hexadecimal(query.v, count.of_vectors()));
    if (query.from) object.add("from", [&](json::Members& from) { add_obstacle(from, *query.from, count); });
    if (std::isfinite(max_time)) object.add("max_time", max_time);
  });
}

std::string query_members(const Query& query, const Components& count, double max_time) {
  const std::string object = report::hexadecimal_query(query, count, max_time);
  return object.substr(1, object.size() - 2);
}

std::string printed(const Scene& scene, const std::string& query_members, std::size_t times) {
  const std::string first = fmt::format("printf '%s\\n' {}", shell_quoted(scene_line(scene))),
                    query = shell_quoted(json::text_of(
                        [&](json::Members&line) { line.add("id", 1).add_members(query_members); }));
  return times == 1 ? fmt::format("{} {}", first, query)
                    : fmt::format("{{ {}; yes {} | head -n {}; }}", first, query, times);
}

std::optional<double> common_radius(const Scene& scene) {
  std::optional<double> radius;
  bool same = true;
  for_each_atom(scene, [&](const Atom& atom) {
    same = same && atom.is_ball() && (!radius || *radius == atom.radius);
    radius = atom.radius;
  });
  return same ? radius : std::nullopt;
}

std::string name_with_radius(const std::string& name, const Scene& scene) {
  const std::optional<double> radius = common_radius(scene);
  return radius ? fmt::format("{}, r = {:g}", name, *radius) : name;
}

}  // namespace lorentz::report
