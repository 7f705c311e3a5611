// The horizon of a scene: the infinite channels that its obstacles leave open, along which a path is free for
// ever. In 2D these are corridors along lattice vectors; in 3D they are layers between lattice planes, and
// cylindrical channels along lattice vectors. Whether a channel is open is decided exactly; the numbers that
// describe it are rounded. docs/horizon.md has the mathematics.
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

/// A corridor (2D) or a planar channel (3D), together with its translates by the scene's periods.
struct Channel {
  /// 2D: the lattice vector along the corridor, in the first lattice's primitive vectors. 3D: the indices (h
  /// k l) of the first lattice's planes parallel to the channel. Coprime; the first nonzero one is positive.
  std::array<Integer, 3> indices;
  Vec vector{};         ///< 2D: that lattice vector. 3D: the reciprocal vector (h k l), normal to the planes
  double width = 0;     ///< correctly rounded; above 0, unless it is too small for a binary64
  Vec point{};          ///< on the channel's middle line or plane, rounded
  bool inside = false;  ///< the rounded point is inside; decided exactly
  Integer count = 1;    ///< number of channels of this kind in a common period of superposed lattices; this
                        ///< one is the widest of them
};

/// A channel along a line that lies in no planar channel: a hole in the scene's shadow along `direction`.
struct Cylinder {
  std::array<Integer, 3> direction;  ///< coprime, in the primitive vectors; the first nonzero one is positive
  Vec vector{};                      ///< the same, Cartesian
  Vec point{};                       ///< on a line within the channel, rounded
  bool inside = false;               ///< the line through the rounded point is inside; decided exactly
  /// The radius of a cylinder that fits around the line from which `point` is rounded, not always the
  /// channel's widest. Among balls it is correctly rounded; among ellipsoids it is at most what fits. It is
  /// above 0, unless it is too small for a binary64.
  double radius = 0;
};

/// Lattice planes that nearly leave a planar channel open. If the obstacles just touch, infinitely many
/// directions within the plane have cylindrical channels; if they overlap by very little, very many
/// directions do.
struct CylinderFamily {
  std::array<Integer, 3> indices;  ///< (h k l) of the planes
  bool infinite = false;           ///< the obstacles touch: all but finitely many directions have a channel
  double directions = 0;           ///< if not `infinite`: about how many directions need to be examined
};

/// All ways through a scene that are free for ever.
struct Horizon {
  int dimension = 0;
  double min_width = 0;  ///< narrower corridors and planar channels were left out

  std::vector<Channel> channels;  ///< the widest first
  std::size_t normals = 0;        ///< number of different directions (3D: normals) among the channels
  /// Directions (3D: normals) for which it is not known whether they have channels: in scenes with three or
  /// more lattices that have very long common periods.
  std::vector<std::array<Integer, 3>> undecided;

  /// P(free path from a uniform start > t) ~ tail_constant / t, for one lattice of obstacles that do not
  /// overlap. It is 0 for any scene without a corridor or planar channel: the tail then falls faster than
  /// 1/t, or, if is_finite(), does not exist.
  std::optional<double> tail_constant;
  std::string no_tail_constant;  ///< the reason if tail_constant is empty

  std::vector<Cylinder> cylinders;       ///< 3D
  std::vector<CylinderFamily> families;  ///< 3D
  std::string no_cylinders;              ///< if not empty: why cylinders were not searched for, or not all

  /// True if some path is known to be infinite, whatever is undecided.
  bool is_infinite() const;
  /// True if it is known that no path is infinite.
  bool is_finite() const;
};

/// Thrown if the obstacles are so small that too many channels are possible to list them all.
struct TooManyChannels : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Called from time to time during a search: `done` of `total` are done; `what` names what is counted.
using SearchProgress = std::function<void(const std::string& what, std::size_t done, std::size_t total)>;

/// Finds all ways through a scene that are free for ever. What is open is decided exactly.
///
/// For a valid crystal (flaw_of, dependence_in) these are all open channels; if `min_width` is above 0, the
/// corridors and planar channels at least that wide. The search for cylinders can be left out: among small
/// obstacles it is the longer one.
///
/// Throws TooManyChannels, in most cases at once, because candidate directions are counted before any is
/// examined. A search among very many directions takes half a minute; it calls `progress`.
///
/// Throws InputError for scenes with lattices that do not repeat in all directions, and for a `min_width` that is
/// negative or not finite.
Horizon horizon_of(const Scene& scene, double min_width = 0, bool with_cylinders = true,
                   const SearchProgress& progress = {});

}  // namespace lorentz::oracle
