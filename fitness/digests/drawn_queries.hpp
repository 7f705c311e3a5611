// Seeded queries of several kinds, the same bits on every computer.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::fitness {

constexpr std::uint64_t kSeed = 20;

/// How queries of one kind are made: by single roundings and square roots, of random words.
using Draw = Query (*)(cases::Random&, const Scene&);

/// A scene, and queries in it of one kind.
struct QueryFamily {
  std::string_view name;
  Scene scene;
  Draw draw;
  bool for_published = true;  ///< the published algorithm does these scenes, in bounded time

  /// Query number `index`: it depends on the family's name and the index only.
  Query query(std::uint64_t index) const;
};

/// Drawn, nearly rational, grazing and far queries, among discs, ellipses, spheres and ellipsoids, in one
/// lattice and in two.
const std::vector<QueryFamily>& query_families();

}  // namespace lorentz::fitness
