// The curve of free paths in a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lorentz::report {

/// P(free path > t) in one scene.
struct FreePathCurve {
  struct CurvePoint {
    double t = 0;
    double survival = 0;           ///< of the engine's flights
    std::optional<double> exact;   ///< of the same flights
    std::optional<double> theory;  ///< by the law
  };
  std::string scene, engine;
  std::optional<double> radius;  ///< nothing: the scene's own sizes
  std::string from;              ///< "surface" or "uniform": where flights start
  std::string law;               ///< the law behind `theory`, and when it holds; empty: no law is known
  std::vector<CurvePoint> points;
};

/// An object; the keys are the members' names.
void append_json(std::string& out, const FreePathCurve& curve);

}  // namespace lorentz::report
