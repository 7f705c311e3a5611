// What sets the questions apart that an engine fails on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judge/features.hpp"

namespace lorentz::judge {

struct Circumstance {
  std::string text;          ///< a clause after "only "
  double share = 0;          ///< of the right answers: so many have it, too
  bool is_of_depth = false;  ///< that the obstacle is only just entered
  std::function<bool(const Features&)> holds = [](const Features&) { return true; };
};

/// Something that is true of all the failing questions and of at most half of the right ones, and that would
/// be true of all the failing ones by chance with less than 1 in 1000 (share^number). Limits are powers of
/// ten, those of lengths in radii of two. The rarest among the right answers, or nothing.
std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right);

}  // namespace lorentz::judge
