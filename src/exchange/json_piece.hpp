// The pieces of stores: values as JSON, written and read by one list of members. A struct's list is
//   auto members_of(auto& self) { return std::tie(self.hits, self.never); }
// in its namespace. A piece is for this program alone: it has no names, and numbers keep every bit. Whether it
// is damaged is decided by its checksum (report/runs/piece_store.hpp). Private to the libraries and the program.
#pragma once

#include <bit>
#include <tuple>

#include "src/exchange/exchange_json.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::json {

template <class... T>
std::tuple<T&...> members_of(std::tuple<T&...>& self) {
  return self;
}
template <class A, class B>
auto members_of(std::pair<A, B>& self) {
  return std::tie(self.first, self.second);
}

template <class T, std::size_t N>
std::array<T, N>& members_of(std::array<T, N>& self) {
  return self;
}

template <class Range>
struct ElementOf {
  using Type = typename Range::value_type;
};
template <class Range>
requires requires {
  typename Range::mapped_type;
}
struct ElementOf<Range> {
  using Type = std::pair<typename Range::key_type, typename Range::mapped_type>;
};

/// Appends a truth value, a number, an enumerator, a text, an optional, a struct with a list, or a range.
template <class T>
void append_piece(std::string& out, const T& value) {
  if constexpr (std::floating_point<T>) {
    out += std::to_string(std::bit_cast<std::uint64_t>(value));
  } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
    out += std::to_string(value);
  } else if constexpr (std::is_enum_v<T>) {
    append_piece(out, static_cast<std::uint64_t>(value));
  } else if constexpr (std::same_as<T, bool> || std::same_as<T, std::string>) {
    append(out, value);
  } else if constexpr (requires { value.has_value(); }) {
    value ? append_piece(out, *value) : append(out, std::nullopt);
  } else if constexpr (requires { value.begin(); }) {
    array(value, [](std::string& text, const auto& element) { append_piece(text, element); })(out);
  } else {
    std::apply(
        [&](const auto&... member) {
          char before = '[';
          ((out += before, before = ',', append_piece(out, member)), ...);
          out += ']';
        },
        members_of(const_cast<T&>(value)));
  }
}

template <class T>
void read_piece(Value value, T& out) {
  if constexpr (std::floating_point<T>) {
    out = std::bit_cast<double>(value.natural());
  } else if constexpr (std::same_as<T, bool>) {
    out = value.boolean();
  } else if constexpr (std::unsigned_integral<T> || std::is_enum_v<T>) {
    out = static_cast<T>(value.natural());
  } else if constexpr (std::integral<T>) {
    out = static_cast<T>(value.integer());
  } else if constexpr (std::same_as<T, std::string>) {
    out = value.text();
  } else if constexpr (requires { out.has_value(); }) {
    if (!value.is_null()) read_piece(value, out.emplace());
  } else if constexpr (requires { out.insert(out.end(), *out.begin()); }) {
    out.clear();
    each_element(value, [&](Value element) {
      typename ElementOf<T>::Type one;
      read_piece(element, one);
      out.insert(out.end(), std::move(one));
    });
  } else {
    std::size_t next = 0;
    auto&& members = members_of(out);
    each_element(value, [&](Value element) {
      std::size_t i = 0;
      std::apply([&](auto&... member) { ((i++ == next ? read_piece(element, member) : void()), ...); },
                 members);
      ++next;
    });
    if (next != std::tuple_size_v<std::remove_reference_t<decltype(members)>>)
      throw NotJson("a piece of another version");
  }
}

template <class T>
std::string piece_of(const T& value) {
  std::string out;
  append_piece(out, value);
  return out;
}

/// Reads what piece_of wrote. Throws InputError.
template <class T>
void read_piece(std::string_view piece, T&& out) {
  try {
    Document document;
    document.open(piece);
    read_piece(document.value(), out);
  } catch (const std::runtime_error& error) {  // InputError, NotJson
    throw InputError(std::string("is not a piece of such a run: ") + error.what());
  }
}

}  // namespace lorentz::json
