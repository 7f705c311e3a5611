// The efficient algorithm of Kraemer, Kryukov and Sanders, "Efficient algorithms for general periodic Lorentz
// gases in two and three dimensions" (J. Phys. A 49, 2016), in binary64 and as published: reconstructed from
// the paper's text and the behaviour of its authors' program of 2015, faults included, because it is what
// users compare against. docs/published.md lists the faults; tests/engines/published_test.cpp holds them
// fast.
#pragma once

#include <lorentz/engine.hpp>

namespace lorentz {

class PublishedBravais;

/// What the search came up with on the way to an answer. Of 3D proposals some are in neither of the false
/// ones and no hit: spheres that the search had passed already.
struct Proposals {
  long long made = 0;           ///< discs; spheres that the three planes agree on
  long long false_ellipse = 0;  ///< of these: the flight meets the circumscribed ball, but not the obstacle
  long long false_tricylinder = 0;  ///< 3D, of these: the line misses even the circumscribed ball
  long long passes = 0;             ///< the work: convergents taken in all searches together, and searches
};

/// Unit square and cubic lattice: in 2D by convergents of the slope, in 3D by the 2D algorithm in the three
/// coordinate planes. Other lattices of balls: transformed to these, each obstacle in a circumscribed ball,
/// what the search proposes is verified. Several atoms: each alone, the earliest. Directions along an axis
/// (in 3D: with any zero component), in the transformed lattice, are `unsupported`: the algorithm has no
/// octant for them. A search is `undecided` after kMaxPasses passes or 2^52 columns (2D), after kMaxRounds
/// rounds or beyond kMaxStart (3D); in other than the unit lattices also after kMaxRounds proposals (2D), and
/// the passes of all its searches together count to kMaxTotalPasses.
class Published : public Engine {
 public:
  static constexpr long kMaxPasses = 1'000'000;
  static constexpr long kMaxTotalPasses = 10'000'000;
  static constexpr long kMaxRounds = 1'000'000;

  /// For scenes that are not beyond it.
  explicit Published(const Scene& scene);
  ~Published() override;

  /// Why the engine does not do a scene without flaws, or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

  /// As first_hit; what the search proposed is added to `proposals`.
  Answer first_hit_counted(const Query& query, double max_time, Proposals& proposals) const;

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override {
    Proposals proposals;
    answer = flight_of(ray, max_time, proposals);
  }
  Answer flight_of(const Ray& ray, double max_time, Proposals& proposals) const;

  std::vector<PublishedBravais> atoms_;  // empty: the unit lattice
};

}  // namespace lorentz
