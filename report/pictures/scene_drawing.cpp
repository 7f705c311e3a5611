// The common parts of 2D and 3D pictures.
#include "report/pictures/scene_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {

namespace {

// The largest number of cells that are examined, whatever the scene is.
constexpr double kMostCells = 300'000;

// Adds one atom's obstacles in the box.
void add_obstacles(const Scene& scene, Placed obstacle, const std::array<Vec, 3>& u, const Extent& box,
                   std::vector<Placed>& found, bool& cut) {
  const int d = scene.dimension;
  const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
  const double reach = principal_semiaxes(atom, d)[0];
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
    if (i >= scene.lattices[obstacle.lattice].rank_in(d)) continue;  // the lattice does not repeat there
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

void Extent::include(const Vec& point, double margin) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], point[k] - margin);
    high[k] = std::max(high[k], point[k] + margin);
  }
}

bool Extent::contains(const Vec& point, double margin) const {
  for (int k = 0; k < 3; ++k)
    if (point[k] < low[k] - margin || point[k] > high[k] + margin) return false;
  return true;
}

std::vector<Placed> obstacles_in(const Scene& scene, const Extent& box, bool& cut) {
  std::vector<Placed> found;
  cut = false;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l) {
    const std::array<Vec, 3> u = with_short_vectors(scene.lattices[l], scene.dimension).vectors;
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      add_obstacles(scene, {l, a, {}}, u, box, found, cut);
  }
  return found;
}

void thin_out(std::vector<Placed>& obstacles, const Vec& centre, std::vector<std::string>& remarks) {
  if (obstacles.size() <= kMostDrawn) return;
  const auto distance2 = [&](const Placed& a) {
    const Vec arm = plus(a.centre, -1, centre);
    return dot(arm, arm);
  };
  remarks.push_back(fmt::format("the picture would hold {} obstacles; the {} nearest to its middle are drawn",
                                obstacles.size(), kMostDrawn));
  std::sort(obstacles.begin(), obstacles.end(),
            [&](const Placed& a, const Placed& b) { return distance2(a) < distance2(b); });
  obstacles.resize(kMostDrawn);
}

double cell_size(const Scene& scene) {
  const Scene whole = with_cells(scene);
  const double volume = cell_volume(whole.lattices[0], whole.dimension);
  if (!std::isnormal(volume)) throw InputError("this is too large, or too fine, to be drawn");
  return std::pow(volume, 1.0 / whole.dimension);
}

Vec cell_at(const Scene& scene, const std::array<Vec, 3>& u, const Vec& point, double cells) {
  const Lattice& lattice = scene.lattices[0];
  const auto rows = dual_of(u, scene.dimension);
  Vec corner{};
  for (int i = 0; i < scene.dimension; ++i) {
    const bool repeats = i < lattice.rank_in(scene.dimension);
    const double n =
        repeats ? std::floor(dot(rows[i], point)) : dot(rows[i], lattice.atoms[0].position) - cells / 2;
    corner = sum(corner, scaled(u[i], n));
  }
  return corner;
}

std::size_t colour_index(const Scene& scene, const Placed& obstacle) {
  std::size_t index = static_cast<std::size_t>(obstacle.atom);
  for (int l = 0; l < obstacle.lattice; ++l) index += scene.lattices[l].atoms.size();
  return index;
}

