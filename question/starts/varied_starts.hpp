// Starts as programs ask about them: in many cells, at many speeds, some parallel to an axis, some with a limit.
#pragma once

#include <cstdint>
#include <limits>

#include "question/starts/free_starts.hpp"

namespace lorentz::starts {

/// What VariedStarts are, in a few words.
inline constexpr const char* kVariedWords =
    "starts up to 2^10 cells away (1 in 16: 2^30), at speeds of 2^-10 to 2^10; 1 in 16 each from a surface, "
    "with a zero component of v, with a limit; those that meet nothing have one, too";

/// A start, and the limit of its flight.
struct VariedStart {
  Query query;
  double max_time = std::numeric_limits<double>::infinity();
};

/// Numbered starts for tests of engines; physics takes FreeStarts. Each is one of those, uniform or (1 in 16) on a
/// surface, and then changed:
/// - where most of space is empty (single obstacles, rows, layers), every other one is aimed at an obstacle;
/// - it is moved by up to 2^10 cells (1 in 16: 2^30) along each vector of the first lattice;
/// - in 1 of 16, one component of its velocity is made zero;
/// - in 3 of 4, its speed is made 2^k (1 + u), k from -10 to 9, u from 0 to 1;
/// - in 1 of 16, its flight is limited to 1/4 to 4 times that to the first hit;
/// - a flight that meets nothing is limited to about 1000 times the first vector, or radius if there is no vector: some
///   engines would walk on for ever.
/// A change that leads into an obstacle or out of the claim's domain is not made.
class VariedStarts {
 public:
  /// The scene must consist of numbers of the claim's precision. Otherwise as FreeStarts.
  VariedStarts(const Scene& scene, std::uint64_t seed, const Claim& claim = {});

  /// Start number `index`, which depends only on scene, seed, claim and index. It is outside of the domain only if
  /// the start before its changes cannot be brought inside, either. Throws InputError as FreeStarts does.
  VariedStart operator[](std::uint64_t index) const;

 private:
  template <class Change>
  void change(Query& query, const Change& change) const;
  bool is_fit(const Query& query) const;
  double drawn_limit(cases::Random& random, const Query& query) const;

  Scene scene_;
  std::uint64_t seed_;
  Claim claim_;
  FreeStarts uniform_, surface_;
  oracle::Certified certified_;
};

}  // namespace lorentz::starts
