#include "statistics/flights/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <lorentz/exchange.hpp>
#include "report/curves.hpp"
#include "report/files/messages.hpp"
#include "report/manifest.hpp"
#include "report/query_text.hpp"
#include "report/table.hpp"
#include "src/exchange/csv_table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::flights {

using json::finite;

namespace {

// The result of a test of fit. With only one bin nothing is tested.
std::string result_of(const ChiSquared& fit, double smooth_from) {
  if (!fit.p_value)
    return smooth_from > 0 ? fmt::format("not tested: hardly a flight is longer than {:g}", smooth_from)
                           : "not tested: too few flights for two bins";
  const double p = *fit.p_value;
  return fmt::format("p = {}", p < 1e-300 ? "below 1e-300"
                               : p < 1e-4 ? fmt::format("{:.1e}", p)
                                          : fmt::format("{:.4f}", p));
}

// A warning if the mean or its error do not, or may not, have their usual meaning.
std::string remark_on_mean(Ensemble from, const Tail& long_paths) {
  const bool uniform = from == Ensemble::uniform;
  if (!long_paths.open)
    return fmt::format("{} may be infinite, or too large for a sample: {}",
                       uniform ? "the exact mean" : "the variance", long_paths.remark);
  if (!*long_paths.open) return "";
  return uniform ? "the exact mean is infinite: open channels make the density of a first flight fall like "
                   "t^-2 in the end; what is here is a sample's mean, and grows with it"
                 : "the variance is infinite (a density like t^-3 in the end), so that the standard error is "
                   "too small";
}

std::string line_of_measured_constant(const Tail& tail, const FlightsFindings& found) {
  if (!tail.approach || !tail.constant || !found.mean.value) return "";
  const auto measured = found.measured_constant_of(tail);
  if (!measured)
    return "  not measured: where this power is three quarters of all flights, too few were counted\n";
  return fmt::format(
      "  measured: P(tau > t) ~ {:.5g} / t^{:g}, standard error {:.2g}: off by {:.2f} of these; extrapolated "
      "from {} flights longer than {:.6g}\n",
      measured->value, *tail.exponent - 1, measured->error,
      (measured->value - *tail.constant) / measured->error, measured->count, measured->from);
}

std::string theory_lines(const FlightsFindings& found) {
  std::string text;
  if (!found.no_law.empty()) text += fmt::format("no law is known: {}\n", found.no_law);
  if (found.law) {
    const double from = found.law->smooth_from;
    text += fmt::format("law: {} ({}{})\n", found.law->name, found.law->when,
                        from > 0 ? fmt::format("; tested beyond t = {:g}", from) : "");
    text += found.fit.p_value
                ? fmt::format("  chi squared {:.1f}, {} degrees: {}; of 1.02 times its survival: {}\n",
                              found.fit.statistic, found.fit.degrees, result_of(found.fit, from),
                              result_of(found.fit_of_more, from))
                : fmt::format("  {}\n", result_of(found.fit, from));
  }
  if (found.exponent)
    text += fmt::format(
        "tail: of {} flights longer than {:.6g} the density falls like t^-{:.3f}, 95 % [{:.3f}, {:.3f}]\n",
        found.exponent->count, found.exponent->from, found.exponent->exponent, found.exponent->low,
        found.exponent->high);
  else
    text += "tail: too few long flights for an exponent\n";
  if (found.exponent_of_law) text += fmt::format("  the law there: like t^-{:.3f}\n", *found.exponent_of_law);
  for (const Tail& tail : found.tails) {
    text += fmt::format("  theory, {}:", tail.when);
    if (tail.exponent) text += fmt::format(" t^-{:g}", *tail.exponent);
    if (tail.exponent && tail.constant)
      text += fmt::format(", P(tau > t) ~ {:.6g} / t^{:g}", *tail.constant, *tail.exponent - 1);
    if (!tail.remark.empty()) text += fmt::format("{} {}", tail.exponent ? ";" : "", tail.remark);
    text += '\n' + line_of_measured_constant(tail, found);
  }
  return text;
}

// The survival at powers of two, with one standard error.
std::string table_of_survival(const FlightsFindings& found) {
  std::vector<std::string> header{"t", "P(tau > t)", "+-"};
  if (found.law) header.push_back(found.law->name);
  report::Table table(header);
  const auto n = static_cast<double>(found.total);
  for (std::size_t i = 0; i < found.edges.size(); i += Bins::kAnOctave) {
    const double p = static_cast<double>(found.beyond[i]) / n;
    if (found.beyond[i] < 10 || p > 0.999) continue;
    std::vector<std::string> row{fmt::format("{:.6g}", found.edges[i]), fmt::format("{:.3e}", p),
                                 fmt::format("{:.1e}", std::sqrt(p * (1 - p) / n))};
    if (found.law) row.push_back(fmt::format("{:.3e}", found.law->survival(found.edges[i])));
    table.add(row);
  }
  return table.text();
}

std::optional<double> exact_mean(const FlightsReport& report, const FlightsFindings& found) {
  return report.plan.from == Ensemble::surface ? found.mean.value : std::nullopt;
}

// One hit has no standard error.
std::string line_of_mean(const FlightsReport& report, const FlightsFindings& found) {
  const double mean = report.account.tally.mean(), error = report.account.tally.standard_error();
  const bool has_error = std::isfinite(error);
  std::string text = fmt::format("mean {:.8g}, standard error {}", mean,
                                 has_error ? fmt::format("{:.2g}", error) : "not known");
  if (const auto exact = exact_mean(report, found))
    return text +
           fmt::format("; exact {:.10g}{} ({})", *exact,
                       has_error ? fmt::format(": off by {:.2f} of these", (mean - *exact) / error) : "",
                       found.mean.how);
  if (report.plan.from == Ensemble::surface) text += fmt::format("; no exact mean: {}", found.mean.how);
  return text;
}

// "Mean free path" means that of flights between collisions. The first flight from a uniform start differs
// from these.
std::string line_of_mean_free_path(const FlightsFindings& found) {
  const std::string value = found.mean.value ? fmt::format("{:.10g}", *found.mean.value) : "not known";
  return fmt::format("mean free path between collisions (--from surface): {} ({})\n", value, found.mean.how);
}

void add_theory(json::Members& object, const FlightsFindings& found) {
  const auto fit = [&](json::Members& one, const Law& law) {
    one.add("name", law.name, "when", law.when, "statistic", finite(found.fit.statistic), "degrees",
            found.fit.degrees, "p_value", finite(found.fit.p_value), "p_value_of_1.02",
            finite(found.fit_of_more.p_value), "tail_exponent", finite(found.exponent_of_law));
  };
  const auto tail = [&](json::Members& one, const Tail& t) {
    one.add("when", t.when, "exponent", finite(t.exponent), "constant", finite(t.constant), "remark",
            t.remark);
    if (const auto measured = found.measured_constant_of(t))
      one.add("measured", measured->value, "measured_error", measured->error, "measured_from", measured->from,
              "measured_count", measured->count);
  };
  object.add("tails", json::objects(found.tails, tail), "theory",
             json::objects(std::span(found.law ? &*found.law : nullptr, found.law ? 1 : 0), fit), "no_theory",
             found.no_law);
}

// Radii may differ.
bool are_of_one_scene(const std::vector<FlightsReport>& reports) {
  return std::all_of(reports.begin(), reports.end(), [&](const FlightsReport& report) {
    return report.scene_name == reports.front().scene_name;
  });
}

}  // namespace

