// The targets of campaigns: each is a family of cases, or several in turn. A case depends on (seed, target,
// index, precision) and nothing else.
#pragma once

#include <string_view>
#include <vector>

#include "fuzz/families/family.hpp"

namespace lorentz::cases {

class Target {
 public:
  /// A target of one family, or of several that take turns, kCasesPerScene cases each.
  Target(std::string_view name, std::vector<Family> families) : name_(name), families_(std::move(families)) {}

  std::string_view name() const { return name_; }
  std::string_view description() const { return families_.front().description(); }
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
