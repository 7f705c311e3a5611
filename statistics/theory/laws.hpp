// The theory that applies to the free paths of a scene: laws, tails, the mean. Unit speed; lengths in the
// scene's unit. docs/free_paths.md has the mathematics. For scenes without flaws (flaw_of, dependence_in).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "question/starts/ensemble.hpp"

namespace lorentz::flights {

/// A law of the free path tau.
struct Law {
  std::string name;                        ///< e.g. "Boca-Zaharescu"
  std::string when;                        ///< the limit in which it holds, e.g. "r -> 0"
  std::function<double(double)> survival;  ///< P(tau > t), t in the scene's unit
  double scale = 0;                        ///< of t: the law's mean between collisions
  double smooth_from = 0;                  ///< shorter paths show the lattice itself: they are one bin
};

/// The known law for a scene. If none is known, `why_not` (if given) becomes the reason.
std::optional<Law> law_of(const Scene& scene, Ensemble ensemble, std::string* why_not = nullptr);

/// The asymptotic behaviour P(tau > t) ~ constant * t^-(exponent - 1).
struct Tail {
  std::string when;                     ///< "r -> 0" or "t -> infinity": two limits with two tails
  std::optional<double> exponent;       ///< of the density of tau; empty if there is no such tail
  std::optional<double> constant;       ///< in the scene's unit to the power exponent - 1; 0: it falls faster
  std::string remark;                   ///< the source of the constant, or why it or the tail is not known
  std::optional<double> approach = {};  ///< a: the relative deviation falls only like t^-a
  /// For t -> infinity: whether a corridor or a planar channel is open. If so, the mean from a uniform start
  /// and the variance from a surface are infinite. Empty: not known.
  std::optional<bool> open = {};
};

/// The tail for t -> infinity, at the scene's own radii. Whether a channel is open is decided exactly
/// (horizon.hpp). This may take half a minute for a scene of many obstacles, and may stay undecided.
/// held by "Tails: of a superposition what the horizon says"
Tail tail_of_long_paths(const Scene& scene, Ensemble ensemble);

/// The known tails, at most one for each limit. The tail of long paths is the last.
std::vector<Tail> tails_of(const Scene& scene, Ensemble ensemble);

/// The mean free path between collisions. (From a uniform start the mean may not exist: with an infinite
/// horizon it is infinite.)
struct MeanFreePath {
  std::optional<double> value;
  std::string how;  ///< the formula, or why the mean is not known
};

/// Exact up to rounding for obstacles that don't overlap, and for superpositions of incommensurate lattices.
/// Overlaps are decided exactly, which takes several seconds for large numbers of obstacles.
MeanFreePath mean_free_path_of(const Scene& scene);

// The limit law of free paths among small discs: Boca & Zaharescu, "The distribution of the free path lengths in the
// periodic two-dimensional Lorentz gas in the small-scatterer limit" (Commun. Math. Phys. 269, 2007).
//
// For one disc of radius r in each cell, of area A, of any 2D lattice; unit speed; r -> 0. A path t is
// measured as s = 2 r t / A, whose mean between collisions is 1. The relative error is below 1e-12 for every
// s > 0; survivals are 1 for s <= 0. An evaluation takes a microsecond.

/// P(a path from a collision is longer than s), whose density is (6 / pi^2) g(s), constant up to s = 1. Also the density of s from a uniform start.
double limit_survival_from_surface(double s);

/// P(a path from a uniform start is longer than s).
double limit_survival_from_uniform(double s);

}  // namespace lorentz::flights
