// Scene files: TOML, or JSON with the same keys.
#include <toml++/toml.h>

#include <algorithm>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz {
namespace {

SceneNode node_from(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    SceneNode::Object object;
    for (const auto& [key, value] : *table) object.push_back({std::string(key.str()), node_from(value)});
    return {std::move(object)};
  }
  if (const auto* array = node.as_array()) {
    SceneNode::Array elements;
    for (const auto& value : *array) elements.push_back(node_from(value));
    return {std::move(elements)};
  }
  if (const auto* number = node.as_floating_point()) return {number->get()};
  if (const auto* integer = node.as_integer()) return {static_cast<double>(integer->get())};
  if (const auto* text = node.as_string()) return {text->get()};
  return {};
}

// The length, with its quotes, of the string that a text of TOML begins with.
std::size_t string_length(std::string_view text) {
  const char quote = text[0];
  const std::string_view end = text.substr(0, text.starts_with(std::string(3, quote)) ? 3 : 1);
  std::size_t i = end.size();
  while (i < text.size() && !text.substr(i).starts_with(end)) i += quote == '"' && text[i] == '\\' ? 2 : 1;
  i += end.size();
  while (end.size() == 3 && i < text.size() && text[i] == quote) ++i;  // its last characters may be quotes
  return i;
}

// The parser and its tables are recursive, so a key of 100 000 dotted parts would overflow the stack. Dots in
// strings and comments belong to no key.
void check_dotted_keys(std::string_view text) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.')
      check_depth(++dots);
    else if (c == '"' || c == '\'')
      i += string_length(text.substr(i)) - 1;
    else if (c == '#')
      i = std::min(text.find('\n', i), text.size()) - 1;
    else if (c == ',' || c == '=' || c == '\n' || c == '[' || c == '{')
      dots = 0;
  }
}

SceneNode parse_toml(const std::string& text) {
  check_dotted_keys(text);
  try {
    return node_from(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw InputError("line " + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()));
  }
}

SceneNode parse_json(const std::string& text, const OnUnknownKey& on_unknown_key) {
  json::Document document;
  try {
    document.open(text);
  } catch (const NotJson& error) {  // a document that was not begun must not be asked for its line
    throw InputError(std::string("not JSON: ") + error.what());
  }
  try {
    SceneNode node = read_node(document.value(), "scene", 0);
    if (!document.ended()) throw NotJson("more than one value");
    const SceneNode* inner = node.member("scene");
    if (inner && on_unknown_key) check_keys(node, "", {"scene", "id"}, on_unknown_key);
    return inner ? SceneNode(*inner) : node;
  } catch (const NotJson& error) {
    const auto line = document.line();
    throw InputError((line ? "line " + std::to_string(*line) + ": " : "") + "not JSON: " + error.what());
  }
}

std::string text_of(const std::string& path) {
  LineReader reader(path);
  std::string text;
  for (LineReader::Line line; reader.next(line);) {
    if (line.too_long || text.size() + line.text.size() >= LineReader::kMaxLine)
      throw InputError("is longer than " + std::to_string(LineReader::kMaxLine >> 20) + " MiB; no scene is");
    text.append(line.text);
    text += '\n';
  }
  return text;
}

template <class AScene>
AScene read_text(const std::string& text, const OnUnknownKey& on_unknown_key) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw InputError("is empty: a scene needs dimension and lattices");
  return scene_from<AScene>(text[first] == '{' ? parse_json(text, on_unknown_key) : parse_toml(text),
                            on_unknown_key);
}

template <class AScene>
AScene read(const std::string& path, const OnUnknownKey& on_unknown_key) {
  try {
    return read_text<AScene>(text_of(path), on_unknown_key);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace

Scene read_scene_text(const std::string& text, const OnUnknownKey& on_unknown_key) {
  return read_text<Scene>(text, on_unknown_key);
}

Scene read_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key) {
  return read<Scene>(path, on_unknown_key);
}

RationalScene read_rational_scene_file(const std::string& path, const OnUnknownKey& on_unknown_key) {
  return read<RationalScene>(path, on_unknown_key);
}

std::string exchange_libraries() {
  return "simdjson " + json::library_version() + "\ntoml++ " + std::to_string(TOML_LIB_MAJOR) + '.' +
         std::to_string(TOML_LIB_MINOR) + '.' + std::to_string(TOML_LIB_PATCH);
}

}  // namespace lorentz
