// The first obstacle of a whole scene, in integers. Private to oracle/.
#pragma once

#include <optional>

#include "oracle/exact/exact_query.hpp"

namespace lorentz::oracle {

/// The first event of a flight: an obstacle that contains its start, or the earliest entry. If it has
/// neither, the flight never enters an obstacle.
template <std::size_t D>
struct Sighting {
  std::optional<ObstacleId> around;  ///< the smallest obstacle that contains x
  Earliest<D> earliest;
};

/// `pass_around`: obstacles that contain x do not count.
template <std::size_t D>
Sighting<D> first_entry(const ExactScene<D>& scene, const ExactQuery<D>& query, bool pass_around = false);

/// Of the obstacles other than `from` that contain x, the one that the line leaves first, and of several the smallest.
/// Looks at two obstacles of each row of the lattice in which some contain x.
template <std::size_t D>
std::optional<ExactEntry<D>> first_left(const ExactScene<D>& scene, const ExactQuery<D>& query);

/// The smallest obstacle other than `from` that contains x.
template <std::size_t D>
std::optional<ObstacleId> smallest_around(const ExactScene<D>& scene, const ExactQuery<D>& query);

}  // namespace lorentz::oracle
