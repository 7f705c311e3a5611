// The efficient algorithm of Kraemer, Kryukov and Sanders, "Efficient algorithms for general periodic Lorentz
// gases in two and three dimensions" (J. Phys. A 49, 2016), in binary64 and as published. It is reconstructed
// from the paper's text and the behaviour of its authors' program of 2015, faults included, because users
// compare against it as it is. docs/published.md lists the faults; tests/engines/published_test.cpp checks
// that they stay.
#pragma once

#include <lorentz/engine.hpp>

namespace lorentz {

class PublishedBravais;

/// What the search proposed on the way to an answer. In 3D a proposal may be neither a hit nor counted as
/// false: a sphere that the search had already passed.
struct Proposals {
  long long made = 0;           ///< discs; spheres that the three planes agree on
  long long false_ellipse = 0;  ///< of these: the flight meets the circumscribed ball, but not the obstacle
  long long false_tricylinder = 0;  ///< 3D, of these: the line misses even the circumscribed ball
};

/// In the unit square lattice the engine searches by convergents of the slope; in the unit cubic lattice by
/// the 2D algorithm in the three coordinate planes. Other lattices, and those of ellipsoids, are
/// transformed to these, each obstacle is put into a circumscribed ball, and every proposal of the search is
/// verified. Several atoms are searched one by one, and the earliest hit counts.
///
/// Directions along an axis (in 3D: with any zero component) of the transformed lattice are `unsupported`,
/// because the algorithm has no octant for them. A search is `undecided` after kMaxPasses passes or 2^52
/// columns (2D), and after kMaxRounds rounds or beyond kMaxStart (3D). In lattices other than the unit
/// lattices it is also `undecided` after kMaxRounds proposals (2D), and kMaxTotalPasses limits the passes of
/// all its searches together.
class Published : public Engine {
 public:
  static constexpr long kMaxPasses = 1'000'000;
  static constexpr long kMaxTotalPasses = 10'000'000;
  static constexpr long kMaxRounds = 1'000'000;

  /// Requires a scene that the engine supports (beyond).
  explicit Published(const Scene& scene);
  ~Published() override;

  /// Why the engine does not support a valid scene, or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

  /// Like first_hit; also adds what the search proposed to `proposals`.
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
