// What answers a query: the obstacle that is hit, when, or what else there is to say.
#pragma once

#include <optional>
#include <string>

#include <lorentz/obstacle.hpp>
#include <lorentz/vec.hpp>

namespace lorentz {

enum class Outcome {
  hit,        ///< the ray enters `obstacle` first, at `time`
  never,      ///< it enters no obstacle
  inside,     ///< x lies in the open obstacle `obstacle`
  later,      ///< nothing is entered before the asked --max-time
  undecided,  ///< the implementation does not know, and says so
  error       ///< no valid query, or (unsupported) one that this engine does not do
};

/// The collision itself, for those who ask for it. Unit outward normal; impact parameter: distance of the
/// line of flight from the obstacle's centre.
struct Detail {
  Vec point{};
  Vec normal{};
  double impact_parameter = 0;
};

struct Answer {
  Outcome outcome = Outcome::undecided;
  ObstacleId obstacle;           ///< of `hit` and `inside`
  std::optional<double> time;    ///< of `hit`; may be infinite, and absent in answers that others logged
  std::string time_decimal;      ///< of `hit`, if digits were asked for
  std::optional<Detail> detail;  ///< of `hit`, if it was asked for
  std::string message;           ///< of `error`
  bool unsupported = false;      ///< of `error`: a valid query, outside what this engine does

  /// As newly made, but what is allocated stays.
  void clear();

  static Answer hit(ObstacleId obstacle, double time);
  static Answer inside(ObstacleId obstacle);
  static Answer never();
  static Answer later();
  static Answer undecided();
  static Answer error(std::string message);
  static Answer unsupported_because(std::string message);
};

/// The answer, or `later` if it says that nothing is entered before `max_time` (an infinity: no limit).
Answer limited(Answer answer, double max_time);

}  // namespace lorentz
