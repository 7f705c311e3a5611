// Families of first-hit queries, each hard in one way.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "question/cases/case.hpp"

namespace lorentz::cases {

class Family {
 public:
  using Maker = void (*)(Source&, Case&);
  /// `description_in_binary32` is the description of the family in binary32, if that differs.
  Family(std::string_view name, std::string_view description, std::vector<Tag> tags, Maker maker,
         std::string_view description_in_binary32 = {})
      : name_(name),
        description_(description),
        description_in_binary32_(description_in_binary32.empty() ? description : description_in_binary32),
        tags_(std::move(tags)),
        maker_(maker) {}

  std::string_view name() const { return name_; }
  std::string_view description(NumberFormat precision = NumberFormat::binary64) const {
    return precision == NumberFormat::binary64 ? description_ : description_in_binary32_;
  }
  /// The tags that cases in the precision have, with their notes in that precision.
  std::vector<Tag> tags(NumberFormat precision = NumberFormat::binary64) const;

  /// A case without flaws, with at least one tag; all its tags are in tags(). Takes about 10 us in 2D and 100
  /// us in 3D. Scene and query consist of numbers of the precision, and an ulp in the tags' notes is an ulp
  /// of it. If rounding would put the start into an obstacle, the case is drawn again; after 100 tries the
  /// start stays there.
  Case make(std::uint64_t seed, std::uint64_t index, NumberFormat precision = NumberFormat::binary64) const;

 private:
  Case attempt(std::uint64_t seed, std::uint64_t index, NumberFormat precision, std::uint64_t scene,
               std::uint64_t query) const;

  std::string_view name_, description_, description_in_binary32_;
  std::vector<Tag> tags_;
  Maker maker_;
};

/// True if the scene has no flaw, including flaws that only exact arithmetic finds.
bool is_sound(const Scene& scene);

/// The families that golden sets are made of. Campaigns have more.
const std::vector<Family>& families();

/// Null if no family has that name.
const Family* family_named(std::string_view name);

/// A target of campaigns: a family, or several that take turns, kCasesPerScene cases each. A case depends on
/// (seed, target, index, precision) and nothing else.
class Target {
 public:
  Target(std::string_view name, std::vector<Family> families) : name_(name), families_(std::move(families)) {}

  std::string_view name() const { return name_; }
  Case make(std::uint64_t seed, std::uint64_t index, NumberFormat precision = NumberFormat::binary64) const;
  const std::vector<Family>& families() const { return families_; }

 private:
  std::string_view name_;
  std::vector<Family> families_;
};

const std::vector<Target>& targets();

/// One of targets(), or generic-2d or generic-3d alone. Null if no target has that name.
const Target* target_named(std::string_view name);

}  // namespace lorentz::cases
