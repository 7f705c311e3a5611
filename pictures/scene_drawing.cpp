// What both kinds of pictures share.
#include "pictures/scene_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>
#include <tuple>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "pictures/drawing_parts.hpp"

namespace lorentz::pictures {

// So that few cells are looked at: pairs are reduced until none gets shorter.
std::array<Vec, 3> short_vectors(const Lattice& lattice, int dimension) {
  std::array<Vec, 3> u = lattice.vectors;
  constexpr int kMostSteps = 10'000;
  bool shorter = true;
  for (int step = 0; step < kMostSteps && shorter; ++step) {
    shorter = false;
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) {
        const double share = i == k ? 0 : std::round(dot(u[i], u[k]) / dot(u[k], u[k]));
        if (share == 0) continue;
        Vec next = u[i];
        for (int m = 0; m < 3; ++m) next[m] -= share * u[k][m];
        if (!(dot(next, next) < dot(u[i], u[i]) * (1 - 1e-9))) continue;
        u[i] = next;
        shorter = true;
      }
  }
  return u;
}

namespace {

double reach_of(const Atom& atom, int dimension) {
  return principal_semiaxes(atom, dimension)[0];
}

// Looks at no more cells than this, whatever the scene is.
constexpr double kMostCells = 300'000;

// One atom's obstacles in the box.
void add_obstacles(const Scene& scene, Placed obstacle, const std::array<Vec, 3>& u, const Box& box,
                   std::vector<Placed>& found, bool& cut) {
  const int d = scene.dimension;
  const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
  const double reach = reach_of(atom, d);
  const std::array<Vec, 3> rows = dual_of(u, d);
  const Vec middle = box.centre();
  std::array<std::int64_t, 3> first{}, last{};
  double cells = 1;
  for (int i = 0; i < d; ++i) {
    double at = 0, half = 0;
    for (int k = 0; k < d; ++k) {
      at += rows[i][k] * (middle[k] - atom.position[k]);
      half += std::fabs(rows[i][k]) * ((box.high[k] - box.low[k]) / 2 + reach);
    }
    if (!(std::fabs(at) + half < 1e15))
      throw InputError("this is too far from the origin, or too fine, to be drawn");
    first[i] = static_cast<std::int64_t>(std::ceil(at - half));
    last[i] = static_cast<std::int64_t>(std::floor(at + half));
    cells *= 2 * half + 1;
  }
  if (cells > kMostCells) {
    cut = true;
    return;
  }
  for (std::int64_t i = first[0]; i <= last[0]; ++i)
    for (std::int64_t k = first[1]; k <= last[1]; ++k)
      for (std::int64_t m = first[2]; m <= last[2]; ++m) {
        for (int c = 0; c < 3; ++c)
          obstacle.centre[c] = atom.position[c] + static_cast<double>(i) * u[0][c] +
                               static_cast<double>(k) * u[1][c] +
                               (d == 3 ? static_cast<double>(m) * u[2][c] : 0);
        if (box.contains(obstacle.centre, reach)) found.push_back(obstacle);
      }
}

}  // namespace

void Box::include(const Vec& point, double margin) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], point[k] - margin);
    high[k] = std::max(high[k], point[k] + margin);
  }
}

bool Box::contains(const Vec& point, double margin) const {
  for (int k = 0; k < 3; ++k)
    if (point[k] < low[k] - margin || point[k] > high[k] + margin) return false;
  return true;
}

Vec Box::centre() const {
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

std::vector<Placed> obstacles_in(const Scene& scene, const Box& box, bool& cut) {
  std::vector<Placed> found;
  cut = false;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l) {
    const std::array<Vec, 3> u = short_vectors(scene.lattices[l], scene.dimension);
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      add_obstacles(scene, {l, a, {}}, u, box, found, cut);
  }
  return found;
}

void thin_out(std::vector<Placed>& obstacles, const Vec& centre, std::vector<std::string>& remarks) {
  if (obstacles.size() <= kMostDrawn) return;
  const auto distance2 = [&](const Placed& a) {
    const Vec arm{a.centre[0] - centre[0], a.centre[1] - centre[1], a.centre[2] - centre[2]};
    return dot(arm, arm);
  };
  remarks.push_back(fmt::format("the picture would hold {} obstacles; the {} nearest to its middle are drawn",
                                obstacles.size(), kMostDrawn));
  std::sort(obstacles.begin(), obstacles.end(),
            [&](const Placed& a, const Placed& b) { return distance2(a) < distance2(b); });
  obstacles.resize(kMostDrawn);
}

