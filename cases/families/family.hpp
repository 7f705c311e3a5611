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
  /// The last: what it is in binary32, if that is something else.
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
  /// Those that cases in the precision have, with what they are there.
  std::vector<Tag> tags(NumberFormat precision = NumberFormat::binary64) const;

  /// A case without flaws; with at least one tag, all of them of tags(). Some 10 us in 2D and 100 us in 3D.
  /// Scene and query consist of numbers of the precision, and what is an ulp in the tags' notes is one of it. A
  /// case is drawn again where rounding would put its start into an obstacle; after some tries it stays there.
  Case make(std::uint64_t seed, std::uint64_t index, NumberFormat precision = NumberFormat::binary64) const;

 private:
  Case attempt(std::uint64_t seed, std::uint64_t index, NumberFormat precision, std::uint64_t scene,
               std::uint64_t query) const;

  std::string_view name_, description_, description_in_binary32_;
  std::vector<Tag> tags_;
  Maker maker_;
};

/// Those that golden sets are made of. Campaigns have some more (target.hpp).
const std::vector<Family>& families();

/// Null if there is none of that name.
const Family* family_named(std::string_view name);

}  // namespace lorentz::cases
