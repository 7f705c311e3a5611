// The first obstacle of a whole scene, as integers have it. Private to oracle/.
#pragma once

#include <optional>

#include "oracle/exact/exact_query.hpp"

namespace lorentz::oracle {

/// What a flight meets: an obstacle around its start, or the earliest entry, or neither: it enters none,
/// ever.
template <std::size_t D>
struct Sighting {
  std::optional<ObstacleId> around;  ///< the smallest that contains x
  Earliest<D> earliest;
};

template <std::size_t D>
Sighting<D> first_entry(const ExactScene<D>& scene, const ExactQuery<D>& query);

/// The smallest obstacle that contains x, `from` excepted.
template <std::size_t D>
std::optional<ObstacleId> smallest_around(const ExactScene<D>& scene, const ExactQuery<D>& query);

}  // namespace lorentz::oracle
