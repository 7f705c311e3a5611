// A parsed value of a scene file or line, whatever its syntax was. Private to the exchange library.
#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/rational.hpp>

namespace lorentz {

/// A number, a string, an array, an object, or something that no scene has (monostate).
struct SceneNode {
  struct Member;
  using Array = std::vector<SceneNode>;
  using Object = std::vector<Member>;
  std::variant<std::monostate, double, std::string, Array, Object> value;

  /// The member of that name, or null.
  const SceneNode* member(const char* key) const;
};

struct SceneNode::Member {
  std::string key;
  SceneNode node;
};

/// A Scene, or a RationalScene, exactly. Throws InputError with the place of what is missing or wrong, for
/// example "lattices[0].atoms[1].radius".
template <class AScene>
AScene scene_from(const SceneNode& node, const OnUnknownKey& on_unknown_key);

/// Reports the members of an object, or of each object of an array, that are not known.
void check_keys(const SceneNode& node, const std::string& place,
                std::initializer_list<std::string_view> known, const OnUnknownKey& on_unknown_key);

/// A number, exactly: a binary64, or a text that rational_from accepts. Throws InputError, naming `place`.
Rational rational_at(const SceneNode& node, const std::string& place);

/// The number, unless it is infinite: throws InputError, naming `place`.
inline double finite_number(double number, const std::string& place) {
  if (std::isinf(number)) throw InputError(place + ": is beyond the range of binary64");
  return number;
}

/// "0x1.8p-1" and the like; throws InputError, naming `place`.
double parse_hexadecimal(std::string_view text, const std::string& place);

}  // namespace lorentz
