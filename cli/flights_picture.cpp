// The picture of a run of flights: survival over time, theory drawn in.
#include <cmath>

#include <lorentz/errors.hpp>
#include "cli/flights_findings.hpp"
#include "cli/messages.hpp"
#include "pictures/free_path_plot.hpp"

namespace lorentz::cli {
namespace {

using pictures::FreePathPlot;
using pictures::PlotCurve;

constexpr int kPointsAnOctave = 2, kCurveAnOctave = 8;
constexpr std::uint64_t kFewest = 10;  // flights behind a point
constexpr double kNearlyAll = 0.995;

// From where on paths end at all, to where too few go on.
struct Span {
  std::size_t first = 0, last = 0;
};

Span span_of(const FlightsFindings& found) {
  Span span;
  while (span.first + 1 < found.edges.size() &&
         found.beyond[span.first] > kNearlyAll * static_cast<double>(found.total))
    ++span.first;
  span.last = span.first;
  while (span.last + 1 < found.edges.size() && found.beyond[span.last + 1] >= kFewest) ++span.last;
  return span;
}

PlotCurve curve_of(const std::string& name, const FlightsFindings& found, const Span& span,
                   const std::function<double(double)>& survival) {
  PlotCurve curve;
  curve.name = name;
  for (std::size_t i = span.first; i <= span.last; i += flights::Bins::kAnOctave / kCurveAnOctave)
    curve.points.push_back({found.edges[i], survival(found.edges[i])});
  return curve;
}

}  // namespace

std::string FlightsReport::svg() const {
  const FlightsFindings found(*this);
  if (account.tally.hits == 0) throw InputError("--svg: nothing was hit: there is nothing to draw");
  const Span span = span_of(found);
  FreePathPlot plot;
  plot.title = fmt::format("Free paths: {}, {} starts", name_with_radius(),
                           plan.from == flights::Ensemble::uniform ? "uniform" : "surface");
  plot.note =
      fmt::format("{} flights, bars of one standard error, engine {}, seed {}{}", account.tally.flights(),
                  plan.engine, plan.seed, found.fits.empty() ? "" : "; law: " + found.fits[0].law.name);
  plot.t_label = "free path t, in the scene's unit of length";
  plot.value_label = "P(free path > t)";
  plot.series.push_back({"measured", {}});
  const auto n = static_cast<double>(found.total);
  for (std::size_t i = span.first; i <= span.last; i += flights::Bins::kAnOctave / kPointsAnOctave) {
    const double p = static_cast<double>(found.beyond[i]) / n;
    plot.series[0].points.push_back({found.edges[i], p, std::sqrt(p * (1 - p) / n)});
  }
  for (const FlightsFindings::Fit& fit : found.fits)
    plot.curves.push_back(curve_of("law, " + fit.law.when, found, span, fit.law.survival));
  for (const flights::Tail& tail : found.tails) {
    if (!tail.exponent || !tail.constant || !(*tail.constant > 0)) continue;
    const double power = *tail.exponent - 1;
    Span late = span;
    while (late.first<late.last&& * tail.constant * std::pow(found.edges[late.first], -power)> 0.5)
      ++late.first;
    PlotCurve curve = curve_of(fmt::format("~ t^-{:g}, {}", power, tail.when), found, late,
                               [&](double t) { return *tail.constant * std::pow(t, -power); });
    curve.dashed = true;
    plot.curves.push_back(std::move(curve));
  }
  return draw_free_paths(plot);
}

}  // namespace lorentz::cli
