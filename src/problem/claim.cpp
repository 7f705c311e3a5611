#include <lorentz/claim.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lorentz {
namespace {

void round_each(Vec& vector, NumberFormat precision) {
  for (double& component : vector) component = rounded(component, precision);
}

}  // namespace

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
