// Queries that are hard for a first-hit program, made from drawn ones.
#pragma once

#include "compare/sampling.hpp"

namespace lorentz::compare {

/// How the queries of a measurement are made.
enum class Difficulty {
  drawn,          ///< uniform starts, isotropic directions
  near_rational,  ///< directions a few ulps from small integers: corridors, and flights of 1e15 cells out of
                  ///< them
  grazing  ///< the first ball is passed or met within r 2^-10 to r 2^-50 of its edge; a few, where no start
           ///< near the drawn one does that, stay as drawn
};

const char* name_of(Difficulty difficulty);

/// `count` queries for a scene of balls; depends on the seed only.
std::vector<Query> hard_queries(Difficulty difficulty, const Scene& scene, const oracle::Oracle& oracle,
                                std::uint64_t seed, std::size_t count, const Listener& listener = {});

}  // namespace lorentz::compare
