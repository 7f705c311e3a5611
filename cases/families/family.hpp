// Families of first-hit queries, each hard in one way.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"

namespace lorentz::cases {

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

}  // namespace lorentz::cases
