// The curves of a report: free paths, and where an engine begins to fail: its answers by the decade of a measure
// of difficulty.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "question/counts.hpp"

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

/// Answers from 10^decade to 10^(decade + 1).
struct Call {
  question::Counts counts;  ///< of Counted::curves
  double radii_off = 0;     ///< the largest error of a time, along the ray, in radii
};

/// Answers by decade. A tolerance shows as an edge: wrong below, right above.
class Calls {
 public:
  /// Adds an answer. For a right or undecided answer the obstacle in question is the one that is hit; for
  /// others it is the one that is passed over or named. Ignores an answer without a size, with size 0, or
  /// with a verdict that is not of Counted::curves.
  void add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off = {});
  void add(const Calls& others);
  void add(int decade, const Call& call);

  const std::map<int, Call>& by_decade() const { return by_decade_; }

 private:
  std::map<int, Call> by_decade_;
};

/// An array of objects, one per decade; the keys are the members' names.
void append_json(std::string& out, const Calls& calls);

}  // namespace lorentz::report
