#include <algorithm>
#include <charconv>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "src/problem/safe_text.hpp"

namespace lorentz {
namespace {

void append_escape(std::string& out, char32_t code) {
  constexpr char kHex[] = "0123456789abcdef";
  out += "\\u";
  for (int shift = 12; shift >= 0; shift -= 4) out += kHex[code >> shift & 15];
}

}  // namespace

std::string json_quoted(std::string_view text) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
  const auto plain = std::find_if_not(text.begin(), text.end(), is_plain) - text.begin();  // mostly all of it
  std::string out = "\"";
  out += text.substr(0, plain);
  text.remove_prefix(plain);
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.code == '"' || c.code == '\\') out += '\\';
    if (c.acts)
      append_escape(out, c.code);
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
  // Beyond 2^53 never as digits only, which a reader might take for an integer.
  const bool large = std::fabs(value) >= 0x1p53;
  const auto end = large ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific)
                         : std::to_chars(text, text + sizeof text, value);
  out.append(text, end.ptr);
}

void append_integer(std::string& out, const Integer& n) {
  constexpr std::int64_t kExactInBinary64 = std::int64_t{1} << 53;
  if (!n.fits_int64()) {
    out += '"' + n.decimal() + '"';
    return;
  }
  const bool small = n.int64() >= -kExactInBinary64 && n.int64() <= kExactInBinary64;
  char text[24];
  const auto end = std::to_chars(text, text + sizeof text, n.int64()).ptr;
  if (!small) out += '"';
  out.append(text, end);
  if (!small) out += '"';
}

namespace {

void append_vector(std::string& out, const Vec& a, int dimension) {
  for (int i = 0; i < dimension; ++i) {
    out += i == 0 ? '[' : ',';
    append_number(out, a[i]);
  }
  out += ']';
}

void append_obstacle(std::string& out, const ObstacleId& obstacle, int dimension) {
  out += "\"lattice\":";
  append_integer(out, Integer(obstacle.lattice));
  out += ",\"atom\":";
  append_integer(out, Integer(obstacle.atom));
  out += ",\"cell\":";
  for (int i = 0; i < dimension; ++i) {
    out += i == 0 ? '[' : ',';
    append_integer(out, obstacle.cell[i]);
  }
  out += ']';
}

// What a hit has besides the obstacle.
void append_hit(std::string& out, const Answer& answer, int dimension) {
  if (answer.time) {
    out += ",\"time\":";
    append_number(out, *answer.time);
  }
  if (!answer.time_decimal.empty()) out += ",\"time_decimal\":\"" + answer.time_decimal + '"';
  if (!answer.detail) return;
  out += ",\"point\":";
  append_vector(out, answer.detail->point, dimension);
  out += ",\"normal\":";
  append_vector(out, answer.detail->normal, dimension);
  out += ",\"impact_parameter\":";
  append_number(out, answer.detail->impact_parameter);
}

}  // namespace

void append_scene_line(std::string& out, const Scene& scene) {
  out += "{\"scene\":{\"dimension\":" + std::to_string(scene.dimension) + ",\"lattices\":[";
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    out += l == 0 ? "{\"vectors\":[" : ",{\"vectors\":[";
    for (int i = 0; i < scene.dimension; ++i) {
      if (i > 0) out += ',';
      append_vector(out, lattice.vectors[i], scene.dimension);
    }
    out += "],\"atoms\":[";
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a) {
      const Atom& atom = lattice.atoms[a];
      out += a == 0 ? "{\"position\":" : ",{\"position\":";
      append_vector(out, atom.position, scene.dimension);
      if (atom.is_ball()) {
        out += ",\"radius\":";
        append_number(out, atom.radius);
      } else {
        for (std::size_t i = 0; i < atom.semiaxes.size(); ++i) {
          out += i == 0 ? ",\"semiaxes\":[" : ",";
          append_vector(out, atom.semiaxes[i], scene.dimension);
        }
        out += ']';
      }
      out += '}';
    }
    out += "]}";
  }
  out += "]}}\n";
}

void append_query_line(std::string& out, const Id& id, const Query& query, int dimension) {
  out += "{\"id\":" + id + ",\"x\":";
  append_vector(out, query.x, dimension);
  out += ",\"v\":";
  append_vector(out, query.v, dimension);
  if (query.from) {
    out += ",\"from\":{";
    append_obstacle(out, *query.from, dimension);
    out += '}';
  }
  out += "}\n";
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::hit:
      return "hit";
    case Outcome::never:
      return "never";
    case Outcome::inside:
      return "inside";
    case Outcome::later:
      return "later";
    case Outcome::undecided:
      return "undecided";
    case Outcome::error:
      break;
  }
  return "error";
}

void append_answer_line(std::string& out, const Id& id, const Answer& answer, int dimension) {
  out += "{\"id\":";
  out += id;
  out += ",\"outcome\":\"";
  out += name_of(answer.outcome);
  out += '"';
  if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) {
    out += ',';
    append_obstacle(out, answer.obstacle, dimension);
  }
  if (answer.outcome == Outcome::hit) append_hit(out, answer, dimension);
  if (answer.outcome == Outcome::error) {
    out += ",\"message\":" + json_quoted(answer.message);
    if (answer.unsupported) out += ",\"reason\":\"unsupported\"";
  }
  out += "}\n";
}

}  // namespace lorentz
