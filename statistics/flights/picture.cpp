// Pictures of runs of flights: survival and density over time, with the curves of theory.
#include <algorithm>
#include <cmath>

#include <lorentz/errors.hpp>
#include "files/messages.hpp"
#include "pictures/free_path_plot.hpp"
#include "report/scene_name.hpp"
#include "statistics/flights/report.hpp"

namespace lorentz::flights {
namespace {

using pictures::FreePathPlot;
using pictures::PlotCurve;

std::string title_of(const std::vector<FlightsReport>& reports) {
  const FlightsReport& first = reports.front();
  const std::string scene = !are_of_one_scene(reports) ? ""
                            : first.radius
                                ? first.scene_name + ", "
                                : report::name_with_radius(first.scene_name, first.plan.scene) + ", ";
  return fmt::format("Free paths: {}{} starts", scene, name_of(first.plan.from));
}

// The names of the laws: the first law of each scene.
std::string laws_behind(const std::vector<FlightsReport>& reports) {
  std::vector<std::string> names;
  for (const FlightsReport& report : reports) {
    const Laws laws = laws_of(report.plan.scene, report.plan.from);
    if (!laws.laws.empty() && std::find(names.begin(), names.end(), laws.laws[0].name) == names.end())
      names.push_back(laws.laws[0].name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// The parts that both pictures share: scene, starts, number of flights.
FreePathPlot plot_of(const std::vector<FlightsReport>& reports, const PictureStyle& style) {
  const FlightsReport& first = reports.front();
  const auto nothing_hit = [](const FlightsReport& report) { return report.account.tally.hits == 0; };
  if (std::all_of(reports.begin(), reports.end(), nothing_hit))
    throw InputError("nothing was hit: there is nothing to draw");
  FreePathPlot plot;
  plot.title = style.title.value_or(title_of(reports));
  plot.width = style.width, plot.height = style.height;
  plot.note = fmt::format("{} flights{}, bars of one standard error, engine {}, seed {}",
                          first.account.tally.flights(), reports.size() > 1 ? " each" : "", first.plan.engine,
                          first.plan.seed);
  if (const std::string laws = laws_behind(reports); !laws.empty()) plot.note += "; law: " + laws;
  return plot;
}

// The names of the series: the properties in which the reports differ.
std::vector<std::string> series_names(const std::vector<FlightsReport>& reports) {
  const bool one_scene = are_of_one_scene(reports);
  std::vector<std::string> names;
  for (const FlightsReport& report : reports)
    names.push_back(!one_scene      ? report::name_with_radius(report.scene_name, report.plan.scene)
                    : report.radius ? fmt::format("r = {:g}", *report.radius)
                                    : "measured");
  return names;
}

// Adds a theory curve for the last series: grey if there is only one series, else in the colour of its
// points. The legend lists each name once.
void add_curve(FreePathPlot& plot, bool is_grey, PlotCurve curve) {
  curve.series = is_grey ? -1 : static_cast<int>(plot.series.size()) - 1;
  for (const PlotCurve& other : plot.curves)
    if (other.name == curve.name) curve.name.clear();
  plot.curves.push_back(std::move(curve));
}

// ---- survival: both axes logarithmic

constexpr int kPointsAnOctave = 2, kCurveAnOctave = 8;
constexpr std::uint64_t kFewest = 10;  // flights behind a point
constexpr double kNearlyAllShown = 0.995;

// From the first edge at which paths have ended, to the last edge that enough paths pass.
struct PathSpan {
  std::size_t first = 0, last = 0;
};

PathSpan span_of(const FlightsFindings& found) {
  PathSpan span;
  while (span.first + 1 < found.edges.size() &&
         found.beyond[span.first] > kNearlyAllShown * static_cast<double>(found.total))
    ++span.first;
  span.last = span.first;
  while (span.last + 1 < found.edges.size() && found.beyond[span.last + 1] >= kFewest) ++span.last;
  return span;
}

PlotCurve survival_curve(const std::string& name, const FlightsFindings& found, const PathSpan& span,
                         const std::function<double(double)>& survival) {
  PlotCurve curve;
  curve.name = name;
  for (std::size_t i = span.first; i <= span.last; i += Bins::kAnOctave / kCurveAnOctave)
    curve.points.push_back({found.edges[i], survival(found.edges[i])});
  return curve;
}

// The power law, drawn from where it is below one half.
PlotCurve tail_curve(const Tail& tail, const FlightsFindings& found, PathSpan span) {
  const double power = *tail.exponent - 1;
  const auto survival = [&](double t) { return *tail.constant * std::pow(t, -power); };
  while (span.first < span.last && survival(found.edges[span.first]) > 0.5) ++span.first;
  PlotCurve curve = survival_curve(fmt::format("~ t^-{:g}, {}", power, tail.when), found, span, survival);
  curve.dashed = true;
  return curve;
}

void add_survival(FreePathPlot& plot, const FlightsReport& report, const std::string& name, bool is_alone) {
  const FlightsFindings found(report);
  const PathSpan span = span_of(found);
  pictures::PlotSeries series{name, {}};
  const auto n = static_cast<double>(found.total);
  for (std::size_t i = span.first; i <= span.last; i += Bins::kAnOctave / kPointsAnOctave) {
    const double p = static_cast<double>(found.beyond[i]) / n;
    series.points.push_back({found.edges[i], p, std::sqrt(p * (1 - p) / n)});
  }
  plot.series.push_back(std::move(series));
  for (const FlightsFindings::Fit& fit : found.fits)
    add_curve(plot, is_alone, survival_curve("law, " + fit.law.when, found, span, fit.law.survival));
  for (const Tail& tail : found.tails)
    if (tail.exponent && tail.constant && *tail.constant > 0)
      add_curve(plot, is_alone, tail_curve(tail, found, span));
}

// ---- density: both axes linear, and from 0

constexpr double kMostPoints = 48, kCurvePerBin = 4;
constexpr double kHardlyAny = 0.01;  // fraction of the highest density at which the picture ends

// Several linear bins combined, so that points can be told apart.
struct Density {
  double from, to, value, error;
};

std::vector<Density> densities_of(const FlightsFindings& found, const Bins& bins) {
  const auto n = static_cast<double>(found.total);
  const auto density = [&](int first, int last) {
    std::uint64_t count = 0;
    for (int i = first; i < last; ++i) count += bins.linear[static_cast<std::size_t>(i)];
    const double from = bins.linear_edge(first), to = bins.linear_edge(last), c = static_cast<double>(count);
    return Density{from, to, c / n / (to - from), std::sqrt(c) / n / (to - from)};
  };
  double highest = 0;
  int end = 0;
  for (int i = 0; i < Bins::kLinear; ++i) {
    const double value = density(i, i + 1).value;
    highest = std::max(highest, value);
    if (value > kHardlyAny * highest) end = i + 1;
  }
  const int together = std::max(1, static_cast<int>(std::ceil(end / kMostPoints)));
  std::vector<Density> points;
  for (int i = 0; i + together <= end; i += together) points.push_back(density(i, i + together));
  return points;
}

// `unit`: the unit of time.
void add_density(FreePathPlot& plot, const FlightsReport& report, double unit, const std::string& name,
                 bool is_alone) {
  const FlightsFindings found(report);
  const std::vector<Density> points = densities_of(found, report.account.tally.bins);
  pictures::PlotSeries series{name, {}};
  for (const Density& point : points)
    series.points.push_back({(point.from + point.to) / 2 / unit, point.value * unit, point.error * unit});
  plot.series.push_back(std::move(series));
  if (points.empty()) return;
  for (const FlightsFindings::Fit& fit : found.fits) {
    PlotCurve curve;
    curve.name = "law, " + fit.law.when;
    const double step = (points[0].to - points[0].from) / kCurvePerBin;
    for (double t = points[0].from; t + step <= points.back().to * (1 + 1e-12); t += step)
      curve.points.push_back(
          {(t + step / 2) / unit, (fit.law.survival(t) - fit.law.survival(t + step)) / step * unit});
    add_curve(plot, is_alone, std::move(curve));
  }
}

}  // namespace

std::string survival_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style) {
  FreePathPlot plot = plot_of(reports, style);
  plot.t_label = "free path t, in the scene's unit of length";
  plot.value_label = "P(free path > t)";
  const std::vector<std::string> names = series_names(reports);
  for (std::size_t i = 0; i < reports.size(); ++i)
    add_survival(plot, reports[i], names[i], reports.size() == 1);
  return draw_free_paths(plot);
}

// Times are in units of the mean free path between collisions, if it is known. In these units the limit law
// is one curve.
std::string density_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style) {
  FreePathPlot plot = plot_of(reports, style);
  plot.axes = pictures::AxisScale::linear;
  std::vector<std::optional<double>> means;
  for (const FlightsReport& report : reports) means.push_back(FlightsFindings(report).mean.value);
  const bool scaled =
      std::all_of(means.begin(), means.end(), [](const auto& mean) { return mean.has_value(); });
  plot.t_label =
      scaled ? "free path / mean free path between collisions" : "free path, in the scene's unit of length";
  plot.value_label = scaled ? "density × mean free path" : "density of the free path";
  const std::vector<std::string> names = series_names(reports);
  for (std::size_t i = 0; i < reports.size(); ++i)
    add_density(plot, reports[i], scaled ? *means[i] : 1, names[i], reports.size() == 1);
  return draw_free_paths(plot);
}

}  // namespace lorentz::flights
