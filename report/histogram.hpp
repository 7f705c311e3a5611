// Errors over many powers of two, counted in bins of a factor of two.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lorentz::report {

struct Histogram {
  std::size_t exact = 0;              ///< errors of zero
  int first = 0;                      ///< counts[i] errors are in [2^(first + i), 2^(first + i + 1))
  std::vector<std::size_t> counts;    ///< neither the first nor the last is zero
  double mean = 0, p99 = 0, max = 0;  ///< of all errors, including zeros; 0 if there are none

  friend bool operator==(const Histogram&, const Histogram&) = default;
};

/// The errors must be finite and not below zero; throws std::invalid_argument otherwise.
Histogram histogram_of(const std::vector<double>& errors);

/// {"exact":2,"first":-3,"counts":[1,0,4],"mean":..,"p99":..,"max":..}.
void append_json(std::string& out, const Histogram& histogram);

}  // namespace lorentz::report
