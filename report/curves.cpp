#include "report/curves.hpp"

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

void append_json(std::string& out, const FreePathCurve& curve) {
  json::append(out, [&](json::Members& object) {
    object.add("scene", curve.scene, "engine", curve.engine, "radius", curve.radius, "from", curve.from,
               "law", curve.law, "points",
               json::objects(curve.points, [](json::Members& one, const FreePathCurve::CurvePoint& point) {
                 one.add("t", point.t, "survival", point.survival, "exact", point.exact, "theory",
                         point.theory);
               }));
  });
}

}  // namespace lorentz::report