double cell_size(const Scene& scene) {
  return std::pow(cell_volume(scene.lattices[0], scene.dimension), 1.0 / scene.dimension);
}

Vec cell_at(const Scene& scene, const Vec& point) {
  return cell_at(scene.lattices[0].vectors, scene.dimension, point);
}

Vec cell_at(const std::array<Vec, 3>& u, int dimension, const Vec& point) {
  const auto rows = dual_of(u, dimension);
  Vec corner{};
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < 3; ++k) corner[k] += std::floor(dot(rows[i], point)) * u[i][k];
  return corner;
}

namespace {

double speed_of(const Query& query) {
  return std::hypot(query.v[0], query.v[1], query.v[2]);
}

double length_of(const Flight& flight) {
  return flight.answer.outcome == Outcome::hit ? flight.answer.time.value_or(0) * speed_of(flight.query) : 0;
}

// So long a flight is drawn to its end: nine of ten are, and those that are not much longer than these.
double longest_drawn(const std::vector<Flight>& flights, double cell) {
  const double most = kLongestFlight * cell;
  std::vector<double> lengths;
  for (const Flight& flight : flights)
    if (flight.answer.outcome == Outcome::hit) lengths.push_back(length_of(flight));
  constexpr std::size_t kFew = 4;
  if (lengths.size() < kFew) return most;
  std::sort(lengths.begin(), lengths.end());
  const double usual = std::max(4 * cell, 1.5 * lengths[lengths.size() * 9 / 10 - 1]);
  const auto end = std::upper_bound(lengths.begin(), lengths.end(), std::min(usual, most));
  return end == lengths.begin() ? most : *(end - 1);
}

// To its hit, or cut there; one that never ends is three cells long.
Line line_of(const Flight& flight, double longest, double cell) {
  const Query& query = flight.query;
  Line line{query.x, query.x, true, &flight};
  double length = length_of(flight);
  if (!(length <= longest)) {
    line.ends = false;
    length = longest;
  } else if (flight.answer.outcome == Outcome::never) {
    line.ends = false;
    length = 3 * cell;
  }
  for (int k = 0; k < 3; ++k) line.to[k] += length * (query.v[k] / speed_of(query));
  return line;
}

}  // namespace

std::vector<Line> lines_of(const Scene& scene, const std::vector<Flight>& flights,
                           std::vector<std::string>& remarks) {
  const double cell = cell_size(scene), longest = longest_drawn(flights, cell);
  std::vector<Line> lines;
  std::size_t far = 0, cut = 0;
  double most = 0;
  for (const Flight& flight : flights) {
    Vec arm{};
    for (int k = 0; k < 3; ++k) arm[k] = flight.query.x[k] - flights[0].query.x[k];
    if (!(length(arm) <= kLongestFlight * cell)) {
      ++far;
      continue;
    }
    lines.push_back(line_of(flight, longest, cell));
    if (lines.back().ends || flight.answer.outcome != Outcome::hit) continue;
    ++cut;
    most = std::max(most, length_of(flight));
  }
  if (cut > 0)
    remarks.push_back(
        fmt::format("flights that go on beyond the picture: {}, the longest for {:.4g}", cut, most));
  if (far > 0)
    remarks.push_back(fmt::format("flights left out, for they start more than {} cells from the first: {}",
                                  kLongestFlight, far));
  return lines;
}

std::vector<Line> lines_in_window(const Scene& scene, const std::vector<Flight>& flights) {
  constexpr double kFar = 1e12;  // cells: beyond any window with obstacles in it
  std::vector<Line> lines;
  for (const Flight& flight : flights)
    lines.push_back(line_of(flight, kFar * cell_size(scene), cell_size(scene)));
  return lines;
}

namespace {

// The obstacle that a flight hits or starts in, if any.
bool obstacle_of(const Scene& scene, const Flight& flight, Placed& obstacle) {
  if (flight.answer.outcome == Outcome::never) return false;
  const ObstacleId& id = flight.answer.obstacle;
  const Lattice& lattice = scene.lattices[id.lattice];
  obstacle = {id.lattice, id.atom, lattice.atoms[id.atom].position};
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < 3; ++k)
      obstacle.centre[k] += std::strtod(id.cell[i].decimal().c_str(), nullptr) * lattice.vectors[i][k];
  return true;
}

}  // namespace

std::vector<Placed> hits_of(const Scene& scene, const std::vector<Line>& lines) {
  std::vector<Placed> hits;
  std::set<std::tuple<int, int, Vec>> seen;
  Placed hit;
  for (const Line& line : lines)
    if (line.ends && obstacle_of(scene, *line.flight, hit) &&
        seen.emplace(hit.lattice, hit.atom, hit.centre).second)
      hits.push_back(hit);
  return hits;
}

