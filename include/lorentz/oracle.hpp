// The exact oracle: exact first hits for every scene of balls and ellipsoids in 2D and 3D. A scene has any
// number of lattices, and a lattice any number of atoms. (An atom is a ball or an ellipsoid that a lattice
// repeats in every cell.)
#pragma once

#include <optional>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// What to compute besides the obstacle and the time.
struct Request {
  int digits = 0;                  ///< significant decimal digits of the time, rounded half to even; 0: none
  bool detail = false;             ///< Answer::detail and exit_time, each correctly rounded
  std::optional<double> max_time;  ///< answer `later` if nothing is entered before; infinity: no limit
  /// The rule for a start inside; `unsupported` is as `inside`. Hits by the rules `zero` and `exit` have no detail.
  StartInside start = StartInside::inside;
};

/// First hits by exact integer arithmetic: every decision is the sign of an integer, and only the result is
/// rounded.
///
///  1. The answer is right: the outcome, the obstacle, and the time, correctly rounded to nearest, ties to
///     even. If several obstacles are entered at the same time, or several contain x, the answer names the
///     first in the order (lattice, atom, cell). The second oracle (walk.hpp) has code and arithmetic of its
///     own; where it answers, the answers are the same.
///  2. A scene and a query may be written in another form: another basis of the lattice, axes exchanged or
///     reflected, another origin, other units, another order of lattices and atoms. If binary64 holds the
///     numbers of that form exactly, the answer is the same, with the cell in the new basis and the time in
///     the new unit. But the order (lattice, atom, cell) may differ in that form. So if obstacles are entered
///     at the same time, or several contain x, the answer may name a different one of them.
///  3. The decimal digits and the details of Request are correctly rounded, too.
///  4. The answer is never `undecided`.
///  5. A start inside is answered by the rule in Request.
///  6. Any number of threads may use one oracle.
///
/// Units: as in Query: lengths are in the scene's unit, and times are such that x + t v is the particle's
/// position.
///
/// Cost: 4 to 7 us (2D) and 15 to 30 us (3D) for each atom of the scene at ordinary radii. The cost grows
/// with the logarithms of 1/r, of the length of the flight, and of the ratio of the largest to the smallest
/// number of the scene and the query (docs/speed.md). There is one exception: if very many obstacles contain
/// x (10^10 of them, in a lattice both dense and skewed), it can take long to find the first of them in the
/// order (lattice, atom, cell). Allocates.
///
/// Source: this project. In the sources, oracle/README.md says why it can be trusted.
class Oracle {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in). Finds
  /// short bases of the lattices, once.
  explicit Oracle(const Scene& scene);
  Oracle(Oracle&&) noexcept;
  Oracle& operator=(Oracle&&) noexcept;
  ~Oracle();

  /// The exact answer: `hit` (with the time correctly rounded to binary64), `inside` or `never`. With a time
  /// limit it is `later` if nothing is entered before the limit. For an invalid query (flaw_of) it is
  /// `error`. Throws InputError if digits are below 0 or above kMostDigits.
  Answer first_hit(const Query& query, const Request& request = {}) const;

  /// True if x lies inside no obstacle; a point on the surface is not inside. Throws InputError if x is not
  /// finite.
  bool is_free(const Vec& x) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

/// Names and versions of the libraries that the oracle uses.
std::string oracle_libraries();

}  // namespace lorentz::oracle
