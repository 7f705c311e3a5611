// A case: a scene, a query, and what is hard about them. A case depends on (seed, family, index, precision)
// and nothing else: not on the order in which cases are made, nor on the thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lorentz/claim.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

struct Case {
  Scene scene;
  Query query;
  std::vector<std::string> tags;
};

/// Adds the tag if `is`, else the other one if there is one. Returns `is`.
inline bool tagged(std::vector<std::string>& tags, bool is, const char* tag, const char* other = nullptr) {
  if (is || other) tags.emplace_back(is ? tag : other);
  return is;
}

/// Draws one of the tags, adds it, and returns it.
inline std::string_view drawn_tag(Random& random, std::vector<std::string>& tags,
                                  std::initializer_list<const char*> all) {
  const char* tag = all.begin()[random.below(all.size())];
  tags.emplace_back(tag);
  return tag;
}

/// A mark of a case, with a note on what the case is meant to break.
struct Tag {
  std::string_view name, note;
  std::string_view note_in_binary32 = note;  ///< empty: no case in binary32 has the tag
};

/// Number of consecutive cases that share a scene, bit for bit, because a stream has a line for each new
/// scene. (The examples at the start of `published-faults` do not share one.)
inline constexpr std::uint64_t kCasesPerScene = 32;

/// What one case is made from.
struct Source {
  std::uint64_t index;
  Random scene;   ///< the same for all cases that share a scene: the scene follows from this alone
  Random random;  ///< the case's own
  NumberFormat precision =
      NumberFormat::binary64;  ///< of the case's numbers: Family::make rounds those with more bits

  bool is_wide() const { return precision == NumberFormat::binary64; }
};

}  // namespace lorentz::cases
