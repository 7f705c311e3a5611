#include "judge/golden/seen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz::golden {
namespace {

constexpr double kFar = 1e6, kTiny = 1e-5, kNear = 0x1p-20;
constexpr int kSmall = 8;

bool is_hard(const std::optional<oracle::HardestDecision>& decision) {
  return decision && decision->margin < oracle::kLargestMargin;
}

double smallest_radius(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_atom(scene, [&](const Atom& atom) {
    if (atom.is_ball()) smallest = std::min(smallest, atom.radius);
  });
  return smallest;
}

// The sine of the angle between two vectors; NaN for a zero vector.
double sine_between(const Vec& a, const Vec& b) {
  return length(cross(a, b)) / length(a) / length(b);
}

// True if v is along a small vector of a lattice, or nearly.
bool is_near_rational(const Scene& scene, const Vec& v) {
  for (const Lattice& lattice : scene.lattices) {
    const int rank = lattice.rank(scene.dimension);
    std::array<int, 3> most{};
    std::fill_n(most.begin(), rank, kSmall);
    for (int i = -most[0]; i <= most[0]; ++i)
      for (int j = -most[1]; j <= most[1]; ++j)
        for (int k = -most[2]; k <= most[2]; ++k) {
          Vec sum{};
          const std::array<int, 3> n{i, j, k};
          for (int m = 0; m < rank; ++m) sum = plus(sum, n[m], lattice.vectors[m]);
          if (sine_between(sum, v) < kNear) return true;
        }
  }
  return false;
}

// The exponent of the largest component.
int exponent_of(const Vec& v) {
  double largest = 0;
  for (const double component : v) largest = std::max(largest, std::abs(component));
  return std::ilogb(largest);
}

// The distance to a hit along direction 2^exponent; the time may be out of range for binary64.
long double flown(const Answer& exact, const Vec& direction, int exponent) {
  if (exact.outcome != Outcome::hit) return 0;
  return std::scalbn(std::strtold(exact.time_decimal.c_str(), nullptr) * length(direction), exponent);
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& seen_tags() {
  static const std::vector<std::pair<std::string, std::string>> tags{
      {"grazing", "the line enters or misses an obstacle by less than 2^20 ulps of the inputs"},
      {"tie", "two obstacles are entered at times that 2^20 ulps of the inputs could swap"},
      {"boundary-start", "the start is within 2^20 ulps of an obstacle's surface"},
      {"near-rational", "the direction is within 2^-20 of a lattice vector with components up to 8"},
      {"zero-component", "a component of v is zero"},
      {"leaving", "`from` names an obstacle, which is ignored"},
      {"far", "the flight is longer than 10^6 times the shortest lattice vector"},
      {"tiny-radius", "a radius is below 10^-5 of the shortest lattice vector"},
      {"invalid", "no valid question: the answer is `error`"},
      {"plain", "none of the others"}};
  return tags;
}

std::vector<std::string> tags_seen(const Scene& scene, const Query& query, const Answer& exact,
                                   const std::optional<oracle::HardestDecision>& decision) {
  const auto is = [&](oracle::DecisionKind kind) { return is_hard(decision) && decision->kind == kind; };
  const double unit = shortest_vector(scene);
  const int exponent = exponent_of(query.v);
  Vec direction = query.v;  // scaled by a power of two: its largest component is from 1 to 2
  for (double& component : direction) component = std::scalbn(component, -exponent);
  const bool has_zero = std::any_of(query.v.begin(), query.v.begin() + scene.dimension,
                                    [](double component) { return component == 0; });
  const std::pair<const char*, bool> all[] = {
      {"grazing", is(oracle::DecisionKind::meeting)},
      {"tie", is(oracle::DecisionKind::order)},
      {"boundary-start", is(oracle::DecisionKind::containing)},
      {"near-rational", is_near_rational(scene, direction)},
      {"zero-component", has_zero},
      {"leaving", query.from.has_value()},
      {"far", flown(exact, direction, exponent) > kFar * unit},
      {"tiny-radius", std::isfinite(unit) && smallest_radius(scene) < kTiny * unit}};
  std::vector<std::string> tags;
  for (const auto& [tag, holds] : all)
    if (holds) tags.emplace_back(tag);
  if (tags.empty()) tags.emplace_back("plain");
  return tags;
}

std::string comment_on(const std::optional<oracle::HardestDecision>& decision, const Components& count) {
  if (!is_hard(decision)) return "";
  const ObstacleId& its = decision->obstacle;
  std::string cell;
  for (int i = 0; i < count.of_cells(its.lattice); ++i) cell += (i ? "," : "") + its.cell[i].decimal();
  const char* what = decision->kind == oracle::DecisionKind::containing
                         ? (decision->yes ? "x lies in" : "x lies outside of")
                     : decision->kind == oracle::DecisionKind::meeting
                         ? (decision->yes ? "the line meets" : "the line misses")
                         : "the line enters later";
  return fmt::format("{} lattice {}, atom {}, cell [{}], by {:.3g} ulps", what, its.lattice, its.atom, cell,
                     decision->margin);
}

}  // namespace lorentz::golden
