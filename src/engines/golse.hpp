// The coding of flights by E. Caglioti and F. Golse, "On the distribution of free path lengths for the
// periodic Lorentz gas III" (Commun. Math. Phys. 236, 2003) and "On the Boltzmann-Grad limit of the two
// dimensional periodic Lorentz gas" (J. Stat. Phys. 141, 2010), in binary64 and as published.
// docs/golse.md derives it.
#pragma once

#include <lorentz/engine.hpp>

namespace lorentz {

/// A flight that leaves a disc of the unit square lattice hits one of three discs. The convergents of the
/// slope at the scale of the radius give them, and the impact parameter decides among them. The cost is
/// proportional to ln(1/r).
///
/// The query has to name the disc as `from`, and its start has to lie on the flight from that disc to the
/// next one. Other queries are `unsupported`. A hit more than 2^52 columns or rows on is `undecided`, because
/// binary64 does not count so far.
class Golse : public Engine {
 public:
  /// Requires a scene that the engine supports (beyond).
  explicit Golse(const Scene& scene) : Engine(scene) {}

  /// Why the engine does not support a valid scene, or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
};

}  // namespace lorentz
