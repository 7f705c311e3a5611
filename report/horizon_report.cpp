#include "report/horizon_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include "report/table.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string verdict_of(const oracle::Horizon& h) {
  if (h.is_finite()) return "finite horizon: every path ends";
  if (!h.is_infinite())
    return h.min_width > 0 && h.undecided.empty() && h.families.empty() && h.no_cylinders.empty()
               ? "no channel is so wide"
               : "no open channel found, but not all is known";
  std::vector<std::string> parts;
  if (!h.channels.empty())
    parts.push_back(h.dimension == 2 ? counted(h.normals, "corridor direction")
                                     : counted(h.normals, "normal") + " of planar channels");
  if (h.channels.size() > h.normals) parts.back() += ", " + counted(h.channels.size(), "channel");
  if (!h.cylinders.empty())
    parts.push_back(counted(h.cylinders.size(), "direction") + " of cylindrical channels");
  std::size_t infinite = 0;
  for (const auto& family : h.families) infinite += family.infinite;
  if (infinite) parts.push_back("infinitely many cylindrical channels in " + counted(infinite, "plane"));
  return fmt::format("infinite horizon: {}", fmt::join(parts, "; "));
}

namespace {

constexpr std::size_t kMostRows = 20;

std::string text_of(const Vec& a, int dimension) {
  return fmt::format("{:.6g}", fmt::join(components(a, dimension), " "));
}

// Those that a table has.
auto first_of(const auto& all) {
  return std::span(all).first(std::min(kMostRows, all.size()));
}

std::string rest_of(std::size_t all) {
  return all > kMostRows ? fmt::format("... and {} more (--json has them)\n", all - kMostRows) : "";
}

// Points that rounding has moved out of the channel are followed by a *. A component that is only the
// rounding error of another one is shown as 0.
std::string point_text(Vec point, bool inside, int dimension) {
  const double largest = largest_component(point);
  for (double& component : point)
    if (std::fabs(component) < 0x1p-50 * largest) component = 0;
  return text_of(point, dimension) + (inside ? "" : " *");
}

std::string channel_table(const oracle::Horizon& h) {
  const bool flat = h.dimension == 2;
  bool counts = false;
  for (const auto& channel : h.channels) counts |= !(channel.count == Integer(1));
  std::vector<std::string> header{flat ? "direction" : "planes", "width", flat ? "vector" : "normal",
                                  "through"};
  if (counts) header.push_back("count");
  Table table(header);
  for (const oracle::Channel& c : first_of(h.channels)) {
    const std::string indices = decimals(components(c.indices, h.dimension), " ");
    std::vector<std::string> row{flat ? "[" + indices + "]" : "(" + indices + ")",
                                 fmt::format("{:.10g}", c.width), text_of(c.vector, h.dimension),
                                 point_text(c.point, c.inside, h.dimension)};
    if (counts) row.push_back(c.count.decimal());
    table.add(row);
  }
  return table.text() + rest_of(h.channels.size());
}

std::string cylinder_table(const oracle::Horizon& h) {
  Table table({"cylinder", "radius", "vector", "through"});
  for (const oracle::Cylinder& c : first_of(h.cylinders))
    table.add({"[" + decimals(c.direction, " ") + "]", fmt::format("{:.6g}", c.radius), text_of(c.vector, 3),
               point_text(c.point, c.inside, 3)});
  return table.text() + rest_of(h.cylinders.size());
}

std::string families_text(const oracle::Horizon& h) {
  std::string out;
  for (const oracle::CylinderFamily& family : first_of(h.families)) {
    const std::string planes = decimals(family.indices, " ");
    if (family.infinite)
      out += fmt::format(
          "planes ({}): the obstacles just touch; cylindrical channels in all but finitely many directions\n",
          planes);
    else
      out += fmt::format(
          "planes ({}): the obstacles overlap by little; of about {:.2g} directions only the shortest "
          "searched\n",
          planes, family.directions);
  }
  return out + rest_of(h.families.size());
}

std::string tail_text(const oracle::Horizon& h) {
  if (h.is_finite()) return "tail: none, the free path is bounded\n";
  if (!h.tail_constant) return fmt::format("tail constant: not given ({})\n", h.no_tail_constant);
  if (h.channels.empty())
    return "tail: P(free path > t) falls faster than 1/t, for no planar channel is open\n";
  return fmt::format("tail: P(free path > t) ~ C / t from a uniform start, C = {:.6g}\n", *h.tail_constant);
}

}  // namespace

