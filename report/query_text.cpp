#include "report/query_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include <lorentz/exchange.hpp>
#include "report/files/messages.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

using Texts = std::vector<std::string>;

// The first `dimension` components, as "0x1.8p-1".
Texts hexadecimal(const Vec& a, int dimension) {
  Texts texts;
  for (const double x : components(a, dimension)) texts.push_back(fmt::format("{:a}", x));
  return texts;
}

}  // namespace

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

namespace {

std::string literal(const Texts& numbers) {
  return fmt::format("{{{}}}", fmt::join(numbers, ", "));
}

// The size of an obstacle as C++, with its meaning as a comment.
std::string size_literal(const Atom& atom, int dimension) {
  if (atom.is_ball()) return fmt::format("r = {:a};  // the ball", atom.radius);
  std::string text = fmt::format("a[{0}][{0}] = {{", dimension);
  for (std::size_t i = 0; i < atom.semiaxes.size(); ++i)
    text += (i ? ", " : "") + literal(hexadecimal(atom.semiaxes[i], dimension));
  return text + "};  // c + the sum of y[i] a[i], |y| < 1";
}

const char* words_for(int discriminant) {
  return discriminant > 0   ? "positive: the line meets it"
         : discriminant < 0 ? "negative: the line misses it"
                            : "zero: the line touches it";
}

std::string cpp_of(const oracle::Crossing& crossing, const Atom& atom, const Query& query, int dimension) {
  Texts centre(crossing.centre.begin(), crossing.centre.begin() + dimension), nearest;
  for (const std::string& text : centre)
    nearest.push_back(fmt::format("{:a}", std::strtod(text.c_str(), nullptr)));
  std::string text =
      fmt::format("const double x[] = {}, v[] = {};  // the ray x + t v\n",
                  literal(hexadecimal(query.x, dimension)), literal(hexadecimal(query.v, dimension)));
  text += fmt::format("const double c[] = {}, {}\n", literal(nearest), size_literal(atom, dimension));
  if (!crossing.is_centre_binary64)
    text += fmt::format("// c is rounded here; exactly it is {}\n", literal(centre));
  text += fmt::format("// The exact discriminant is {}", words_for(crossing.discriminant));
  return text + (crossing.discriminant > 0
                     ? fmt::format(", and enters it at t = {}.\n", crossing.time_decimal)
                     : std::string(".\n"));
}

}  // namespace

Primitive primitive_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                       const ObstacleId& obstacle) {
  const oracle::Crossing crossing = margins.crossing(query, obstacle);
  const auto& atoms = scene.lattices[static_cast<std::size_t>(obstacle.lattice)].atoms;
  const Atom& atom = atoms[static_cast<std::size_t>(obstacle.atom)];
  const int d = scene.dimension;
  const std::string json = json::text_of([&](json::Members& object) {
    object.add("origin", hexadecimal(query.x, d), "direction", hexadecimal(query.v, d), "centre",
               Texts(crossing.centre.begin(), crossing.centre.begin() + d));
    if (atom.is_ball()) {
      object.add("radius", fmt::format("{:a}", atom.radius));
    } else {
      std::vector<Texts> axes;
      for (const Vec& axis : atom.semiaxes) axes.push_back(hexadecimal(axis, d));
      object.add("semiaxes", axes);
    }
    object.add("discriminant", crossing.discriminant, "entry_time",
               crossing.discriminant > 0 ? std::optional(crossing.time_decimal) : std::nullopt);
  });
  return {json, cpp_of(crossing, atom, query, d)};
}

}  // namespace lorentz::report
