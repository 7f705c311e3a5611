// The exact oracle: the truth about first hits, for every scene of balls and ellipsoids on any lattices,
// motifs and superpositions in 2D and 3D.
#pragma once

#include <optional>

#include <lorentz/answer.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// What a caller wants besides the obstacle and the time.
struct Request {
  int digits = 0;                  ///< significant decimal digits of the time, rounded half to even; 0: none
  bool detail = false;             ///< collision point, normal, impact parameter, each correctly rounded
  std::optional<double> max_time;  ///< answer `later` if nothing is entered before this time
};

/// First hits by exact integer arithmetic: every decision is the sign of an integer, and nothing is
/// rounded but the result.
///
///  1. The answer is right: outcome, obstacle (of several entered at one time the smallest lattice, atom,
///     cell), and the time correctly rounded, to nearest, ties to even. The second oracle (walk.hpp),
///     which shares nothing with this one, says the same.
///     held by "Oracle equals walk on generic scenes",
///             "Oracle equals walk on a coarse grid: ties, tangents, rational slopes",
///             "Oracle equals walk on ellipsoids, alone and mixed with balls"
///  2. The same question in another basis, frame, unit or order has the same answer.
///     held by "Rewording: the oracle says the same in other words",
///             "The square and the cube look the same from all their sides"
///  3. Decimal digits and details are correctly rounded, too.
///     held by "Details are correctly rounded"
///  4. Never `undecided`.
///  5. Any number of threads may ask one oracle.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///
/// Units: as in Query: lengths are the scene's, times are such that x + t v is the particle's place.
///
/// Cost: 4 to 7 us (2D) and 15 to 30 us (3D) for each atom of the scene at ordinary radii; it grows with
/// the logarithms of 1/r, of the distance and of the numbers' range (docs/speed.md). The exception: which
/// of very many obstacles around x is the smallest (10^10 of them, in a lattice both dense and skewed)
/// can take long. Allocates.
///
/// Source: this project. oracle/README.md says why it can be trusted.
class Oracle {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in). Reduces its lattices,
  /// once.
  explicit Oracle(const Scene& scene);
  Oracle(Oracle&&) noexcept;
  Oracle& operator=(Oracle&&) noexcept;
  ~Oracle();

  /// The exact answer: `hit` (time correctly rounded to binary64), `inside`, `never`, or `later` if asked
  /// for. An invalid query (flaw_of) yields `error`.
  Answer first_hit(const Query& query, const Request& request = {}) const;

  /// True if x lies in no open obstacle. Throws InputError if x is not finite.
  bool is_free(const Vec& x) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

/// The libraries that the oracle computes with, and their versions.
std::string oracle_libraries();

}  // namespace lorentz::oracle
