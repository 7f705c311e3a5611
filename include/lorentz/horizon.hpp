// Which ways through a scene are free for ever: the infinite channels that its obstacles leave open. In 2D
// these are corridors along lattice vectors; in 3D layers between lattice planes, and cylindrical channels
// along lattice vectors. What is open is decided exactly; what is printed of it is rounded. docs/horizon.md
// has the mathematics.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// A corridor (2D) or a planar channel (3D), and its translates by the scene's periods.
struct Channel {
  /// 2D: the lattice vector along the corridor, in the first lattice's primitive vectors. 3D: the indices (h
  /// k l) of the first lattice's planes parallel to it. Coprime, the first that is not 0 above 0.
  std::array<Integer, 3> indices;
  Vec vector{};         ///< 2D: that lattice vector. 3D: the reciprocal vector (h k l), normal to the planes
  double width = 0;     ///< correctly rounded; above 0, unless it is too small for a binary64
  Vec point{};          ///< on the channel's middle line or plane, rounded
  bool inside = false;  ///< the rounded point is inside; decided exactly
  Integer count = 1;    ///< so many channels of this kind in a common period of superposed lattices; this one
                        ///< is the widest of them
};

/// A channel along a line that lies in no planar one: a hole in the scene's shadow along `direction`.
struct Cylinder {
  std::array<Integer, 3> direction;  ///< coprime, in the primitive vectors; the first that is not 0 above 0
  Vec vector{};                      ///< the same, Cartesian
  Vec point{};                       ///< rounded, on a line within the channel
  bool inside = false;               ///< that line is inside; decided exactly
  /// Of a cylinder that fits around the line that `point` is rounded from, not always the channel's widest.
  /// Among balls correctly rounded, among ellipsoids at most what fits; above 0, unless it is too small for a
  /// binary64.
  double radius = 0;
};

/// Lattice planes that leave no planar channel open, but nearly: infinitely many directions within the plane
/// have cylindrical channels if the obstacles just touch, very many if they overlap by very little.
struct CylinderFamily {
  std::array<Integer, 3> indices;  ///< (h k l) of the planes
  bool infinite = false;           ///< touching: one in all but finitely many directions
  double directions = 0;           ///< not infinite: about so many directions would have to be looked at
};

/// Where an arc of closed directions ends: along the row itself, or where a gap in its shadow opens.
struct ArcEnd {
  double angle = 0;                 ///< in radians, from the row's vector counterclockwise: 0 to pi
  double cotangent = 0;             ///< of the angle, correctly rounded; infinite along the row
  Vec vector{};                     ///< in this direction, about as long as the row's vector
  std::vector<ObstacleId> between;  ///< the two obstacles beside the gap; none along the row
};

/// Directions along which rows in the plane leave no way open. The ends belong to the arc, since a way of width
/// 0 is not open; the direction of the row does not, since it is open. An arc may be a single direction.
struct ClosedArc {
  ArcEnd from, to;
};

/// All ways through a scene that are free for ever.
struct Horizon {
  int dimension = 0;

  /// The closed directions of a scene of rows, in the order of their angles; all others are open. Only a scene
  /// of rows has this, and it has nothing else.
  std::optional<std::vector<ClosedArc>> closed;

  std::vector<Channel> channels;  ///< the widest first
  std::size_t normals = 0;        ///< different directions (3D: normals) among the channels
  /// Directions (3D: normals) of which it is not known whether they have channels: three lattices or more
  /// with very long common periods.
  std::vector<std::array<Integer, 3>> undecided;

  /// P(free path from a uniform start > t) ~ tail_constant / t; of one lattice of obstacles that do not
  /// overlap. 0 for any scene without a corridor or planar channel: the tail falls faster than 1/t, or, if
  /// is_finite(), there is none.
  std::optional<double> tail_constant;
  std::string no_tail_constant;  ///< else the reason

  std::vector<Cylinder> cylinders;       ///< 3D
  std::vector<CylinderFamily> families;  ///< 3D
  std::string no_cylinders;              ///< not empty: cylinders were not searched for, and why

  /// True if a path is known to be infinite, whatever is undecided.
  bool is_infinite() const;
  /// True if no path is infinite, and that is known.
  bool is_finite() const;
};

/// So many channels are possible that listing them all is out of reach: the small obstacles' fault.
struct TooManyChannels : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Hears now and then how far a search is: `done` of `total` of what `what` names are done.
using SearchProgress = std::function<void(const std::string& what, std::size_t done, std::size_t total)>;

/// What is open is decided exactly.
/// held by "Horizon: square and cubic lattices by their closed forms",
///         "Horizon: the oracle flies for ever in a channel, and nowhere else",
///         "Horizon: the closed directions of rows, by looking at drawn ones"
///
/// All open channels of a crystal without flaws (flaw_of, dependence_in); with `min_width` above 0 the
/// corridors and planar channels at least that wide. The search for cylinders can be left out: among
/// small obstacles it is the longer one. Throws TooManyChannels, mostly at once, for directions that come
/// into question are counted before any is looked at; a search of very many takes half a minute, and
/// `progress` hears of it.
///
/// A scene of rows (parallel ones in the plane, any in space), also with single obstacles, gets its closed
/// directions. Throws InputError for all other scenes with lattices that do not repeat in all directions; for
/// rows with too many pairs of obstacles; for a `min_width` that is below 0 or not finite, and for rows if it
/// is above 0.
Horizon horizon_of(const Scene& scene, double min_width = 0, bool with_cylinders = true,
                   const SearchProgress& progress = {});

/// Does a layer leave a way open along one direction? The directions that it closes are regions of the sphere
/// with, often, infinitely many edges: docs/horizon.md.
struct OpenDirection {
  bool open = false;
  /// A way along it, with no names in lattice vectors. Nothing if it is closed, or along the layer, where all is
  /// open beside the obstacles.
  std::optional<Cylinder> way;
};

/// Decided exactly.
/// held by "Horizon: directions through layers, by closed forms",
///         "Horizon: directions through layers, by the oracle and in other words"
///
/// `scene` has no flaws; its lattices are layers with the same vectors. Throws InputError for other scenes, for
/// ellipsoids of different shapes, for a direction that is 0 or not finite, and for one so nearly along a layer of
/// several obstacles a cell that very many of them lie beside each other in the shadow.
OpenDirection look_along(const Scene& scene, const Vec& direction);

}  // namespace lorentz::oracle
