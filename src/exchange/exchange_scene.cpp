#include "src/exchange/exchange_scene.hpp"

#include <algorithm>

#include "src/exchange/exchange_number.hpp"

namespace lorentz {

const SceneNode* SceneNode::member(const char* key) const {
  const Object* object = std::get_if<Object>(&value);
  if (!object) return nullptr;
  for (auto member = object->rbegin(); member != object->rend(); ++member)
    if (member->key == key) return &member->node;
  return nullptr;
}

namespace {

// The number that a text was found to be. Throws InputError if it was not one, or is beyond the range of
// binary64.
double finite(std::optional<double> number, std::string_view text, const std::string& place,
              const char* what) {
  if (!number) throw InputError(place + ": " + json_quoted(text) + what);
  if (std::isinf(*number))
    throw InputError(place + ": " + json_quoted(text) + " is beyond the range of binary64");
  return *number;
}

bool looks_hexadecimal(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text.starts_with("0x") || text.starts_with("0X");
}

}  // namespace

double parse_hexadecimal(std::string_view text, const std::string& place) {
  constexpr const char* kWhat =
      " is not a hexadecimal float (like \"0x1.8p-1\"); decimal numbers stand without quotes";
  if (!looks_hexadecimal(text)) throw InputError(place + ": the string " + json_quoted(text) + kWhat);
  return finite(nearest_hexadecimal(text), text, place, kWhat);
}

void check_keys(const SceneNode& node, const std::string& place,
                std::initializer_list<std::string_view> known, const OnUnknownKey& on_unknown_key) {
  if (const auto* array = std::get_if<SceneNode::Array>(&node.value))
    for (const SceneNode& element : *array) check_keys(element, place, known, on_unknown_key);
  if (const auto* object = std::get_if<SceneNode::Object>(&node.value))
    for (const auto& [key, value] : *object)
      if (std::find(known.begin(), known.end(), key) == known.end()) on_unknown_key(place + key);
}

double parse_number(std::string_view text) {
  if (looks_hexadecimal(text)) return parse_hexadecimal(text, "number");
  return finite(nearest_decimal(text), text, "number", " is not a finite number");
}

namespace {

const SceneNode& required(const SceneNode& node, const char* key, const std::string& place) {
  if (!std::holds_alternative<SceneNode::Object>(node.value))
    throw InputError((place.empty() ? "scene" : place) + ": needs an object");
  const SceneNode* member = node.member(key);
  if (!member) throw InputError((place.empty() ? "scene" : place) + ": " + key + " is missing");
  return *member;
}

template <class Number>
Number number_at(const SceneNode& node, const std::string& place);

template <>
double number_at<double>(const SceneNode& node, const std::string& place) {
  if (const double* number = std::get_if<double>(&node.value)) return finite_number(*number, place);
  if (const std::string* text = std::get_if<std::string>(&node.value)) return parse_hexadecimal(*text, place);
  throw InputError(place + ": needs a number");
}

template <>
Rational number_at<Rational>(const SceneNode& node, const std::string& place) {
  return rational_at(node, place);
}

const SceneNode::Array& array_at(const SceneNode& node, const std::string& place) {
  if (const auto* array = std::get_if<SceneNode::Array>(&node.value)) return *array;
  throw InputError(place + ": needs an array");
}

std::string item(const std::string& place, std::size_t i) {
  return place + "[" + std::to_string(i) + "]";
}

template <class Number>
std::array<Number, 3> vector_at(const SceneNode& node, int dimension, const std::string& place) {
  const auto& array = array_at(node, place);
  if (array.size() != static_cast<std::size_t>(dimension))
    throw InputError(place + ": has " + std::to_string(array.size()) +
                     " components, the scene has dimension " + std::to_string(dimension));
  std::array<Number, 3> result{};
  for (std::size_t i = 0; i < array.size(); ++i) result[i] = number_at<Number>(array[i], item(place, i));
  return result;
}

template <class Number>
std::vector<std::array<Number, 3>> vectors_at(const SceneNode& node, int dimension, bool all,
                                              const std::string& place) {
  const auto& array = array_at(node, place);
  const auto most = static_cast<std::size_t>(dimension);
  if (array.size() > most || (all && array.size() < most))
    throw InputError(place + ": needs " + std::to_string(dimension) + " vectors" + (all ? "" : " at most") +
                     ", has " + std::to_string(array.size()));
  std::vector<std::array<Number, 3>> result;
  for (std::size_t i = 0; i < array.size(); ++i)
    result.push_back(vector_at<Number>(array[i], dimension, item(place, i)));
  return result;
}

template <class AnAtom>
AnAtom atom_from(const SceneNode& node, int dimension, const std::string& place) {
  using Number = decltype(AnAtom::radius);
  AnAtom atom;
  atom.position = vector_at<Number>(required(node, "position", place), dimension, place + ".position");
  const SceneNode* radius = node.member("radius");
  const SceneNode* semiaxes = node.member("semiaxes");
  if (!radius && !semiaxes) throw InputError(place + ": radius is missing (or semiaxes)");
  if (radius && semiaxes) throw InputError(place + ": has both radius and semiaxes; leave one out");
  if (radius)
    atom.radius = number_at<Number>(*radius, place + ".radius");
  else
    atom.semiaxes = vectors_at<Number>(*semiaxes, dimension, true, place + ".semiaxes");
  return atom;
}

void check_scene_keys(const SceneNode& node, const OnUnknownKey& on_unknown_key) {
  check_keys(node, "", {"dimension", "lattices"}, on_unknown_key);
  const SceneNode* lattices = node.member("lattices");
  if (!lattices) return;
  check_keys(*lattices, "lattices.", {"vectors", "atoms"}, on_unknown_key);
  if (const auto* all = std::get_if<SceneNode::Array>(&lattices->value))
    for (const SceneNode& lattice : *all)
      if (const SceneNode* atoms = lattice.member("atoms"))
        check_keys(*atoms, "lattices.atoms.", {"position", "radius", "semiaxes"}, on_unknown_key);
}

}  // namespace

template <class AScene>
AScene scene_from(const SceneNode& node, const OnUnknownKey& on_unknown_key) {
  using ALattice = typename decltype(AScene::lattices)::value_type;
  using AnAtom = typename decltype(ALattice::atoms)::value_type;
  using Number = decltype(AnAtom::radius);
  if (on_unknown_key) check_scene_keys(node, on_unknown_key);
  AScene scene;
  const double dimension = number_at<double>(required(node, "dimension", ""), "dimension");
  if (dimension != 2 && dimension != 3) throw InputError("dimension: must be 2 or 3");
  scene.dimension = static_cast<int>(dimension);
  const auto& lattices = array_at(required(node, "lattices", ""), "lattices");
  for (std::size_t l = 0; l < lattices.size(); ++l) {
    const std::string place = item("lattices", l);
    ALattice lattice;
    auto vectors = vectors_at<Number>(required(lattices[l], "vectors", place), scene.dimension, false,
                                      place + ".vectors");
    if (const auto rank = static_cast<int>(vectors.size()); rank < scene.dimension) lattice.rank = rank;
    std::move(vectors.begin(), vectors.end(), lattice.vectors.begin());
    const auto& atoms = array_at(required(lattices[l], "atoms", place), place + ".atoms");
    for (std::size_t a = 0; a < atoms.size(); ++a)
      lattice.atoms.push_back(atom_from<AnAtom>(atoms[a], scene.dimension, item(place + ".atoms", a)));
    scene.lattices.push_back(std::move(lattice));
  }
  if (auto flaw = flaw_of(scene)) throw InputError(*flaw);
  return scene;
}

template Scene scene_from(const SceneNode&, const OnUnknownKey&);
template RationalScene scene_from(const SceneNode&, const OnUnknownKey&);

Rational rational_at(const SceneNode& node, const std::string& place) {
  if (const double* number = std::get_if<double>(&node.value)) return finite_number(*number, place);
  const std::string* text = std::get_if<std::string>(&node.value);
  if (!text) throw InputError(place + ": needs a number");
  if (auto number = rational_from(*text)) return *number;
  throw InputError(place + ": " + json_quoted(*text) +
                   " is not a rational number (like \"1/3\", \"0.1\", \"2.5e-3\", \"0x1.8p-1\")");
}

}  // namespace lorentz
