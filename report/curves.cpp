#include "report/curves.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>

namespace lorentz::report {
namespace {

void append_or_null(std::string& out, const char* key, const std::optional<double>& value) {
  out += fmt::format(",\"{}\":", key);
  if (value)
    append_number(out, *value);
  else
    out += "null";
}

// The scene, the radius and the engine; the object stays open.
template <class Curve>
void append_place(std::string& out, const Curve& curve) {
  out += fmt::format("{{\"scene\":{},\"engine\":{}", json_quoted(curve.scene), json_quoted(curve.engine));
  append_or_null(out, "radius", curve.radius);
}

}  // namespace

void append_curve(std::string& out, const FreePathCurve& curve) {
  append_place(out, curve);
  out += fmt::format(",\"from\":{},\"law\":{},\"points\":[", json_quoted(curve.from), json_quoted(curve.law));
  for (const FreePathCurve::Point& point : curve.points) {
    append_number(out += &point == &curve.points.front() ? "{\"t\":" : ",{\"t\":", point.t);
    append_or_null(out, "survival", point.survival);
    append_or_null(out, "exact", point.exact);
    append_or_null(out, "theory", point.theory);
    out += '}';
  }
  out += "]}";
}

void append_curve(std::string& out, const SurvivalCurve& curve) {
  append_place(out, curve);
  out += ",\"points\":[";
  for (const SurvivalCurve::Point& point : curve.points) {
    out += fmt::format("{}{{\"collisions\":{}", &point == &curve.points.front() ? "" : ",", point.collisions);
    append_or_null(out, "share", point.share);
    append_or_null(out, "low", point.bounds.low);
    append_or_null(out, "high", point.bounds.high);
    out += '}';
  }
  out += "]}";
}

}  // namespace lorentz::report