std::string FlightsReport::table() const {
  const FlightsFindings found(*this);
  const FlightTally& tally = account.tally;
  std::string text = fmt::format("scene {}, {} starts, engine {}, seed {}\n",
                                 report::name_with_radius(scene_name, plan.scene), name_of(plan.from),
                                 plan.engine, plan.seed);
  text += fmt::format("{} flights", tally.flights());
  if (!is_whole())
    text += fmt::format(" of {} ({} of {} blocks)", plan.count, account.done.size(), plan.blocks());
  text +=
      fmt::format(": {} hits, {} never, {} undecided; {} starts lay in an obstacle, and were drawn anew\n",
                  tally.hits, tally.never, tally.undecided, tally.inside);
  if (tally.hits == 0) return text + "nothing was hit: there are no free paths to speak of\n";
  if (tally.undecided > 0)
    text += "what follows is without the undecided flights: wrong, if those are the longest\n";
  text += '\n' + line_of_mean(*this, found) + '\n';
  if (plan.from == Ensemble::uniform) text += line_of_mean_free_path(found);
  text += fmt::format("mean of ln tau {:.8g}; shortest {:.6g}, longest {:.6g}\n", tally.mean_log(),
                      tally.shortest, tally.longest);
  if (const std::string remark = remark_on_mean(plan.from, found.tails.back()); !remark.empty())
    text += remark + '\n';
  return text + '\n' + theory_lines(found) + '\n' + table_of_survival(found);
}

