// The subject of a finding's drawing: which obstacle is in question, and by how much. Private to
// finding_*.cpp.
#pragma once

#include <optional>
#include <string>

#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/surroundings.hpp>

namespace lorentz::pictures {

enum class Issue {
  none,   ///< nothing
  line,   ///< does the line meet `obstacle`?
  start,  ///< does `obstacle` contain x?
  order,  ///< `obstacle` is entered, and `second` after it
  time    ///< where is `obstacle` entered?
};

/// One question with its exact answer, and possibly a given one.
class FindingCase {
 public:
  /// `given` may be null. `decisive` is the obstacle by which it is judged, if known. The arguments must
  /// outlive this object. Lengths and times are in units of 2^exponent.
  FindingCase(const Scene& scene, const Query& query, const Answer* given, const Answer& exact,
              const std::optional<ObstacleId>& decisive = {}, int exponent = 0);

  const Scene& scene;
  const Query& query;
  const Answer* const given;
  const Answer& exact;
  const int exponent;
  const oracle::Margins margins;
  const oracle::Surroundings surroundings;
  const Vec along;  ///< the flight's direction, of length 1

  Issue issue = Issue::none;
  ObstacleId obstacle;
  std::optional<ObstacleId> second;
  /// In radii of `obstacle`, in the coordinates in which it is a ball. For Issue::line the distance of the
  /// line from its surface, for Issue::start that of x, both below 0 inside. Else the way along the flight
  /// from its entry to the entry of `second` (Issue::order), or to the place at the given time (Issue::time).
  double distance = 0;
  std::string words;   ///< the same in a sentence
  std::string margin;  ///< how hard the decision is, if it is shown for that reason

  /// The place where the flight ends according to an answer; nothing if it does not end, or the place is
  /// unknown.
  std::optional<oracle::PlaceOnLine> end_of(const Answer& answer) const;

  /// True if the answer names an obstacle of the scene.
  bool names_obstacle(const Answer& answer) const;

  const Atom& atom_of(const ObstacleId& id) const { return scene.lattices[id.lattice].atoms[id.atom]; }

  /// A way along the flight in radii of the obstacle in question.
  double in_radii(double way) const;

  /// "cell (2, -1)", with atom and lattice if there are several.
  std::string name_of(const ObstacleId& id) const;

 private:
  void compare_answers(const std::optional<ObstacleId>& decisive);
  bool compare_named();
  void take_hardest_decision();
  void about_line(const ObstacleId& id, const oracle::Approach& approach);
  void about_start(const ObstacleId& id, const oracle::Approach& approach);
  void about_order(const ObstacleId& first, const ObstacleId& later);
  void about_time(double time);
};

/// The rows of A^-1 of an obstacle { position + A y : |y| < 1 }.
std::array<Vec, 3> to_ball(const Atom& atom, int dimension);

/// a / |a|, for any size; the first axis for 0.
Vec unit(const Vec& a);

}  // namespace lorentz::pictures
