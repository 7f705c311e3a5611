// Which theory holds for the free paths of a scene: laws, tails, the mean. Unit speed; lengths in the scene's
// unit. docs/free_paths.md has the mathematics. For scenes without flaws (flaw_of, dependence_in).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "statistics/theory/ensemble.hpp"

namespace lorentz::flights {

/// A law of the free path tau.
struct Law {
  std::string name;                        ///< e.g. "Boca-Zaharescu"
  std::string when;                        ///< the limit in which it holds, e.g. "r -> 0"
  std::function<double(double)> survival;  ///< P(tau > t), of t in the scene's unit
  double scale = 0;                        ///< of t: the law's mean from collision to collision
  double smooth_from = 0;                  ///< shorter paths show the lattice itself: count them together
};

/// The laws that are known for a scene; none, and the reason.
struct Laws {
  std::vector<Law> laws;
  std::string none;  ///< why there is none; else empty
};

Laws laws_of(const Scene& scene, Ensemble ensemble);

/// How P(tau > t) falls in the end: like constant * t^-(exponent - 1).
struct Tail {
  std::string when;                     ///< "r -> 0", or "t -> infinity": two limits, of two tails
  std::optional<double> exponent;       ///< of the density of tau; nothing if there is no such tail
  std::optional<double> constant;       ///< in the scene's unit to the power exponent - 1; 0: it falls faster
  std::string remark;                   ///< where the constant comes from, or why it or the tail is not known
  std::optional<double> approach = {};  ///< a: the relative distance from it falls like t^-a only
  /// t -> infinity: is a corridor or a planar channel open, so that the mean from a uniform start is
  /// infinite, and the variance from a surface? Nothing: not known.
  std::optional<bool> open = {};
};

/// That of t -> infinity, at the scene's own radii. Whether a way is open is decided exactly (horizon.hpp),
/// which for a scene of many obstacles may take half a minute, or is not known.
/// held by "Tails: of a superposition what the horizon says"
Tail tail_of_long_paths(const Scene& scene, Ensemble ensemble);

/// Those that are known: that one the last, at most one for each limit.
std::vector<Tail> tails_of(const Scene& scene, Ensemble ensemble);

/// The mean free path from collision to collision. (From a uniform start there may be none: an infinite
/// horizon makes it infinite.)
struct MeanFreePath {
  std::optional<double> value;
  std::string how;  ///< by which formula, or why it is not known
};

/// Exact up to rounding for obstacles that don't overlap, and for superpositions of incommensurate lattices;
/// overlaps are decided exactly, which for very many obstacles takes some seconds.
MeanFreePath mean_free_path_of(const Scene& scene);

}  // namespace lorentz::flights
