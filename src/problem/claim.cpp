#include <lorentz/claim.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <lorentz/geometry.hpp>

namespace lorentz {
namespace {

// In the order of StartInside.
constexpr std::array<std::string_view, 5> kRules{"inside", "miss", "zero", "exit", "unsupported"};

void round_each(Vec& vector, NumberFormat precision) {
  for (double& component : vector) component = rounded(component, precision);
}

}  // namespace

bool Domain::has(const Scene& scene) const {
  if (!(scene.dimension == 2 ? dimension_2 : dimension_3)) return false;
  bool all = true;
  for_each_atom(scene, [&](const Atom& atom) {
    all &= coordinates.contains(largest_component(atom.position)) && (atom.is_ball() ? balls : ellipsoids);
    if (atom.is_ball()) all &= radius.contains(atom.radius);
    for (const Vec& axis : atom.semiaxes) all &= radius.contains(length_of_any(axis));
  });
  return all;
}

bool Domain::has(const Query& query) const {
  return speed.contains(length_of_any(query.v)) && coordinates.contains(largest_component(query.x));
}

bool Domain::has(const Query& query, const Answer& exact) const {
  if (exact.outcome != Outcome::hit || !exact.time) return true;
  return flight.contains(*exact.time == 0 ? 0 : length_of_any(query.v) * *exact.time);  // |v| may be infinite
}

std::optional<Query> Domain::bring_inside(const Query& query) const {
  if (has(query)) return query;
  const double length = length_of_any(query.v);
  // The end of the interval on the other side of which it is.
  const double end = length < speed.low ? speed.low : speed.high;
  const auto is_size = [](double number) { return number > 0 && std::isfinite(number); };
  if (!coordinates.contains(largest_component(query.x)) || !is_size(length) || !is_size(end))
    return std::nullopt;
  for (int exponent = std::ilogb(end) - std::ilogb(length) - 1, last = exponent + 2; exponent <= last;
       ++exponent) {
    const Query scaled{query.x, times_power_of_two(query.v, exponent), query.from};
    const bool is_exact = times_power_of_two(scaled.v, -exponent) == query.v;
    if (is_exact && speed.contains(length_of_any(scaled.v))) return scaled;
  }
  return std::nullopt;
}

std::string_view name_of(StartInside rule) {
  return kRules[static_cast<std::size_t>(rule)];
}

std::optional<StartInside> start_inside_named(std::string_view name) {
  const auto found = std::find(kRules.begin(), kRules.end(), name);
  if (found == kRules.end()) return std::nullopt;
  return static_cast<StartInside>(found - kRules.begin());
}

double rounded(double value, NumberFormat precision) {
  return precision == NumberFormat::binary64 ? value : static_cast<double>(static_cast<float>(value));
}

double ulp(double value, NumberFormat precision) {
  const bool wide = precision == NumberFormat::binary64;
  const double largest = wide ? std::numeric_limits<double>::max() : std::numeric_limits<float>::max(),
               smallest = wide ? std::numeric_limits<double>::min() : std::numeric_limits<float>::min();
  const double size = std::clamp(std::fabs(value), smallest, largest);
  return std::ldexp(1.0, std::ilogb(size) + 1 - bits_of(precision));
}

Scene rounded(Scene scene, NumberFormat precision) {
  for (Lattice& lattice : scene.lattices)
    for (Vec& vector : lattice.vectors) round_each(vector, precision);
  for_each_atom(scene, [&](Atom& atom) {
    round_each(atom.position, precision);
    atom.radius = rounded(atom.radius, precision);
    for (Vec& axis : atom.semiaxes) round_each(axis, precision);
  });
  return scene;
}

Query rounded(Query query, NumberFormat precision) {
  round_each(query.x, precision), round_each(query.v, precision);
  return query;
}

bool consists_of(const Scene& scene, NumberFormat precision) {
  return precision == NumberFormat::binary64 || rounded(scene, precision) == scene;
}

bool consists_of(const Query& query, NumberFormat precision) {
  if (precision == NumberFormat::binary64) return true;
  const Query nearest = rounded(query, precision);
  return nearest.x == query.x && nearest.v == query.v;
}

}  // namespace lorentz
