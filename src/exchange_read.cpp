#include <simdjson.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "exchange.hpp"
#include "exchange_scene.hpp"

namespace lorentz {
namespace {

namespace json = simdjson::ondemand;

// simdjson's On-Demand interface checks only what is looked at, so everything is looked at, unknown keys too.
void skip(json::value value) {
  switch (value.type()) {
    case json::json_type::array:
      for (json::value element : value.get_array()) skip(element);
      break;
    case json::json_type::object:
      for (auto field : value.get_object()) {
        (void)field.unescaped_key().value();
        skip(field.value());
      }
      break;
    case json::json_type::number: {
      simdjson::ondemand::number number;
      const auto error = value.get_number().get(number);
      double real;
      if (error && value.get_double().get(real) && error != simdjson::NUMBER_ERROR)
        throw simdjson::simdjson_error(error);
      break;
    }
    case json::json_type::string:
      (void)value.get_string().value();
      break;
    case json::json_type::boolean:
      (void)value.get_bool().value();
      break;
    case json::json_type::null:
      if (!value.is_null()) throw simdjson::simdjson_error(simdjson::N_ATOM_ERROR);
      break;
  }
}

double read_number(json::value value, const char* key) {
  if (value.type() == json::json_type::string) return parse_hexadecimal(value.get_string().value(), key);
  if (value.type() != json::json_type::number) throw InputError(std::string(key) + ": needs a number");
  double number;
  const auto error = value.get_double().get(number);
  if (error) throw InputError(std::string(key) + ": is no finite number");
  return number;
}

struct Components {
  Vec values{};
  std::size_t count = 0;
};

Components read_components(json::value value, const char* key) {
  if (value.type() != json::json_type::array)
    throw InputError(std::string(key) + ": needs an array of numbers");
  Components result;
  for (json::value element : value.get_array()) {
    const double number = read_number(element, key);
    if (result.count < 3) result.values[result.count] = number;
    ++result.count;
  }
  return result;
}

Integer read_integer(json::value value, const char* key) {
  std::string_view text;
  const bool is_string = value.type() == json::json_type::string;
  if (is_string)
    text = value.get_string();
  else if (value.type() == json::json_type::number)
    text = value.raw_json_token();
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  if (auto n = Integer::from_decimal(text)) return *n;
  double number = 0.5;
  if (!is_string && !value.get_double().get(number) && number == std::floor(number) &&
      std::fabs(number) <= 0x1p53)
    return Integer(static_cast<std::int64_t>(number));  // 27.0, as some programs write it
  throw InputError(std::string(key) + ": needs an integer (beyond 2^53: a decimal string)");
}

int read_index(json::value value, const char* key) {
  const Integer n = read_integer(value, key);
  if (!n.fits_int64() || n.int64() < 0 || n.int64() > 1'000'000'000)
    throw InputError(std::string(key) + ": is no index");
  return static_cast<int>(n.int64());
}

struct CellRead {
  Cell cell{};
  std::size_t count = 0;
};

CellRead read_cell(json::value value) {
  if (value.type() != json::json_type::array) throw InputError("cell: needs an array of integers");
  CellRead result;
  for (json::value element : value.get_array()) {
    Integer n = read_integer(element, "cell");
    if (result.count < 3) result.cell[result.count] = std::move(n);
    ++result.count;
  }
  return result;
}

Id read_id(json::value value) {
  switch (value.type()) {
    case json::json_type::string:
      return json_quoted(value.get_string().value());
    case json::json_type::null:
      skip(value);
      return "null";
    default: {
      const Integer n = read_integer(value, "id");
      return n.fits_int64() ? n.decimal() : json_quoted(n.decimal());
    }
  }
}

struct FromRead {
  ObstacleId obstacle;
  std::size_t components = 0;
  bool lattice = false, atom = false;
};

FromRead read_from(json::value value) {
  if (value.type() != json::json_type::object)
    throw InputError("from: needs an object with lattice, atom and cell");
  FromRead from;
  for (auto field : value.get_object()) {
    const std::string_view key = field.unescaped_key();
    if (key == "lattice")
      from.obstacle.lattice = read_index(field.value(), "from.lattice"), from.lattice = true;
    else if (key == "atom")
      from.obstacle.atom = read_index(field.value(), "from.atom"), from.atom = true;
    else if (key == "cell") {
      CellRead cell = read_cell(field.value());
      from.obstacle.cell = std::move(cell.cell);
      from.components = cell.count;
    } else
      skip(field.value());
  }
  if (!from.lattice || !from.atom || from.components == 0)
    throw InputError("from: needs lattice, atom and cell");
  return from;
}

SceneNode read_node(json::value value) {
  switch (value.type()) {
    case json::json_type::array: {
      SceneNode::Array array;
      for (json::value element : value.get_array()) array.push_back(read_node(element));
      return {std::move(array)};
    }
    case json::json_type::object: {
      SceneNode::Object object;
      for (auto field : value.get_object()) {
        std::string key(field.unescaped_key().value());
        object.emplace_back(std::move(key), read_node(field.value()));
      }
      return {std::move(object)};
    }
    case json::json_type::number:
      return {read_number(value, "scene")};
    case json::json_type::string:
      return {std::string(value.get_string().value())};
    default:
      skip(value);
      return {};
  }
}

std::string wrong_dimension(const char* what, std::size_t count, int dimension) {
  return std::string(what) + ": has " + std::to_string(count) + " components, the scene has dimension " +
         std::to_string(dimension);
}

std::string not_json(const LineReader::Line& line, const simdjson::simdjson_error& error) {
  const auto nuls = std::count(line.text.begin(), line.text.end(), '\0');
  if (nuls > 0)
    return "not JSON: holds " + std::to_string(nuls) +
           " NUL bytes (was the file overwritten or cut while it was written?)";
  return std::string("not JSON: ") + error.what();
}

std::string too_long() {
  return "line longer than " + std::to_string(LineReader::kMaxLine >> 20) + " MiB";
}

// True if nothing but white space follows the value that was read.
bool ended(json::document& document) {
  return document.current_location().error() == simdjson::OUT_OF_BOUNDS;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

struct ExchangeReader::Impl {
  json::parser parser;

  json::document open(const LineReader::Line& line) {
    return parser.iterate(line.text.data(), line.text.size(), line.text.size() + LineReader::kPadding);
  }

  void read_fields(const LineReader::Line& line, const Scene* scene, StreamItem& item);
};

ExchangeReader::ExchangeReader() : impl_(std::make_unique<Impl>()) {}
ExchangeReader::~ExchangeReader() = default;

void ExchangeReader::Impl::read_fields(const LineReader::Line& line, const Scene* scene, StreamItem& item) {
  json::document document = open(line);
  Components x, v;
  std::optional<FromRead> from;
  std::optional<SceneNode> scene_node;
  bool golden = false;
  std::string flaw;  // the first; reading goes on, for the id may follow
  for (auto field : document.get_object()) {
    const std::string_view key = field.unescaped_key();
    json::value value = field.value();
    try {
      if (key == "x")
        x = read_components(value, "x");
      else if (key == "v")
        v = read_components(value, "v");
      else if (key == "id")
        item.id = read_id(value);
      else if (key == "from")
        from = read_from(value);
      else if (key == "scene")
        item.bad_scene = true, scene_node = read_node(value);
      else {
        golden |= key == "golden";
        skip(value);
      }
    } catch (const InputError& error) {
      if (flaw.empty()) flaw = error.what();
    }
  }
  if (!ended(document)) throw InputError("not JSON: more than one value in the line");
  if (!flaw.empty()) throw InputError(flaw);
  if (scene_node) {
    item.scene = scene_from(*scene_node);
    item.bad_scene = false;
    item.kind = StreamItem::Kind::scene;
    return;
  }
  if (golden) {
    item.kind = StreamItem::Kind::nothing;
    return;
  }
  if (!scene) throw InputError("no scene before this query");
  const auto d = static_cast<std::size_t>(scene->dimension);
  if (x.count == 0) throw InputError("x is missing");
  if (v.count == 0) throw InputError("v is missing");
  if (x.count != d) throw InputError(wrong_dimension("x", x.count, scene->dimension));
  if (v.count != d) throw InputError(wrong_dimension("v", v.count, scene->dimension));
  if (from && from->components != d)
    throw InputError(wrong_dimension("from.cell", from->components, scene->dimension));
  item.query.x = x.values;
  item.query.v = v.values;
  if (from)
    item.query.from = std::move(from->obstacle);
  else
    item.query.from.reset();
  if (auto wrong = flaw_of(item.query, *scene)) throw InputError(*wrong);
  item.kind = StreamItem::Kind::query;
}

void ExchangeReader::read_query_line(const LineReader::Line& line, const Scene* scene, StreamItem& item) {
  item.kind = StreamItem::Kind::nothing;
  item.id = "null";
  item.bad_scene = false;
  if (!line.too_long && is_blank(line.text)) return;
  try {
    if (line.too_long) throw InputError(too_long());
    impl_->read_fields(line, scene, item);
  } catch (const simdjson::simdjson_error& error) {
    item.kind = StreamItem::Kind::bad;
    item.message = not_json(line, error);
  } catch (const InputError& error) {
    item.kind = StreamItem::Kind::bad;
    item.message = error.what();
  }
  if (item.bad_scene) item.id = "null";
}

namespace {

Outcome outcome_named(std::string_view name) {
  if (name == "hit") return Outcome::hit;
  if (name == "never") return Outcome::never;
  if (name == "inside") return Outcome::inside;
  if (name == "later") return Outcome::later;
  if (name == "undecided") return Outcome::undecided;
  if (name == "error") return Outcome::error;
  throw InputError("outcome: " + json_quoted(name) +
                   " is none of hit, never, inside, later, undecided, error");
}

double read_time(json::value value) {
  if (value.type() == json::json_type::string && value.get_string().value() == "inf")
    return std::numeric_limits<double>::infinity();
  return read_number(value, "time");
}

}  // namespace

bool ExchangeReader::read_answer_line(const LineReader::Line& line, Id& id, Answer& answer) {
  if (!line.too_long && is_blank(line.text)) return false;
  answer = Answer{};
  id = "null";
  try {
    if (line.too_long) throw InputError(too_long());
    json::document document = impl_->open(line);
    bool has_outcome = false, has_cell = false;
    for (auto field : document.get_object()) {
      const std::string_view key = field.unescaped_key();
      json::value value = field.value();
      if (key == "id")
        id = read_id(value);
      else if (key == "outcome")
        answer.outcome = outcome_named(value.get_string().value()), has_outcome = true;
      else if (key == "lattice")
        answer.obstacle.lattice = read_index(value, "lattice");
      else if (key == "atom")
        answer.obstacle.atom = read_index(value, "atom");
      else if (key == "cell")
        answer.obstacle.cell = read_cell(value).cell, has_cell = true;
      else if (key == "time")
        answer.time = read_time(value);
      else if (key == "message")
        answer.message = value.get_string().value();
      else if (key == "reason")
        answer.unsupported = value.get_string().value() == "unsupported";
      else
        skip(value);
    }
    if (!ended(document)) throw InputError("not JSON: more than one value in the line");
    if (!has_outcome) throw InputError("outcome is missing");
    const bool names_obstacle = answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
    if (names_obstacle && !has_cell) throw InputError("cell is missing");
  } catch (const simdjson::simdjson_error& error) {
    throw InputError(not_json(line, error));
  }
  return true;
}

namespace {

SceneNode node_from(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    SceneNode::Object object;
    for (const auto& [key, value] : *table) object.emplace_back(std::string(key.str()), node_from(value));
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

SceneNode parse_toml(const std::string& text) {
  try {
    return node_from(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw InputError("line " + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()));
  }
}

SceneNode parse_json(const std::string& text) {
  try {
    json::parser parser;
    const simdjson::padded_string padded(text);
    json::document document = parser.iterate(padded);
    SceneNode node = read_node(document.get_value());
    if (!ended(document)) throw InputError("not JSON: more than one value");
    const SceneNode* inner = node.member("scene");
    return inner ? SceneNode(*inner) : node;
  } catch (const simdjson::simdjson_error& error) {
    throw InputError(std::string("not JSON: ") + error.what());
  }
}

}  // namespace

Scene read_scene_file(const std::string& path) {
  LineReader reader(path);
  std::string text;
  for (LineReader::Line line; reader.next(line);) {
    if (line.too_long) throw InputError(path + ": " + too_long());
    text.append(line.text);
    text += '\n';
  }
  const auto first = text.find_first_not_of(" \t\r\n");
  try {
    if (first == std::string::npos) throw InputError("is empty: a scene needs dimension and lattices");
    return scene_from(text[first] == '{' ? parse_json(text) : parse_toml(text));
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace lorentz
