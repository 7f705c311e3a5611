// Drawn queries: uniform in the free part of a cell, with isotropic directions.
#pragma once

#include <cstdint>
#include <vector>

#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "compare/listener.hpp"

namespace lorentz::compare {

inline constexpr std::uint64_t kDefaultSeed = 20161115;

/// `count` queries, from the number `first` on; of a superposition, in a box of 1000 cells of the first lattice. Throws InputError if the
/// obstacles leave no free part to be found.
std::vector<Query> draw_queries(const Scene& scene, const oracle::Oracle& oracle, std::uint64_t seed,
                                std::size_t count, const Listener& listener = {}, std::size_t first = 0);

/// `count` flights of a particle that leaves the ball at the origin of a unit scene: uniform on its surface,
/// directions by the cosine law (which is the flux of a gas in equilibrium), `from` that ball.
std::vector<Query> draw_leaving_queries(int dimension, double radius, std::uint64_t seed, std::size_t count);

}  // namespace lorentz::compare
