// What stands around a place on the line of a flight, seen from it: for pictures, and for people. The places
// are computed exactly, however far away, and rounded when they are relative to one another.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// A place on the line of a flight: where it enters an obstacle (or, if it misses it, is nearest to its
/// centre in the coordinates in which it is a ball), else where it is at a time.
struct PlaceOnLine {
  std::optional<ObstacleId> obstacle;  ///< must exist
  double time = 0;                     ///< finite
  double beyond = 0;                   ///< so far along the flight from there, a length; finite

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
  bool complete = true;  ///< false: there are more than were asked for
};

/// Looks at flights in one scene. Numbers are rounded to about 52 bits at the end and not before (places are
/// known to 150 digits); their sizes are 1e300 at the most. Any number of threads may ask one.
class Surroundings {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in).
  explicit Surroundings(const Scene& scene);
  Surroundings(Surroundings&&) noexcept;
  Surroundings& operator=(Surroundings&&) noexcept;
  ~Surroundings();

  /// The way along the line from one place to another, in lengths; below 0 if the second lies before the
  /// first.
  double way(const Query& query, const PlaceOnLine& from, const PlaceOnLine& to) const;

  /// The centre of an obstacle, which must exist, relative to a place.
  Vec centre(const Query& query, const PlaceOnLine& seen_from, const ObstacleId& obstacle) const;

  /// The obstacles whose centres are nearer than `reach` (> 0, finite) to a place, `most` of each atom at the
  /// most.
  Neighbourhood around(const Query& query, const PlaceOnLine& place, double reach, std::size_t most) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