std::size_t colour_index(const Scene& scene, const Placed& obstacle) {
  std::size_t index = static_cast<std::size_t>(obstacle.atom);
  for (int l = 0; l < obstacle.lattice; ++l) index += scene.lattices[l].atoms.size();
  return index;
}

// Told apart by the colour-blind too: after Paul Tol's "muted" and "bright" schemes.
const Colour& colour(std::size_t index) {
  static constexpr Colour kColours[] = {{"#4477aa", "#284b70", "#b9d0e8"}, {"#ddaa33", "#8a6514", "#f7e3b0"},
                                        {"#44aa88", "#1f6650", "#b8e6d6"}, {"#aa4499", "#6b2460", "#e8bfe1"},
                                        {"#88a030", "#55661a", "#dbe6ae"}, {"#cc6677", "#8a3342", "#f3cdd3"},
                                        {"#66ccee", "#2a7f9c", "#d3f1fb"}, {"#777777", "#444444", "#dddddd"},
                                        {"#bb7744", "#754520", "#eed3bf"}, {"#6655bb", "#3a2d7d", "#cfc8f0"}};
  return kColours[index % std::size(kColours)];
}

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

// Entries side by side in columns, row by row.
class Columns {
 public:
  Columns(double top, double space, std::size_t longest_label)
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

void add_flight_entries(Svg& svg, Columns& columns, const Legend& legend) {
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

void add_way_entries(Svg& svg, Columns& columns, const Legend& legend, const std::vector<FreeWay>& ways) {
  for (const std::size_t number : legend.ways) {
    const Point at = columns.next();
    svg.polygon({{at.x - 8, at.y - 6}, {at.x + 8, at.y - 6}, {at.x + 8, at.y + 6}, {at.x - 8, at.y + 6}},
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

}  // namespace

double add_legend(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                  double top) {
  constexpr std::size_t kMostEntries = 12;
  Columns columns(top, options.width - 2 * kMargin, longest_label(scene, options, legend));
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

namespace {

constexpr double kLegendGap = 14, kBottomMargin = 6;

double title_height(const DrawOptions& options) {
  return options.title.empty() ? kMargin / 2 : 40;
}

}  // namespace

Page::Page(const Scene& scene, const DrawOptions& options, const Legend& legend, double tallest)
    : top(title_height(options)), width(options.width - 2 * kMargin), height(tallest * options.width / 800) {
  if (options.height <= 0) return;
  Svg scratch;
  constexpr double kOneNote = 18, kLeast = 40;
  const double below =
      options.legend ? add_legend(scratch, scene, options, legend, kLegendGap) + kOneNote : kMargin / 2;
  height = std::max(kLeast, options.height - top - below - kBottomMargin);
}

std::string finished(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                     double bottom) {
  if (!options.title.empty()) svg.text({kMargin, 25}, options.title, "font-size=\"16\" font-weight=\"bold\"");
  bottom =
      options.legend ? add_legend(svg, scene, options, legend, bottom + kLegendGap) : bottom + kMargin / 2;
  const double height =
      options.height > 0 ? std::min(options.height, bottom + kBottomMargin) : bottom + kBottomMargin;
  return svg.document(options.width, height, options.title);
}

const char* way_colour(std::size_t number) {
  static constexpr const char* kColours[] = {"#1b9e5a", "#7a5cc8", "#d98a00", "#0f8fb3", "#b0467f"};
  return kColours[number % std::size(kColours)];
}

// M M^T = [[p, q], [q, s]] has the squared semiaxes as eigenvalues.
EllipseShape ellipse_of(const Vec& m1, const Vec& m2) {
  const double p = dot(m1, m1), q = dot(m1, m2), s = dot(m2, m2);
  const double mean = (p + s) / 2, spread = std::hypot((p - s) / 2, q);
  const Vec normal = cross(m1, m2);
  const double major2 = mean + spread, minor2 = dot(normal, normal) / major2;
  const double angle = spread > 1e-12 * mean ? std::atan2(2 * q, p - s) / 2 : 0;
  return {std::sqrt(major2), spread > 1e-12 * mean ? std::sqrt(minor2) : std::sqrt(major2), angle};
}

Drawing draw_scene(const Scene& scene, const DrawOptions& options, const std::vector<Flight>& flights) {
  return scene.dimension == 2 ? draw_scene_2d(scene, options, flights)
                              : draw_scene_3d(scene, options, flights);
}

}  // namespace lorentz::pictures
