// How often something happened, and how certain its frequency is.
#pragma once

#include <cstddef>
#include <string>

namespace lorentz::report {

/// `count` events in a number of independent trials; the true share of events lies between `low` and `high`.
struct Share {
  std::size_t count = 0;
  double low = 0, high = 1;

  friend bool operator==(const Share&, const Share&) = default;
};

/// The bounds are those of Clopper and Pearson (Biometrika 26, 1934) at 95 %, exact for every count: if the
/// share were `low`, `count` or more events would be seen with probability 2.5 %; if it were `high`, `count`
/// or fewer. Without trials nothing is known: 0 to 1. Throws std::invalid_argument if `count` exceeds
/// `total`.
Share share_of(std::size_t count, std::size_t total);

/// The upper bound, at 95 %, of a share if no event was seen in `total` independent trials. About 3 / total;
/// 1 without trials.
double bound_of_none(std::size_t total);

/// {"count":3,"low":1e-4,"high":2e-3}
void append_json(std::string& out, const Share& share);

}  // namespace lorentz::report
