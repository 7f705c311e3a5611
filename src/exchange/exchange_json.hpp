// JSON values as the exchange formats have them, on simdjson's On-Demand interface. Private to the libraries
// that read these.
#pragma once

#include <simdjson.h>

#include <array>
#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include <lorentz/errors.hpp>
#include <lorentz/problem.hpp>
#include "src/exchange/exchange_scene.hpp"

namespace lorentz {

namespace json = simdjson::ondemand;

/// A text that is no JSON (besides what simdjson::simdjson_error says). Not an InputError: behind a bad value
/// a reader goes on, behind what is no JSON it cannot.
struct NotJson : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An object in which a key comes twice.
struct KeyTwice : InputError {
  explicit KeyTwice(std::string_view key);
  std::string key;
};

/// The keys of an object that were seen.
class Keys {
 public:
  /// False if the key was seen before. Of texts that outlive this.
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
  std::optional<std::set<std::string_view>> many_;  // of objects with more
};

/// Calls read(key, value) for each member, in order; then throws KeyTwice if a key came twice. All readers of
/// objects go through here.
template <class Read>
void each_member(json::object object, const Read& read) {
  Keys keys;
  std::optional<std::string_view> twice;
  for (auto field : object) {
    const std::string_view key = field.unescaped_key();
    if (!keys.add(key) && !twice) twice = key;
    read(key, field.value());
  }
  if (twice) throw KeyTwice(*twice);
}

/// Throws InputError beyond 64 levels, far more than any format here has. Recursion is bounded by this.
void check_depth(int depth);

/// Passes over a value that is in `depth` objects and arrays. On-Demand checks only what is looked at, so
/// everything is looked at.
void skip(json::value value, int depth = 1);

/// A number or a hexadecimal string; throws InputError, naming `place`.
double read_number(json::value value, const std::string& place);

/// The same, or "inf". (A string of On-Demand may be read only once: its buffer has no room for more.)
double read_number_or_infinity(json::value value, const std::string& place);

/// An integer, or a decimal string with one, of at most 2500 characters; throws InputError, naming `key`.
Integer read_integer(json::value value, const char* key);

/// An answer's members into a fresh answer; `components` becomes the number of its cell's coordinates;
/// `keys`, if given, gets all keys. Throws InputError. False for a `golden` header.
bool read_answer(json::object object, std::string& id, Answer& answer, std::size_t& components,
                 const OnUnknownKey& on_unknown_key = {}, std::set<std::string>* keys = nullptr);

/// A value of a scene, which is in `depth` objects and arrays. A number beyond the range of binary64 is
/// infinite.
SceneNode read_node(json::value value, const std::string& place = "scene", int depth = 1);

/// True if nothing but white space follows the value that was read.
bool ended(json::document& document);

}  // namespace lorentz
