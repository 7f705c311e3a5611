// Seeded queries of several kinds, with the same bits on every computer.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::digests {

constexpr std::uint64_t kSeed = 20;

/// A function that makes queries of one kind from random words, with single roundings and square roots only.
using Draw = Query (*)(cases::Random&, const Scene&);

/// A scene, and queries of one kind in it.
struct QueryFamily {
  std::string_view name;
  Scene scene;
  Draw draw;
  bool for_published = true;  ///< the published algorithm supports the scene, in bounded time

  /// Query number `index`. It depends only on the family's name and the index.
  Query query(std::uint64_t index) const;
};

/// Drawn, nearly rational, grazing and far queries in scenes of discs, ellipses, spheres and ellipsoids, with
/// one lattice and with two.
const std::vector<QueryFamily>& query_families();

}  // namespace lorentz::digests