// Colours that colour-blind people can tell apart, after Paul Tol's "muted" and "bright" schemes.
const Colour& colour(std::size_t index) {
  static constexpr Colour kColours[] = {{"#4477aa", "#284b70", "#b9d0e8"}, {"#ddaa33", "#8a6514", "#f7e3b0"},
                                        {"#44aa88", "#1f6650", "#b8e6d6"}, {"#aa4499", "#6b2460", "#e8bfe1"},
                                        {"#88a030", "#55661a", "#dbe6ae"}, {"#cc6677", "#8a3342", "#f3cdd3"},
                                        {"#66ccee", "#2a7f9c", "#d3f1fb"}, {"#777777", "#444444", "#dddddd"},
                                        {"#bb7744", "#754520", "#eed3bf"}, {"#6655bb", "#3a2d7d", "#cfc8f0"}};
  return kColours[index % std::size(kColours)];
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

EllipseShape shadow_of(const Atom& atom, int dimension, const Vec& right, const Vec& up) {
  const auto columns = semiaxes_of(atom, dimension);
  return ellipse_of(coordinates(columns, right), coordinates(columns, up));
}

EllipseShape to_scale(const EllipseShape& shape, double scale, double smallest) {
  if (shape.rx * scale < smallest) return {smallest, smallest, 0};
  return {shape.rx * scale, shape.ry * scale, -shape.angle};
}

Scene with_cells(Scene scene) {
  const int d = scene.dimension;
  for (Lattice& lattice : scene.lattices) {
    double size = 0;
    for (const Atom& atom : lattice.atoms)
      size = std::max(
          size, length(plus(atom.position, -1, lattice.atoms[0].position)) + principal_semiaxes(atom, d)[0]);
    const int rank = lattice.rank_in(d);
    complete_perpendicularly(lattice.vectors, rank, d);
    for (int i = rank; i < d; ++i) lattice.vectors[i] = scaled(lattice.vectors[i], 3 * size);
  }
  return scene;
}

Drawing draw_scene(const Scene& given, const DrawOptions& options, const std::vector<DrawnFlight>& flights) {
  const Scene scene = with_cells(given);
  return scene.dimension == 2 ? draw_scene_2d(scene, options, flights)
                              : draw_scene_3d(scene, options, flights);
}

// ---- Flights as lines: their drawn lengths, and the obstacles that they hit

namespace {

double speed_of(const Query& query) {
  return std::hypot(query.v[0], query.v[1], query.v[2]);
}

double length_of(const DrawnFlight& flight) {
  return flight.answer.outcome == Outcome::hit ? flight.answer.time.value_or(0) * speed_of(flight.query) : 0;
}

// The greatest length at which a flight is drawn to its end. Nine of ten flights are shorter; so are those
// that are not much longer than these.
double longest_drawn(const std::vector<DrawnFlight>& flights, double cell) {
  const double most = kLongestFlight * cell;
  std::vector<double> lengths;
  for (const DrawnFlight& flight : flights)
    if (flight.answer.outcome == Outcome::hit) lengths.push_back(length_of(flight));
  constexpr std::size_t kFew = 4;
  if (lengths.size() < kFew) return most;
  std::sort(lengths.begin(), lengths.end());
  const double usual = std::max(4 * cell, 1.5 * lengths[lengths.size() * 9 / 10 - 1]);
  const auto end = std::upper_bound(lengths.begin(), lengths.end(), std::min(usual, most));
  return end == lengths.begin() ? most : *(end - 1);
}

// The line to the flight's hit, or cut at `longest`; a flight that never ends is three cells long.
DrawnLine line_of(const DrawnFlight& flight, double longest, double cell) {
  const Query& query = flight.query;
  DrawnLine line{query.x, query.x, true, &flight};
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

Placed placed(const Scene& scene, const ObstacleId& id) {
  const Lattice& lattice = scene.lattices[id.lattice];
  Vec centre = lattice.atoms[id.atom].position;
  for (int i = 0; i < scene.dimension; ++i)
    centre = plus(centre, std::strtod(id.cell[i].decimal().c_str(), nullptr), lattice.vectors[i]);
  return {id.lattice, id.atom, centre};
}

}  // namespace

std::vector<DrawnLine> lines_of(const Scene& scene, const std::vector<DrawnFlight>& flights,
                                std::vector<std::string>& remarks) {
  const double cell = cell_size(scene), longest = longest_drawn(flights, cell);
  std::vector<DrawnLine> lines;
  std::size_t far = 0, cut = 0;
  double most = 0;
  for (const DrawnFlight& flight : flights) {
    if (!(length(plus(flight.query.x, -1, flights[0].query.x)) <= kLongestFlight * cell)) {
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

std::vector<DrawnLine> lines_in_window(const Scene& scene, const std::vector<DrawnFlight>& flights) {
  constexpr double kFar = 1e12;  // cells: beyond any window that contains obstacles
  std::vector<DrawnLine> lines;
  for (const DrawnFlight& flight : flights)
    lines.push_back(line_of(flight, kFar * cell_size(scene), cell_size(scene)));
  return lines;
}

std::vector<Placed> hits_of(const Scene& scene, const std::vector<DrawnLine>& lines) {
  std::vector<Placed> hits;
  std::set<std::tuple<int, int, Vec>> seen;
  for (const DrawnLine& line : lines) {
    if (!line.ends) continue;
    const Placed hit = placed(scene, line.flight->answer.obstacle);
    if (seen.emplace(hit.lattice, hit.atom, hit.centre).second) hits.push_back(hit);
  }
  return hits;
}

}  // namespace lorentz::pictures
