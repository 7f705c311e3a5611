// Families of first-hit queries, each hard in one way. A case follows from (seed, family, index) and nothing
// else: it is the same whoever asks, in whatever order, on whatever thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "problem.hpp"
#include "random.hpp"

namespace lorentz::fuzz {

struct Case {
  Scene scene;
  Query query;
  std::vector<std::string> tags;
};

/// What a case may be marked with, and what it is out to break.
struct Tag {
  std::string_view name, note;
};

/// So many cases in a row share a scene, bit for bit, because a stream has a line for each new scene. (The
/// examples that `published-faults` begins with do not.)
inline constexpr std::uint64_t kCasesPerScene = 32;

/// What one case is made from.
struct Source {
  std::uint64_t index;
  Random scene;   ///< the same for all cases that share a scene: the scene follows from this alone
  Random random;  ///< the case's own
};

class Family {
 public:
  using Maker = Case (*)(Source&);
  Family(std::string_view name, std::string_view description, std::vector<Tag> tags, Maker maker)
      : name_(name), description_(description), tags_(std::move(tags)), maker_(maker) {}

  std::string_view name() const { return name_; }
  std::string_view description() const { return description_; }
  const std::vector<Tag>& tags() const { return tags_; }

  /// A case without flaws; with at least one tag, all of them of tags(). Some 10 us in 2D and 100 us in 3D.
  Case make(std::uint64_t seed, std::uint64_t index) const;

 private:
  std::string_view name_, description_;
  std::vector<Tag> tags_;
  Maker maker_;
};

/// Those that golden sets are made of. Campaigns have some more (target.hpp).
const std::vector<Family>& families();

/// Null if there is none of that name.
const Family* family_named(std::string_view name);

}  // namespace lorentz::fuzz
