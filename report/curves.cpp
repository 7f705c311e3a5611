#include "report/curves.hpp"

#include <algorithm>
#include <cmath>

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

using question::Count;
using question::Counted;

void Calls::add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off) {
  const double its = std::fabs(size.value_or(0));
  const auto count = static_cast<Count>(verdict);
  if (!(its > 0) || !std::isfinite(its) || !question::name_of(count).is_counted(Counted::curves)) return;
  Call call{{}, radii_off.value_or(0)};
  call.counts[count] = 1;
  add(static_cast<int>(std::floor(std::log10(its))), call);
}

void Calls::add(int decade, const Call& call) {
  Call& its = by_decade_[decade];
  its.counts += call.counts;
  its.radii_off = std::max(its.radii_off, call.radii_off);
}

void Calls::add(const Calls& others) {
  for (const auto& [decade, call] : others.by_decade_) add(decade, call);
}

void append_json(std::string& out, const Calls& calls) {
  out += json::text_of(json::objects(calls.by_decade(), [](json::Members& one, const auto& decade) {
    const auto& [exponent, call] = decade;
    one.add("decade", exponent);
    question::add_counts(one, call.counts, Counted::curves);
    one.add("radii_off", call.radii_off);
  }));
}

}  // namespace lorentz::report
