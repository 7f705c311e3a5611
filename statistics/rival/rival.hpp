// An engine's trajectory, compared with the certified one collision by collision.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/itinerary.hpp>
#include <lorentz/trajectory.hpp>
#include "question/answerer.hpp"
#include "question/engines.hpp"

namespace lorentz::rival {

/// An engine of this program as the function that a trajectory asks.
AskFirstHit asking(const question::EngineInfo& engine, const Scene& scene);

/// A trajectory that an engine flies, also an external one (`cmd:`). It begins at the binary64 start nearest
/// to the given start, in the binary64 scene nearest to the given scene.
class Rival {
 public:
  /// `program` answers if the engine is an external one, for one rival at a time. Throws InputError if the engine's
  /// trajectory does not support the start.
  Rival(const question::EngineInfo& engine, question::Answerer* program, const RationalScene& scene,
        const Start& start);

  /// Takes the next certified collision, and compares it with the rival's own next collision. Does nothing
  /// once the rival has diverged.
  void meet(const oracle::CertifiedCollision& truth);

  /// Ends the rival's trajectory, because the certified one has ended; if at a time, at the time `until`. If the rival's
  /// ends otherwise or not yet, that counts as a difference.
  void finish(const oracle::Arrival& truth, double until);

  /// Continues alone up to this number of collisions, to record the path.
  void go_on(std::uint64_t collisions);

  std::optional<std::uint64_t> diverged() const { return diverged_; }
  /// The number of bits in which it agrees with the place of the last certified collision, relative to the
  /// obstacle; at most 53.
  double bits_right() const { return bits_right_; }
  /// Why it stopped where the certified one goes on; empty if it did not.
  std::string stopped() const;
  const std::vector<Vec>& path() const { return path_; }

 private:
  Scene scene_;
  std::unique_ptr<Trajectory> trajectory_;
  std::optional<std::uint64_t> diverged_;
  double bits_right_ = 53;
  std::vector<Vec> path_;
};

/// The place of a certified collision, rounded.
Vec place_of(const Scene& scene, const oracle::CertifiedCollision& collision);

}  // namespace lorentz::rival