std::string FlightsReport::json() const {
  const FlightsFindings found(*this);
  const FlightTally& tally = account.tally;
  const auto if_any = [&](double x) { return tally.hits > 0 ? finite(x) : std::nullopt; };
  std::vector<std::string> survival;
  for (std::size_t i = 0; i < found.edges.size(); i += Bins::kAnOctave)
    if (found.beyond[i] > 0 && found.beyond[i] < found.total)
      survival.push_back(fmt::format("[{},{}]", found.edges[i], found.beyond[i]));
  const auto& e = found.exponent;
  return json::line_of([&](json::Members& object) {
    object.add("scene", scene_name);
    if (radius) object.add("radius", *radius);
    object.add("from", name_of(plan.from), "engine", plan.engine, "seed", plan.seed, "count", tally.flights(),
               "asked", plan.count, "hits", tally.hits, "never", tally.never, "undecided", tally.undecided,
               "drawn_anew", tally.inside);
    object.add("mean", if_any(tally.mean()), "mean_error", if_any(tally.standard_error()), "mean_exact",
               finite(exact_mean(*this, found)), "mean_free_path", finite(found.mean.value), "mean_remark",
               remark_on_mean(plan.from, found.tails.back()), "mean_log", if_any(tally.mean_log()),
               "shortest", if_any(tally.shortest), "longest", if_any(tally.longest));
    object.add("tail_exponent", e ? finite(e->exponent) : std::nullopt, "tail_interval",
               e ? std::optional(std::array{finite(e->low), finite(e->high)}) : std::nullopt, "tail_from",
               e ? finite(e->from) : std::nullopt, "tail_count", e ? e->count : 0);
    add_theory(object, found);
    object.add("survival", json::raw(survival), "seconds", finite(seconds));
  });
}

namespace {

using LawNames = std::vector<std::string>;

// The rows of one histogram: bin i is from edges[i] to edges[i + 1]. The last edge is infinite, so that its bin
// has no density.
void append_rows(std::string& text, const std::string& bins, const FlightsFindings& found,
                 const LawNames& laws, const std::vector<std::uint64_t>& counts,
                 const std::vector<double>& edges) {
  const auto n = static_cast<double>(found.total);
  std::uint64_t longer = found.total;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    longer -= counts[i];
    if (counts[i] == 0) continue;
    const double low = edges[i], high = edges[i + 1], width = high - low, c = static_cast<double>(counts[i]);
    text += fmt::format("{},{},{},{}", bins, low, high, counts[i]);
    if (i + 1 == counts.size()) {
      text += std::string(3 + 2 * laws.size(), ',') + '\n';
      break;
    }
    text +=
        fmt::format(",{},{},{}", c / n / width, std::sqrt(c) / n / width, static_cast<double>(longer) / n);
    for (const std::string& name : laws) {
      const bool is_its = found.law && found.law->name == name;
      const auto longer_than = [&](double t) { return found.law->survival(t); };
      text += is_its
                  ? fmt::format(",{},{}", (longer_than(low) - longer_than(high)) / width, longer_than(high))
                  : ",,";
    }
    text += '\n';
  }
}

// 0, the finite edges of a histogram, and infinity.
template <class Edge>
std::vector<double> edges_of(int first, int last, const Edge& edge) {
  std::vector<double> edges{0};
  for (int i = first; i <= last; ++i) edges.push_back(edge(i));
  edges.push_back(std::numeric_limits<double>::infinity());
  return edges;
}

