// Flights as lines: their drawn lengths, and the obstacles that they hit.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
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
