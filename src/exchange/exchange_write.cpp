#include "src/exchange/exchange_write.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "src/problem/safe_text.hpp"

namespace lorentz {
std::string json_quoted(std::string_view text) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
  const auto plain = std::find_if_not(text.begin(), text.end(), is_plain) - text.begin();  // usually all
  std::string out = "\"";
  out += text.substr(0, plain);
  text.remove_prefix(plain);
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.code == '"' || c.code == '\\') out += '\\';
    if (c.acts)
      append_escape(out, c.code, 4);
    else if (c.is_text)
      out += text.substr(0, c.bytes);
    else
      out += "\ufffd";
    text.remove_prefix(c.bytes);
  }
  return out + '"';
}

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += value > 0 ? "\"inf\"" : (value < 0 ? "\"-inf\"" : "\"nan\"");
    return;
  }
  char text[32];
  // Beyond 2^53 a number is never written as digits only, because a reader might take that for an integer.
  const bool large = std::fabs(value) >= 0x1p53;
  const auto end = large ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific)
                         : std::to_chars(text, text + sizeof text, value);
  out.append(text, end.ptr);
}

void append_integer(std::string& out, const Integer& n) {
  if (n.fits_int64())
    json::append_whole(out, n.int64());
  else
    out += '"' + n.decimal() + '"';
}

namespace {

void add_atom(json::Members& object, const Atom& atom, int dimension) {
  object.add("position", components(atom.position, dimension));
  if (atom.is_ball()) {
    object.add("radius", atom.radius);
    return;
  }
  std::vector<std::span<const double>> semiaxes;
  for (const Vec& axis : atom.semiaxes) semiaxes.push_back(components(axis, dimension));
  object.add("semiaxes", semiaxes);
}

void add_lattice(json::Members& object, const Lattice& lattice, int dimension) {
  std::vector<std::span<const double>> vectors;
  for (int i = 0; i < lattice.rank_in(dimension); ++i)
    vectors.push_back(components(lattice.vectors[i], dimension));
  object.add("vectors", vectors, "atoms",
             json::objects(lattice.atoms,
                           [&](json::Members& one, const Atom& atom) { add_atom(one, atom, dimension); }));
}

// What a hit or an `inside` has besides the obstacle.
void add_times(json::Members& object, const Answer& answer, int dimension) {
  const bool is_hit = answer.outcome == Outcome::hit;
  const std::optional<Detail>& detail = answer.detail;
  if (is_hit && answer.time) object.add("time", *answer.time);
  if (!answer.time_decimal.empty()) object.add("time_decimal", answer.time_decimal);
  if (is_hit && detail)
    object.add("point", components(detail->point, dimension), "normal",
               components(detail->normal, dimension));
  if (detail) object.add("impact_parameter", detail->impact_parameter);
  if (answer.exit_time) object.add("exit_time", *answer.exit_time);
  if (detail)
    object.add("exit_point", components(detail->exit_point, dimension), "exit_normal",
               components(detail->exit_normal, dimension));
}

}  // namespace

void add_obstacle(json::Members& object, const ObstacleId& obstacle, const Components& count) {
  object.add("lattice", obstacle.lattice, "atom", obstacle.atom, "cell",
             components(obstacle.cell, count.of_cells(obstacle.lattice)));
}

void add_scene(json::Members& object, const Scene& scene) {
  object.add("dimension", scene.dimension, "lattices",
             json::objects(scene.lattices, [&](json::Members& one, const Lattice& lattice) {
               add_lattice(one, lattice, scene.dimension);
             }));
}

void add_query(json::Members& object, const Query& query, const Components& count, double max_time) {
  object.add("x", components(query.x, count.of_vectors()), "v", components(query.v, count.of_vectors()));
  if (query.from) object.add("from", [&](json::Members& from) { add_obstacle(from, *query.from, count); });
  if (std::isfinite(max_time)) object.add("max_time", max_time);
}

void add_answer(json::Members& object, const Answer& answer, const Components& count) {
  object.add("outcome", name_of(answer.outcome));
  if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) {
    add_obstacle(object, answer.obstacle, count);
    add_times(object, answer, count.of_vectors());
  }
  if (answer.outcome != Outcome::error) return;
  object.add("message", answer.message);
  if (answer.unsupported) object.add("reason", "unsupported");
}

std::string scene_line(const Scene& scene) {
  (void)Components(scene);
  return json::text_of([&](json::Members& line) { line.add("scene", scene); });
}

std::string decimals(std::span<const Integer> numbers, const char* separator) {
  std::string text;
  for (const Integer& number : numbers) text += (text.empty() ? "" : separator) + number.decimal();
  return text;
}

void append_scene_line(std::string& out, const Scene& scene) {
  out += scene_line(scene) + '\n';
}

void append_query_line(std::string& out, const Id& id, const Query& query, const Components& count,
                       double max_time) {
  json::append(out, [&](json::Members& line) {
    line.add("id", json::Raw{id});
    add_query(line, query, count, max_time);
  });
  out += '\n';
}

void append_answer_line(std::string& out, const Id& id, const Answer& answer, const Components& count) {
  json::append(out, [&](json::Members& line) {
    line.add("id", json::Raw{id});
    add_answer(line, answer, count);
  });
  out += '\n';
}

namespace {

// In the order of Outcome.
constexpr std::array<std::string_view, 6> kOutcomes{"hit", "never", "inside", "later", "undecided", "error"};
static_assert(static_cast<std::size_t>(Outcome::error) + 1 == kOutcomes.size());

}  // namespace

std::string_view name_of(Outcome outcome) {
  return kOutcomes[static_cast<std::size_t>(outcome)];
}

std::optional<Outcome> outcome_named(std::string_view name) {
  const auto found = std::find(kOutcomes.begin(), kOutcomes.end(), name);
  if (found == kOutcomes.end()) return std::nullopt;
  return static_cast<Outcome>(found - kOutcomes.begin());
}

}  // namespace lorentz