// The names of the laws of all reports, each once.
LawNames law_names(const std::vector<FlightsFindings>& findings) {
  LawNames names;
  for (const FlightsFindings& found : findings)
    if (found.law && std::find(names.begin(), names.end(), found.law->name) == names.end())
      names.push_back(found.law->name);
  return names;
}

std::string csv_header(const std::string& places, const LawNames& laws) {
  std::string text = places + "bins,from,to,count,density,density_error,survival_at_to";
  for (std::string name : laws) {
    std::replace(name.begin(), name.end(), ',', ';');
    text += fmt::format(",{0}: density,{0}: survival_at_to", name);
  }
  return text + '\n';
}

std::optional<double> radius_of(const FlightsReport& report) {
  return report.radius ? report.radius : report::common_radius(report.plan.scene);
}

// The points of the curve, at every other edge. Edges that no path or nearly all paths pass are left out.
report::FreePathCurve curve_of(const FlightsReport& report, const FlightsFindings& found) {
  constexpr std::size_t kStep = Bins::kAnOctave / 4;
  constexpr double kNearlyAll = 0.995;
  report::FreePathCurve curve{
      report.scene_name, report.plan.engine, radius_of(report), name_of(report.plan.from), "", {}};
  if (found.law) curve.law = found.law->name + ", " + found.law->when;
  const auto total = static_cast<double>(found.total);
  for (std::size_t i = 0; i < found.edges.size(); i += kStep) {
    const double share = static_cast<double>(found.beyond[i]) / total;
    if (found.beyond[i] == 0 || share > kNearlyAll) continue;
    report::FreePathCurve::CurvePoint point{found.edges[i], share, {}, {}};
    if (found.law) point.theory = found.law->survival(point.t);
    curve.points.push_back(point);
  }
  return curve;
}

}  // namespace

std::string page_json(const std::vector<FlightsReport>& reports, const std::string& command) {
  const FlightsReport& first = reports.front();
  std::vector<report::FreePathCurve> curves;
  std::string line;
  for (const FlightsReport& report : reports) {
    const FlightsFindings found(report);
    curves.push_back(curve_of(report, found));
    const FlightTally& tally = report.account.tally;
    line += fmt::format("{}{}: {} flights", line.empty() ? "" : "; ",
                        report::name_with_radius(report.scene_name, report.plan.scene), tally.flights());
    if (tally.hits > 0) line += fmt::format(", mean {:.6g}", tally.mean());
    if (std::isfinite(tally.standard_error()) && found.tails.back().open == false)
      line += fmt::format(" ± {:.2g}", tally.standard_error());
    if (const auto exact = exact_mean(report, found)) line += fmt::format(", exact {:.6g}", *exact);
  }
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "flights", "title",
             fmt::format("Free paths: {}{} starts", are_of_one_scene(reports) ? first.scene_name + ", " : "",
                         name_of(first.plan.from)),
             "line", line, "manifest", report::manifest_of(first.plan.seed, command), "free_paths", curves);
  });
}

std::string csv_of(const std::vector<FlightsReport>& reports) {
  const std::vector<FlightsFindings> findings(reports.begin(), reports.end());
  const LawNames laws = law_names(findings);
  const bool one_scene = are_of_one_scene(reports), radii = reports.front().radius || !one_scene;
  std::string text = csv_header(fmt::format("{}{}", one_scene ? "" : "scene,", radii ? "radius," : ""), laws);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Bins& bins = reports[i].account.tally.bins;
    std::string place = one_scene ? "" : csv_field(reports[i].scene_name) + ',';
    if (radii) place += (reports[i].radius ? fmt::format("{}", *reports[i].radius) : "") + ',';
    append_rows(text, place + "logarithmic", findings[i], laws, bins.logarithmic,
                edges_of(0, Bins::kLogarithmic, [&](int bin) { return bins.log_edge(bin); }));
    append_rows(text, place + "linear", findings[i], laws, bins.linear,
                edges_of(1, Bins::kLinear, [&](int bin) { return bins.linear_edge(bin); }));
  }
  return text;
}

}  // namespace lorentz::flights
