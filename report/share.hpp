// How often something happened, and how sure one can be of it.
#pragma once

#include <cstddef>
#include <string>

namespace lorentz::report {

/// `count` of some number of independent trials; the share of all trials that this is lies between `low` and
/// `high`.
struct Share {
  std::size_t count = 0;
  double low = 0, high = 1;

  friend bool operator==(const Share&, const Share&) = default;
};

/// With the bounds of Clopper and Pearson (Biometrika 26, 1934) at 95 %, exact whatever the count: were the
/// share at `low`, so many or more would be seen with 2.5 %; were it at `high`, so few or fewer. Of no trials
/// nothing is known: 0 to 1. `count` above `total` is an std::invalid_argument.
Share share_of(std::size_t count, std::size_t total);

/// What is known, with 95 %, of a share of which none was seen in `total` independent trials: it is at most
/// this. About 3 / total; 1 of no trials.
double bound_of_none(std::size_t total);

/// {"count":3,"low":1e-4,"high":2e-3}
void append_json(std::string& out, const Share& share);

}  // namespace lorentz::report