std::string text_of(const oracle::Horizon& h) {
  std::string out = verdict_of(h) + "\n";
  bool outside = false;
  for (const oracle::Channel& c : first_of(h.channels)) outside |= !c.inside;
  for (const oracle::Cylinder& c : first_of(h.cylinders)) outside |= !c.inside;
  if (!h.channels.empty()) out += "\n" + channel_table(h);
  if (!h.cylinders.empty()) out += "\n" + cylinder_table(h);
  if (!h.families.empty()) out += "\n" + families_text(h);
  if (outside) out += "* too narrow there: the rounded point is not inside\n";
  if (!h.undecided.empty())
    out += fmt::format("\nundecided: {}, three lattices or more with long common periods\n",
                       counted(h.undecided.size(), h.dimension == 2 ? "direction" : "normal"));
  out += "\n" + tail_text(h);
  if (!h.no_cylinders.empty()) out += "cylinders: undecided (" + h.no_cylinders + ")\n";
  return out;
}

namespace {

// Each item on a line of its own.
constexpr const char* kOwnLine = "\n ";

void add_channel(json::Members& object, const oracle::Channel& c, int d) {
  const auto indices = components(c.indices, d);
  const auto vector = components(c.vector, d);
  if (d == 2)
    object.add("direction", indices, "vector", vector);
  else
    object.add("planes", indices, "normal", vector);
  object.add("width", c.width, "point", components(c.point, d), "point_inside", c.inside, "count", c.count);
}

void add_cylinders(json::Members& object, const oracle::Horizon& h) {
  object.add("complete", h.no_cylinders.empty());
  if (!h.no_cylinders.empty()) object.add("reason", h.no_cylinders);
  const auto cylinder = [](json::Members& one, const oracle::Cylinder& c) {
    one.add("direction", c.direction, "vector", c.vector, "point", c.point, "point_inside", c.inside,
            "radius", c.radius);
  };
  const auto family = [](json::Members& one, const oracle::CylinderFamily& f) {
    one.add("planes", f.indices, "infinite", f.infinite);
    if (!f.infinite) one.add("directions", f.directions);
  };
  object.add("open", json::objects(h.cylinders, cylinder, kOwnLine), "families",
             json::objects(h.families, family, kOwnLine));
}

}  // namespace

std::string json_of(const oracle::Horizon& h, const std::string& scene) {
  const int d = h.dimension;
  const auto channel = [d](json::Members& one, const oracle::Channel& c) { add_channel(one, c, d); };
  const auto undecided = [d](std::string& out, const auto& i) { json::append(out, components(i, d)); };
  return json::line_of([&](json::Members& object) {
    object.add("scene", scene, "dimension", d, "horizon",
               h.is_infinite() ? "infinite" : (h.is_finite() ? "finite" : "undecided"), "directions",
               h.normals);
    object.add("channels", json::objects(h.channels, channel, kOwnLine), "undecided",
               json::array(h.undecided, undecided, kOwnLine));
    if (d == 3) object.add("cylinders", [&](json::Members& cylinders) { add_cylinders(cylinders, h); });
    if (h.tail_constant)
      object.add("tail_constant", *h.tail_constant);
    else
      object.add("no_tail_constant", h.no_tail_constant);
  });
}

}  // namespace lorentz::report
