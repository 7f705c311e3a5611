#include "exchange_scene.hpp"

#include <charconv>
#include <cmath>

#include "exchange.hpp"

namespace lorentz {

const SceneNode* SceneNode::member(const char* key) const {
  const Object* object = std::get_if<Object>(&value);
  if (!object) return nullptr;
  for (const auto& [name, node] : *object)
    if (name == key) return &node;
  return nullptr;
}

double parse_hexadecimal(std::string_view text, const std::string& place) {
  const bool negative = !text.empty() && text.front() == '-';
  std::string_view digits = text.substr(negative ? 1 : 0);
  if (!digits.starts_with("0x") && !digits.starts_with("0X"))
    throw InputError(place + ": the string " + json_quoted(text) +
                     " is no hexadecimal float (like \"0x1.8p-1\"); write decimal numbers without quotes");
  digits.remove_prefix(2);
  double value = 0;
  const auto [end, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
  if (status == std::errc::result_out_of_range)
    throw InputError(place + ": " + json_quoted(text) + " is out of binary64's range");
  if (status != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    throw InputError(place + ": " + json_quoted(text) + " is no hexadecimal float (like \"0x1.8p-1\")");
  return negative ? -value : value;
}

double parse_number(std::string_view text) {
  const std::string_view unsigned_text = text.substr(!text.empty() && text.front() == '-' ? 1 : 0);
  if (unsigned_text.starts_with("0x") || unsigned_text.starts_with("0X"))
    return parse_hexadecimal(text, "number");
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(json_quoted(text) + " is no finite number");
  return value;
}

namespace {

const SceneNode& required(const SceneNode& node, const char* key, const std::string& place) {
  const SceneNode* member = node.member(key);
  if (!member) throw InputError((place.empty() ? "scene" : place) + ": " + key + " is missing");
  return *member;
}

double number_at(const SceneNode& node, const std::string& place) {
  if (const double* number = std::get_if<double>(&node.value)) return *number;
  if (const std::string* text = std::get_if<std::string>(&node.value)) return parse_hexadecimal(*text, place);
  throw InputError(place + ": needs a number");
}

const SceneNode::Array& array_at(const SceneNode& node, const std::string& place) {
  if (const auto* array = std::get_if<SceneNode::Array>(&node.value)) return *array;
  throw InputError(place + ": needs an array");
}

std::string item(const std::string& place, std::size_t i) {
  return place + "[" + std::to_string(i) + "]";
}

Vec vector_at(const SceneNode& node, int dimension, const std::string& place) {
  const auto& array = array_at(node, place);
  if (array.size() != static_cast<std::size_t>(dimension))
    throw InputError(place + ": has " + std::to_string(array.size()) +
                     " components, the scene has dimension " + std::to_string(dimension));
  Vec result{};
  for (std::size_t i = 0; i < array.size(); ++i) result[i] = number_at(array[i], item(place, i));
  return result;
}

std::vector<Vec> vectors_at(const SceneNode& node, int dimension, const std::string& place) {
  const auto& array = array_at(node, place);
  if (array.size() != static_cast<std::size_t>(dimension))
    throw InputError(place + ": needs " + std::to_string(dimension) + " vectors, has " +
                     std::to_string(array.size()));
  std::vector<Vec> result;
  for (std::size_t i = 0; i < array.size(); ++i)
    result.push_back(vector_at(array[i], dimension, item(place, i)));
  return result;
}

Atom atom_from(const SceneNode& node, int dimension, const std::string& place) {
  Atom atom;
  atom.position = vector_at(required(node, "position", place), dimension, place + ".position");
  const SceneNode* radius = node.member("radius");
  const SceneNode* semiaxes = node.member("semiaxes");
  if (!radius && !semiaxes) throw InputError(place + ": radius is missing (or semiaxes)");
  if (radius && semiaxes) throw InputError(place + ": has both radius and semiaxes; leave one out");
  if (radius)
    atom.radius = number_at(*radius, place + ".radius");
  else
    atom.semiaxes = vectors_at(*semiaxes, dimension, place + ".semiaxes");
  return atom;
}

}  // namespace

Scene scene_from(const SceneNode& node) {
  Scene scene;
  const double dimension = number_at(required(node, "dimension", ""), "dimension");
  if (dimension != 2 && dimension != 3) throw InputError("dimension: must be 2 or 3");
  scene.dimension = static_cast<int>(dimension);
  const auto& lattices = array_at(required(node, "lattices", ""), "lattices");
  for (std::size_t l = 0; l < lattices.size(); ++l) {
    const std::string place = item("lattices", l);
    Lattice lattice;
    const auto vectors =
        vectors_at(required(lattices[l], "vectors", place), scene.dimension, place + ".vectors");
    std::copy(vectors.begin(), vectors.end(), lattice.vectors.begin());
    const auto& atoms = array_at(required(lattices[l], "atoms", place), place + ".atoms");
    for (std::size_t a = 0; a < atoms.size(); ++a)
      lattice.atoms.push_back(atom_from(atoms[a], scene.dimension, item(place + ".atoms", a)));
    scene.lattices.push_back(std::move(lattice));
  }
  if (auto flaw = flaw_of(scene)) throw InputError(*flaw);
  return scene;
}

}  // namespace lorentz
