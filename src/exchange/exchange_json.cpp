#include "src/exchange/exchange_json.hpp"

#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_number.hpp"

namespace lorentz {

namespace ondemand = simdjson::ondemand;

namespace {

// The token of a value that is neither an array nor an object, without the white space that may follow it.
std::string_view token_of(ondemand::value& value) {
  const std::string_view token = value.raw_json_token();
  return token.substr(0, token.find_last_not_of(" \t\n\r") + 1);
}

}  // namespace

namespace json {

// Access to what a value points to.
struct Inside {
  static ondemand::value& of(Value value) { return *static_cast<ondemand::value*>(value.inside_); }
  static Value in(ondemand::value& value) { return {&value, false}; }
  static Value in(ondemand::document& document) { return {&document, true}; }
  static simdjson::simdjson_result<ondemand::object> object_in(Value value) {
    if (value.is_document_) return static_cast<ondemand::document*>(value.inside_)->get_object();
    return of(value).get_object();
  }
};

namespace {

ondemand::value& inside(Value value) {
  return Inside::of(value);
}

template <class T>
T known(simdjson::simdjson_result<T>&& result) {
  T value{};
  if (const auto error = std::move(result).get(value)) throw NotJson(simdjson::error_message(error));
  return value;
}
template <class T>
T known(const T& value) {
  return value;
}

Type known_type(simdjson::simdjson_result<ondemand::json_type>&& result) {
  switch (known(std::move(result))) {
    case ondemand::json_type::array:
      return Type::array;
    case ondemand::json_type::object:
      return Type::object;
    case ondemand::json_type::number:
      return Type::number;
    case ondemand::json_type::string:
      return Type::string;
    case ondemand::json_type::boolean:
      return Type::boolean;
    default:
      return Type::null;
  }
}

// The keys of an object that were seen.
class Keys {
 public:
  // False if the key was seen before. The key's text must outlive this object.
  bool add(std::string_view key) {
    const auto hash = key.size() << 8 | (key.empty() ? 0 : static_cast<unsigned char>(key[0]));
    for (std::size_t i = 0; i < count_; ++i)
      if (hashes_[i] == hash && std::memcmp(few_[i], key.data(), key.size()) == 0) return false;
    if (count_ == kFew) return (many_ ? *many_ : many_.emplace()).insert(key).second;
    few_[count_] = key.data();
    hashes_[count_++] = hash;
    return true;
  }

 private:
  static constexpr std::size_t kFew = 8;
  std::array<std::size_t, kFew> hashes_;
  std::array<const char*, kFew> few_;
  std::size_t count_ = 0;
  std::optional<std::set<std::string_view>> many_;  // for objects with more
};

}  // namespace

Type Value::type() const {
  return is_document_ ? Type::object : known_type(inside(*this).type());
}
bool Value::is_null() const {
  return known(inside(*this).is_null());
}
std::string_view Value::text() const {
  return known(inside(*this).get_string());
}
std::string Value::raw() const {
  if (type() == Type::object) {
    auto object = known(Inside::object_in(*this));
    return std::string(known(object.raw_json()));
  }
  if (type() == Type::array) {
    std::string text;
    each_element(*this, [&](Value element) { text += (text.empty() ? "[" : ",") + element.raw(); });
    return text.empty() ? "[]" : text + ']';
  }
  return std::string(token_of(inside(*this)));
}
std::uint64_t Value::natural() const {
  return known(inside(*this).get_uint64());
}
std::int64_t Value::integer() const {
  return known(inside(*this).get_int64());
}
bool Value::boolean() const {
  return known(inside(*this).get_bool());
}

struct Document::Impl {
  simdjson::padded_string copy;
  ondemand::parser parser;
  ondemand::document document;
  ondemand::value value;  // of the document
};

Document::Document() : impl_(std::make_unique<Impl>()) {}
Document::~Document() = default;

void Document::open(std::string_view text) {
  impl_->copy = simdjson::padded_string(text);
  impl_->document = known(impl_->parser.iterate(impl_->copy));
}
void Document::open(std::string_view text, std::size_t allocated) {
  impl_->document = known(impl_->parser.iterate(text.data(), text.size(), allocated));
}
Type Document::type() {
  return known_type(impl_->document.type());
}
Value Document::object() {
  return Inside::in(impl_->document);
}
Value Document::value() {
  impl_->value = known(impl_->document.get_value());
  return Inside::in(impl_->value);
}
bool Document::ended() {
  return impl_->document.current_location().error() == simdjson::OUT_OF_BOUNDS;
}

std::optional<std::size_t> Document::line() {
  const char* place = nullptr;
  if (impl_->document.current_location().get(place)) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::count(static_cast<const char*>(impl_->copy.data()), place, '\n'));
}

std::string library_version() {
  std::string text;
  for (const int part : {simdjson::SIMDJSON_VERSION_MAJOR, simdjson::SIMDJSON_VERSION_MINOR,
                         simdjson::SIMDJSON_VERSION_REVISION})
    text += (text.empty() ? "" : ".") + std::to_string(part);
  return text;
}

void visit_members(Value object, const void* read,
                   void (*call)(const void* read, std::string_view key, Value value)) {
  Keys keys;
  std::optional<std::string_view> twice;
  auto members = known(Inside::object_in(object));
  for (auto result : members) {
    ondemand::field field = known(std::move(result));
    const std::string_view key = known(field.unescaped_key());
    if (!keys.add(key) && !twice) twice = key;
    call(read, key, Inside::in(field.value()));
  }
  if (twice) throw KeyTwice(*twice);
}

void visit_elements(Value array, const void* read, void (*call)(const void* read, Value value)) {
  auto elements = known(inside(array).get_array());
  for (auto result : elements) {
    ondemand::value element = known(std::move(result));
    call(read, Inside::in(element));
  }
}

}  // namespace json

