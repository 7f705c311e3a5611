// Bins of counts (fit.hpp): whether they are in order, and how sparse ones are merged. Private to
// statistics/theory.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace lorentz::flights {

/// Throws std::invalid_argument for bad bins.
inline void check_bins(std::span<const double> edges, std::span<const std::uint64_t> counts) {
  if (edges.empty() || counts.size() != edges.size() + 1)
    throw std::invalid_argument("bins: one count more than edges is wanted");
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!(edges[i] > (i ? edges[i - 1] : 0)) || !std::isfinite(edges[i]))
      throw std::invalid_argument("bins: the edges have to be above 0, finite, and ascend");
}

/// Merges neighbouring bins, from the left, until each is_full, and the rest with the last that is.
template <class Bin, class IsFull>
std::vector<Bin> merged(const std::vector<Bin>& bins, const IsFull& is_full) {
  std::vector<Bin> all;
  for (const Bin& bin : bins)
    if (all.empty() || is_full(all.back()))
      all.push_back(bin);
    else
      all.back() += bin;
  if (all.size() > 1 && !is_full(all.back())) {
    const Bin rest = all.back();
    all.pop_back();
    all.back() += rest;
  }
  return all;
}

}  // namespace lorentz::flights
