// What distinguishes the questions on which an engine fails.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judge/features.hpp"

namespace lorentz::judge {

struct Circumstance {
  std::string text;          ///< a clause after "only "
  double share = 0;          ///< the share of the right answers that have it, too
  bool is_of_depth = false;  ///< says that the obstacle is only just entered
  std::function<bool(const Features&)> holds = [](const Features&) { return true; };
};

/// A property of all failing questions and of at most half of the right ones, which all failing ones would
/// have by chance with a probability below 1 in 1000 (share^number). Limits are powers of ten; those of
/// lengths in radii are powers of two. If several properties qualify, it is the one that is rarest among the
/// right answers; if no property does, nothing.
std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right);

}  // namespace lorentz::judge
