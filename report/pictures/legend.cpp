// The page around a picture: title, legend, notes.
#include <algorithm>

#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {

std::string name_of(const Scene& scene, const Placed& obstacle) {
  const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
  std::string name = scene.lattices.size() > 1 ? fmt::format("lattice {}, ", obstacle.lattice) : "";
  name += fmt::format("atom {}: ", obstacle.atom);
  if (atom.is_ball()) return name + fmt::format("radius {:.4g}", atom.radius);
  const auto [a, b, c] = principal_semiaxes(atom, scene.dimension);
  return name + (scene.dimension == 2 ? fmt::format("semiaxes {:.4g}, {:.4g}", a, b)
                                      : fmt::format("semiaxes {:.4g}, {:.4g}, {:.4g}", a, b, c));
}

namespace {

// Entries in columns, row by row.
class LegendColumns {
 public:
  LegendColumns(double top, double space, std::size_t longest_label)
      : top_(top),
        space_(space),
        columns_(std::max<std::size_t>(
            1, static_cast<std::size_t>(space / (28 + kLetter * static_cast<double>(longest_label))))) {}

  Point next() {
    const double row = static_cast<double>(slot_ / columns_), column = static_cast<double>(slot_ % columns_);
    ++slot_;
    return {kMargin + 8 + column * space_ / static_cast<double>(columns_), top_ + 8 + row * kRow};
  }
  double bottom() const { return top_ + 8 + static_cast<double>((slot_ + columns_ - 1) / columns_) * kRow; }

 private:
  static constexpr double kRow = 22, kLetter = 7;
  double top_, space_;
  std::size_t columns_, slot_ = 0;
};

void add_label(Svg& svg, Point at, const std::string& words) {
  svg.text({at.x + 16, at.y + 4.5}, words);
}

void add_flight_entries(Svg& svg, LegendColumns& columns, const Legend& legend) {
  if (legend.hits) {
    const Point at = columns.next();
    svg.polyline({{at.x - 8, at.y}, {at.x + 6, at.y}},
                 fmt::format("stroke=\"{}\" stroke-width=\"1.6\"", kFlightColour));
    svg.ellipse({at.x + 6, at.y}, {2.6, 2.6, 0}, fmt::format("fill=\"{}\"", kFlightColour));
    add_label(svg, at, "flight to its first hit");
  }
  if (legend.goes_on || legend.never) {
    const Point at = columns.next();
    svg.arrow({at.x - 9, at.y}, {at.x + 9, at.y}, 9, kFlightColour, 1.6);
    add_label(svg, at, !legend.never ? "goes on" : legend.goes_on ? "goes on, or never hits" : "never hits");
  }
  if (legend.inside) {
    const Point at = columns.next();
    svg.ellipse(at, {2.6, 2.6, 0}, fmt::format("fill=\"{}\"", kFlightColour));
    add_label(svg, at, "starts inside");
  }
}

void add_way_entries(Svg& svg, LegendColumns& columns, const Legend& legend,
                     const std::vector<FreeWay>& ways) {
  for (const std::size_t number : legend.ways) {
    const Point at = columns.next();
    svg.rectangle({at.x - 8, at.y - 6}, {at.x + 8, at.y + 6},
                  fmt::format("fill=\"{0}\" fill-opacity=\"0.35\" stroke=\"{0}\"", way_colour(number)));
    add_label(svg, at, ways[number].name);
  }
}

std::size_t longest_label(const Scene& scene, const DrawOptions& options, const Legend& legend) {
  std::size_t longest = std::max<std::size_t>(24, legend.cell.size());
  for (const auto& [lattice, atom] : legend.atoms)
    longest = std::max(longest, name_of(scene, {lattice, atom, {}}).size());
  for (const std::size_t number : legend.ways) longest = std::max(longest, options.ways[number].name.size());
  return longest;
}

constexpr double kLegendGap = 14, kBottomMargin = 6;

// The legend from `top` downwards; returns its lower end.
double add_legend(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                  double top) {
  constexpr std::size_t kMostEntries = 12;
  LegendColumns columns(top, options.width - 2 * kMargin, longest_label(scene, options, legend));
  std::size_t atoms = 0;
  for (const auto& [lattice, atom] : legend.atoms) {
    if (++atoms > kMostEntries) continue;
    const Placed obstacle{lattice, atom, {}};
    const Colour& c = colour(colour_index(scene, obstacle));
    const Point at = columns.next();
    svg.ellipse(at, {7, 7, 0}, fmt::format("fill=\"{}\" stroke=\"{}\"", c.fill, c.dark));
    add_label(svg, at, name_of(scene, obstacle));
  }
  if (atoms > kMostEntries)
    add_label(svg, columns.next(), fmt::format("and {} more atoms", atoms - kMostEntries));
  if (!legend.cell.empty()) {
    const Point at = columns.next();
    svg.polygon({{at.x - 7, at.y + 5}, {at.x + 3, at.y + 5}, {at.x + 7, at.y - 5}, {at.x - 3, at.y - 5}},
                "fill=\"none\" stroke=\"#222222\" stroke-width=\"1.6\"");
    add_label(svg, at, legend.cell);
  }
  add_flight_entries(svg, columns, legend);
  add_way_entries(svg, columns, legend, options.ways);
  double bottom = columns.bottom();
  for (const std::string& note : legend.notes) {
    svg.text({kMargin, bottom + 4}, note, "fill=\"#555555\" font-size=\"12\"");
    bottom += 18;
  }
  return bottom;
}

}  // namespace

Page::Page(const Scene& scene, const DrawOptions& options, const Legend& legend, double tallest)
    : top(options.title.empty() ? kMargin / 2 : 40),
      width(options.width - 2 * kMargin),
      height(tallest * options.width / 800) {
  if (options.height <= 0) return;
  Svg scratch;
  constexpr double kOneNote = 18, kLeast = 40;
  const double below = add_legend(scratch, scene, options, legend, kLegendGap) + kOneNote;
  height = std::max(kLeast, options.height - top - below - kBottomMargin);
}

std::string finished(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                     double bottom) {
  if (!options.title.empty()) svg.text({kMargin, 25}, options.title, "font-size=\"16\" font-weight=\"bold\"");
  bottom = add_legend(svg, scene, options, legend, bottom + kLegendGap);
  const double height =
      options.height > 0 ? std::min(options.height, bottom + kBottomMargin) : bottom + kBottomMargin;
  return svg.document(options.width, height, options.title);
}

const char* way_colour(std::size_t number) {
  static constexpr const char* kColours[] = {"#1b9e5a", "#7a5cc8", "#d98a00", "#0f8fb3", "#b0467f"};
  return kColours[number % std::size(kColours)];
}

}  // namespace lorentz::pictures
