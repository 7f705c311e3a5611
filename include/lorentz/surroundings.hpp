// The obstacles around a place on the line of a flight, as seen from it, for pictures and for people. Places
// are computed exactly, however far away; only positions relative to one another are rounded.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// A place on the line of a flight. With an `obstacle`, it is where the line enters the obstacle, or, if the
/// line misses it, where the line is nearest to its centre, in coordinates in which it is a ball. Otherwise
/// it is where the flight is at a `time`.
struct PlaceOnLine {
  std::optional<ObstacleId> obstacle;  ///< must exist
  double time = 0;                     ///< finite
  double beyond = 0;                   ///< distance along the flight from there; finite

  static PlaceOnLine start() { return {}; }
  static PlaceOnLine at(ObstacleId id) { return {std::move(id), 0, 0}; }
  static PlaceOnLine after(double time) { return {std::nullopt, time, 0}; }
};

/// An obstacle near a place.
struct Neighbour {
  ObstacleId obstacle;
  Vec centre{};  ///< relative to the place
};

struct Neighbourhood {
  std::vector<Neighbour> obstacles;
  bool complete = true;  ///< false if there are more than were requested
};

/// Looks at flights in one scene. Numbers are rounded to about 52 bits at the end and not before (places are
/// known to 150 digits); their sizes are at most 1e300. Any number of threads may use one object.
class Surroundings {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in).
  explicit Surroundings(const Scene& scene);
  Surroundings(Surroundings&&) noexcept;
  Surroundings& operator=(Surroundings&&) noexcept;
  ~Surroundings();

  /// The length of the way along the line from one place to another; negative if the second lies before the
  /// first.
  double way(const Query& query, const PlaceOnLine& from, const PlaceOnLine& to) const;

  /// The centre of an obstacle relative to a place. The obstacle must exist.
  Vec centre(const Query& query, const PlaceOnLine& seen_from, const ObstacleId& obstacle) const;

  /// The obstacles whose centres are nearer than `reach` (> 0, finite) to a place, at most `most` for each
  /// atom.
  Neighbourhood around(const Query& query, const PlaceOnLine& place, double reach, std::size_t most) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
