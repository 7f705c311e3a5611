// An engine's trajectory, held against the certified one collision by collision.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/itinerary.hpp>
#include <lorentz/trajectory.hpp>
#include "question/answerer.hpp"
#include "question/engines.hpp"

namespace lorentz::survival {

/// An engine of this program as trajectories ask it.
AskFirstHit asking(const question::EngineInfo& engine, const Scene& scene);

/// A trajectory with the flights of an engine by name (`cmd:` too), from the binary64 nearest to the start,
/// in the binary64 scene nearest to the scene.
class Rival {
 public:
  /// Throws InputError for a start that the engine's trajectory cannot have. `listener`: is told what became of
  /// another program.
  Rival(const question::EngineInfo& engine, Precision precision, const RationalScene& scene,
        const Start& start, question::Listener listener = {});

  /// The next certified collision: the rival makes its own, and is compared, as long as it has not diverged.
  void meet(const oracle::CertifiedCollision& truth);

  /// The certified journey is over, at the time `until` if there is one: so does the rival, and a collision
  /// more is a difference.
  void finish(std::uint64_t collisions, std::optional<double> until);

  /// Goes on by itself to so many collisions, for its path.
  void go_on(std::uint64_t collisions);

  std::optional<std::uint64_t> diverged() const { return diverged_; }
  /// Bits in which it agreed with the last certified collision's place, seen from the obstacle; at most 53.
  double bits_right() const { return bits_right_; }
  /// True if it was another program, and that broke.
  bool failed() const { return command_ && command_->failed(); }
  /// Why it stopped, if it did; else empty.
  std::string stopped() const;
  const std::vector<Vec>& path() const { return path_; }

 private:
  std::unique_ptr<question::Answerer> command_;
  Scene scene_;
  std::unique_ptr<Trajectory> trajectory_;
  std::optional<std::uint64_t> diverged_;
  double bits_right_ = 53;
  std::vector<Vec> path_;
};

/// Where a certified collision is, rounded.
Vec place_of(const Scene& scene, const oracle::CertifiedCollision& collision);

}  // namespace lorentz::survival