namespace {

// The text of a number. It is checked here, because On-Demand has not looked at it.
std::string_view number_text(ondemand::value& value) {
  const std::string_view token = token_of(value);
  if (is_json_number(token)) return token;
  const auto ascii =
      std::find_if(token.begin(), token.end(), [](char c) { return static_cast<unsigned char>(c) > 126; });
  throw NotJson(json_quoted(token.substr(0, std::min<std::size_t>(40, ascii - token.begin()))) +
                " is not a JSON value");
}

// Are a number's digits certainly an integer below 10^19? simdjson gathers the digits in 64 bits before it
// rounds, which is right (by the algorithm of Eisel and Lemire) while they fit. It does not always notice
// when they do not fit: simdjson 3.0.1 reads "0." and 20 digits or more modulo 2^64.
bool fits_64_bits(std::string_view token) {
  if (token.starts_with('-')) token.remove_prefix(1);
  if (token.starts_with("0.")) token.remove_prefix(2);
  return token.size() <= 19;
}

}  // namespace

KeyTwice::KeyTwice(std::string_view key)
    : InputError("the key " + json_quoted(key) + " comes twice in an object"), key(key) {}

void check_depth(int depth) {
  constexpr int kMaxDepth = 64;
  if (depth > kMaxDepth) throw InputError("nested deeper than " + std::to_string(kMaxDepth) + " levels");
}

void skip(json::Value value, int depth) {
  switch (value.type()) {
    case json::Type::array:
      check_depth(depth + 1);
      each_element(value, [&](json::Value element) { skip(element, depth + 1); });
      break;
    case json::Type::object:
      check_depth(depth + 1);
      each_member(value, [&](std::string_view, json::Value member) { skip(member, depth + 1); });
      break;
    case json::Type::number:
      (void)number_text(json::inside(value));
      break;
    case json::Type::string:
      (void)value.text();
      break;
    case json::Type::boolean:
      (void)value.boolean();
      break;
    case json::Type::null:
      if (!value.is_null()) throw NotJson(simdjson::error_message(simdjson::N_ATOM_ERROR));
      break;
  }
}

namespace {

// The binary64 nearest to a JSON number; infinite beyond the range of binary64.
double nearest_number(ondemand::value& value) {
  double number;
  if (fits_64_bits(value.raw_json_token()) && !value.get_double().get(number)) return number;
  return *nearest_decimal(number_text(value));
}

template <class Place>
double number_of(ondemand::value& value, const Place& place) {
  const ondemand::json_type type = json::known(value.type());
  if (type == ondemand::json_type::string) return parse_hexadecimal(json::known(value.get_string()), place);
  if (type == ondemand::json_type::null && !token_of(value).starts_with("null"))
    throw NotJson("no value");  // for example nan
  if (type != ondemand::json_type::number) throw InputError(std::string(place) + ": needs a number");
  const double number = nearest_number(value);
  return std::isinf(number) ? finite_number(number, place) : number;
}

}  // namespace

double read_number(json::Value value, const std::string& place) {
  return number_of(json::inside(value), place);
}

NumbersRead read_numbers(json::Value value, const char* place) {
  if (value.type() != json::Type::array) throw InputError(std::string(place) + ": needs an array of numbers");
  NumbersRead read;
  auto array = json::known(json::inside(value).get_array());
  for (auto result : array) {
    auto element = json::known(std::move(result));
    const double number = number_of(element, place);
    if (read.count < 3) read.values[read.count] = number;
    ++read.count;
  }
  return read;
}

double read_number_or_infinity(json::Value value, const std::string& place) {
  if (value.type() != json::Type::string) return read_number(value, place);
  const std::string_view text = value.text();
  return text == "inf" ? std::numeric_limits<double>::infinity() : parse_hexadecimal(text, place);
}

Integer read_integer(json::Value value, const char* key) {
  const bool is_number = value.type() == json::Type::number;
  std::string_view text;
  if (is_number)
    text = number_text(json::inside(value));
  else if (value.type() == json::Type::string)
    text = value.text();
  constexpr std::size_t kLongest =
      2500;  // characters, so that no checker of proofs has to convert a longer one
  if (text.size() <= kLongest)
    if (auto n = Integer::from_decimal(text)) return *n;
  const double number = is_number ? *nearest_decimal(text) : 0.5;
  if (number == std::floor(number) && std::fabs(number) <= 0x1p53)
    return Integer(static_cast<std::int64_t>(number));  // 27.0, as some programs write it
  throw InputError(std::string(key) + ": needs an integer (beyond 2^53: a decimal string)");
}

SceneNode read_node(json::Value value, const std::string& place, int depth) {
  switch (value.type()) {
    case json::Type::array: {
      check_depth(depth + 1);
      SceneNode::Array array;
      each_element(value, [&](json::Value element) {
        array.push_back(read_node(element, place + "[" + std::to_string(array.size()) + "]", depth + 1));
      });
      return {std::move(array)};
    }
    case json::Type::object: {
      check_depth(depth + 1);
      SceneNode::Object object;
      each_member(value, [&](std::string_view key, json::Value member) {
        object.push_back({std::string(key), read_node(member, place + "." + std::string(key), depth + 1)});
      });
      return {std::move(object)};
    }
    case json::Type::number:
      return {nearest_number(json::inside(value))};
    case json::Type::string:
      return {std::string(value.text())};
    default:
      skip(value);
      return {};
  }
}

}  // namespace lorentz
