// The curves of a report: free paths, and how long trajectories stay right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/share.hpp"

namespace lorentz::report {

/// P(free path > t) in one scene.
struct FreePathCurve {
  struct CurvePoint {
    double t = 0;
    double survival = 0;           ///< as it was flown
    std::optional<double> exact;   ///< of the same flights
    std::optional<double> theory;  ///< of the law
  };
  std::string scene, engine;
  std::optional<double> radius;  ///< none: the scene's own sizes
  std::string from;              ///< "surface" or "uniform": where flights start
  std::string law;               ///< that `theory` is of, and when it holds; empty: none is known
  std::vector<CurvePoint> points;
};

/// The share of trajectories with so many right collisions, or more.
struct SurvivalCurve {
  struct CurvePoint {
    std::size_t collisions = 0;
    double share = 0;
    Share bounds = {};
  };
  std::string scene, engine;
  std::optional<double> radius;
  std::vector<CurvePoint> points;
};

/// An object, its keys as the members are called; `low` and `high` stand for `bounds`.
void append_json(std::string& out, const FreePathCurve& curve);
void append_json(std::string& out, const SurvivalCurve& curve);

}  // namespace lorentz::report
