#include "report/curves.hpp"

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

template <class Curve>
void add_place(json::Members& object, const Curve& curve) {
  object.add("scene", curve.scene, "engine", curve.engine, "radius", curve.radius);
}

}  // namespace

void append_json(std::string& out, const FreePathCurve& curve) {
  json::append(out, [&](json::Members& object) {
    add_place(object, curve);
    object.add("from", curve.from, "law", curve.law, "points",
               json::objects(curve.points, [](json::Members& one, const FreePathCurve::CurvePoint& point) {
                 one.add("t", point.t, "survival", point.survival, "exact", point.exact, "theory",
                         point.theory);
               }));
  });
}

void append_json(std::string& out, const SurvivalCurve& curve) {
  json::append(out, [&](json::Members& object) {
    add_place(object, curve);
    object.add("points",
               json::objects(curve.points, [](json::Members& one, const SurvivalCurve::CurvePoint& point) {
                 one.add("collisions", point.collisions, "share", point.share, "low", point.bounds.low,
                         "high", point.bounds.high);
               }));
  });
}

}  // namespace lorentz::report
