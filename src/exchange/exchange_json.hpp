// JSON values for the exchange formats, read once and from front to back by simdjson, which no other file
// uses. Private to the libraries that read these formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include <lorentz/errors.hpp>
#include "src/exchange/exchange_scene.hpp"

namespace lorentz {

/// A text that is not JSON, or has a value of another type or no member where one is needed. This is not an
/// InputError, because a reader can go on after a bad value, but not after a text that is not JSON.
struct NotJson : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An object in which a key comes twice.
struct KeyTwice : InputError {
  explicit KeyTwice(std::string_view key);
  std::string key;
};

namespace json {

enum class Type { array, object, number, string, boolean, null };

/// A value of a document, for the call that gets it. All but type() and is_null() throw NotJson if the value is of
/// another type; each may be called once.
class Value {
 public:
  Type type() const;
  bool is_null() const;
  std::string_view text() const;  ///< of a string, unescaped; valid as long as the document
  std::string raw() const;        ///< of any type, as it stands in the document except for spaces in arrays
  std::uint64_t natural() const;
  std::int64_t integer() const;
  bool boolean() const;

 private:
  friend struct Inside;
  Value(void* inside, bool is_document) : inside_(inside), is_document_(is_document) {}

  void* inside_;  // simdjson's value; or its document, whose value is an object
  bool is_document_;
};

/// A text, and how far it was read.
class Document {
 public:
  Document();
  ~Document();

  /// Opens a text that is copied, or one that is followed by bytes that may be read: `allocated` bytes in
  /// all.
  void open(std::string_view text);
  void open(std::string_view text, std::size_t allocated);
  Type type();
  /// The document's value: an object, which is seen to be closed; or an array or an object.
  Value object();
  Value value();
  /// True if nothing but white space follows the value that was read.
  bool ended();
  /// The line, from 1, that the reader has reached in an opened copy, if it can tell.
  std::optional<std::size_t> line();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The version of simdjson, like "3.0.1".
std::string library_version();

void visit_members(Value object, const void* read,
                   void (*call)(const void* read, std::string_view key, Value value));
void visit_elements(Value array, const void* read, void (*call)(const void* read, Value value));

/// Calls read(key, value) for each member of an object, in order; then throws KeyTwice if a key came twice. All
/// readers of objects go through here.
template <class Read>
void each_member(Value object, const Read& read) {
  visit_members(object, &read, [](const void* read, std::string_view key, Value value) {
    (*static_cast<const Read*>(read))(key, value);
  });
}

/// Calls read(value) for each element of an array.
template <class Read>
void each_element(Value array, const Read& read) {
  visit_elements(array, &read,
                 [](const void* read, Value value) { (*static_cast<const Read*>(read))(value); });
}

}  // namespace json

/// Throws InputError beyond 64 levels, far more than any format here has. This bounds recursion.
void check_depth(int depth);

/// Passes over a value that lies in `depth` objects and arrays. On-Demand checks only what is looked at, so
/// everything is looked at.
void skip(json::Value value, int depth = 1);

/// A number or a hexadecimal string; throws InputError, naming `place`.
double read_number(json::Value value, const std::string& place);

/// The same, or "inf". (A string of On-Demand may be read only once: its buffer has no room for more.)
double read_number_or_infinity(json::Value value, const std::string& place);

/// The first three numbers of an array, and how many it has; throws InputError, naming `place`.
struct NumbersRead {
  Vec values{};
  std::size_t count = 0;
};
NumbersRead read_numbers(json::Value value, const char* place);

/// An integer, or a decimal string with one, of at most 2500 characters; throws InputError, naming `key`.
Integer read_integer(json::Value value, const char* key);

/// Reads an answer's members into a fresh answer. `components` becomes the number of coordinates of its cell.
/// `keys`, if given, gets all keys, and `ulps` the number under that key. Throws InputError. False for a
/// `golden` header.
bool read_answer(json::Value object, std::string& id, Answer& answer, std::size_t& components,
                 const OnUnknownKey& on_unknown_key = {}, std::set<std::string>* keys = nullptr,
                 double* ulps = nullptr);

/// A value of a scene, which lies in `depth` objects and arrays. A number beyond the range of binary64
/// becomes infinite.
SceneNode read_node(json::Value value, const std::string& place = "scene", int depth = 1);

}  // namespace lorentz
