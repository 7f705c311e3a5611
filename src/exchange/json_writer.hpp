// Writes JSON: members in the order of the code, no white space, numbers by append_number. Braces, quotes and
// commas are written here only. Private to the libraries and the program.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lorentz/exchange.hpp>

namespace lorentz::json {

/// A text that is JSON already.
struct Raw {
  std::string_view text;
};

/// null for an infinity and a NaN.
inline std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

class Members;
template <class Fill>
void append_object(std::string& out, const Fill& fill);
template <class Range>
void append_range(std::string& out, const Range& range);

/// A whole number, in quotes beyond 2^53 (append_integer).
template <std::integral T>
void append_whole(std::string& out, T value) {
  char text[24];
  const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  const bool quoted = std::cmp_greater(value, kExact) || std::cmp_less(value, -kExact);
  if (quoted) out += '"';
  out.append(text, static_cast<std::size_t>(end - text));
  if (quoted) out += '"';
}

/// Appends a value: a Raw, a truth value, a number, a text, an optional (null if empty),
/// a function that adds the members of an object or appends a text, a range of such values, or anything that
/// has an append_json(out, value) of its own.
template <class T>
void append(std::string& out, const T& value) {
  if constexpr (std::same_as<T, Raw>) {
    out += value.text;
  } else if constexpr (std::same_as<T, bool>) {
    out += value ? "true" : "false";
  } else if constexpr (std::integral<T>) {
    append_whole(out, value);
  } else if constexpr (std::floating_point<T>) {
    append_number(out, value);
  } else if constexpr (std::same_as<T, Integer>) {
    append_integer(out, value);
  } else if constexpr (std::convertible_to<const T&, std::string_view>) {
    out += json_quoted(value);
  } else if constexpr (std::same_as<T, std::nullopt_t>) {
    out += "null";
  } else if constexpr (requires { value.has_value(); }) {
    value ? append(out, *value) : append(out, std::nullopt);
  } else if constexpr (std::invocable<const T&, Members&>) {
    append_object(out, value);
  } else if constexpr (std::invocable<const T&, std::string&>) {
    value(out);
  } else if constexpr (requires { value.begin(); }) {
    append_range(out, value);
  } else {
    append_json(out, value);
  }
}

/// The members of an object that is being written.
class Members {
 public:
  explicit Members(std::string& out) : out_(out) {}

  /// Adds members: a key and its value, a key and its value, ...
  template <std::size_t N, class T, class... More>
  Members& add(const char (&key)[N], const T& value, const More&... more) {
    char text[N + 3];  // {"key": with the key's end left out
    text[0] = before_, text[1] = '"', text[N + 1] = '"', text[N + 2] = ':';
    std::memcpy(text + 2, key, N - 1);
    out_.append(text, sizeof text);
    before_ = ',';
    append(out_, value);
    if constexpr (sizeof...(more) > 0) add(more...);
    return *this;
  }

  /// Adds a member with a key that may be any text.
  template <class T>
  Members& add_named(std::string_view key, const T& value) {
    out_ += before_;
    out_ += json_quoted(key) + ':';
    before_ = ',';
    append(out_, value);
    return *this;
  }

  /// Adds members that are JSON already.
  Members& add_members(std::string_view members) {
    out_ += before_;
    out_ += members;
    before_ = ',';
    return *this;
  }

  void end() { out_ += before_ == '{' ? "{}" : "}"; }

 private:
  std::string& out_;
  char before_ = '{';
};

template <class Fill>
void append_object(std::string& out, const Fill& fill) {
  Members object(out);
  fill(object);
  object.end();
}

/// The array of the values that each(out, item) appends, with `before` in front of each item.
template <class Items, class Each>
auto array(const Items& items, Each each, std::string_view before = "") {
  return [&items, each, before](std::string& out) {
    char bracket = '[';
    for (const auto& item : items) {
      (out += bracket) += before;
      each(out, item);
      bracket = ',';
    }
    out += bracket == '[' ? "[]" : "]";
  };
}

/// The array of the objects whose members fill(object, item) adds.
template <class Items, class Fill>
auto objects(const Items& items, Fill fill, std::string_view before = "") {
  const auto each = [fill](std::string& out, const auto& item) {
    append_object(out, [&](Members& object) { fill(object, item); });
  };
  return array(items, each, before);
}

template <class Range>
void append_range(std::string& out, const Range& range) {
  array(range, [](std::string& text, const auto& element) { append(text, element); })(out);
}

/// The array of texts that are JSON already.
inline auto raw(const std::vector<std::string>& texts) {
  return array(texts, [](std::string& out, const std::string& text) { out += text; });
}

/// A value as a text, and as a line.
template <class T>
std::string text_of(const T& value) {
  std::string out;
  append(out, value);
  return out;
}
template <class T>
std::string line_of(const T& value) {
  return text_of(value) + '\n';
}

}  // namespace lorentz::json
