#include "src/exchange/exchange_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_number.hpp"

namespace lorentz {
namespace {

// The token of a number, without the white space that may follow it.
std::string_view token_of(json::value value) {
  std::string_view token = value.raw_json_token();
  return token.substr(0, token.find_last_not_of(" \t\n\r") + 1);
}

// The text of a number. On-Demand has not looked at it.
std::string_view number_text(json::value value) {
  const std::string_view token = token_of(value);
  if (is_json_number(token)) return token;
  const auto ascii =
      std::find_if(token.begin(), token.end(), [](char c) { return static_cast<unsigned char>(c) > 126; });
  throw NotJson(json_quoted(token.substr(0, std::min<std::size_t>(40, ascii - token.begin()))) +
                " is no JSON value");
}

// Are a number's digits an integer below 10^19, counted generously? simdjson gathers the digits in 64 bits
// before it rounds, which is right (by the algorithm of Eisel and Lemire) while they fit. It does not always
// see that they do not: simdjson 3.0.1 reads "0." and 20 digits or more modulo 2^64.
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

void skip(json::value value, int depth) {
  switch (value.type()) {
    case json::json_type::array:
      check_depth(depth + 1);
      for (json::value element : value.get_array()) skip(element, depth + 1);
      break;
    case json::json_type::object:
      check_depth(depth + 1);
      each_member(value.get_object(), [&](std::string_view, json::value member) { skip(member, depth + 1); });
      break;
    case json::json_type::number:
      (void)number_text(value);
      break;
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

namespace {

// The nearest number of a JSON number; infinite beyond the range of binary64.
double nearest_number(json::value value) {
  double number;
  if (fits_64_bits(value.raw_json_token()) && !value.get_double().get(number)) return number;
  return *nearest_decimal(number_text(value));
}

}  // namespace

double read_number(json::value value, const std::string& place) {
  if (value.type() == json::json_type::string) return parse_hexadecimal(value.get_string().value(), place);
  if (value.type() == json::json_type::null && !token_of(value).starts_with("null"))
    throw NotJson("no value");  // nan, say
  if (value.type() != json::json_type::number) throw InputError(place + ": needs a number");
  return finite_number(nearest_number(value), place);
}

double read_number_or_infinity(json::value value, const std::string& place) {
  if (value.type() != json::json_type::string) return read_number(value, place);
  const std::string_view text = value.get_string();
  return text == "inf" ? std::numeric_limits<double>::infinity() : parse_hexadecimal(text, place);
}

Integer read_integer(json::value value, const char* key) {
  const bool is_number = value.type() == json::json_type::number;
  std::string_view text;
  if (is_number)
    text = number_text(value);
  else if (value.type() == json::json_type::string)
    text = value.get_string();
  constexpr std::size_t kLongest =
      2500;  // characters: of what is longer, no checker of proofs has to make a number
  if (text.size() <= kLongest)
    if (auto n = Integer::from_decimal(text)) return *n;
  const double number = is_number ? *nearest_decimal(text) : 0.5;
  if (number == std::floor(number) && std::fabs(number) <= 0x1p53)
    return Integer(static_cast<std::int64_t>(number));  // 27.0, as some programs write it
  throw InputError(std::string(key) + ": needs an integer (beyond 2^53: a decimal string)");
}

SceneNode read_node(json::value value, const std::string& place, int depth) {
  switch (value.type()) {
    case json::json_type::array: {
      check_depth(depth + 1);
      SceneNode::Array array;
      for (json::value element : value.get_array())
        array.push_back(read_node(element, place + "[" + std::to_string(array.size()) + "]", depth + 1));
      return {std::move(array)};
    }
    case json::json_type::object: {
      check_depth(depth + 1);
      SceneNode::Object object;
      each_member(value.get_object(), [&](std::string_view key, json::value member) {
        object.push_back({std::string(key), read_node(member, place + "." + std::string(key), depth + 1)});
      });
      return {std::move(object)};
    }
    case json::json_type::number:
      return {nearest_number(value)};
    case json::json_type::string:
      return {std::string(value.get_string().value())};
    default:
      skip(value);
      return {};
  }
}

bool ended(json::document& document) {
  return document.current_location().error() == simdjson::OUT_OF_BOUNDS;
}

}  // namespace lorentz
