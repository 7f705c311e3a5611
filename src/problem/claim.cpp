#include <lorentz/claim.hpp>

#include <algorithm>

namespace lorentz {
namespace {

template <class Visit>
void for_each_number(Vec& a, const Visit& visit) {
  for (double& component : a) visit(component);
}

template <class Visit>
void for_each_number(Scene& scene, const Visit& visit) {
  for (Lattice& lattice : scene.lattices)
    for (Vec& u : lattice.vectors) for_each_number(u, visit);
  for_each_atom(scene, [&](Atom& atom) {
    for_each_number(atom.position, visit);
    visit(atom.radius);
    for (Vec& axis : atom.semiaxes) for_each_number(axis, visit);
  });
}

template <class Visit>
void for_each_number(Query& query, const Visit& visit) {
  for_each_number(query.x, visit);
  for_each_number(query.v, visit);
}

template <class T>
T all_rounded(T of, NumberFormat precision) {
  for_each_number(of, [&](double& number) { number = rounded(number, precision); });
  return of;
}

template <class T>
bool all_consist_of(T of, NumberFormat precision) {
  bool yes = true;
  for_each_number(of, [&](double& number) { yes &= rounded(number, precision) == number; });
  return yes;
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

bool consists_of(const Scene& scene, NumberFormat precision) {
  return precision == NumberFormat::binary64 || all_consist_of(scene, precision);
}
bool consists_of(const Query& query, NumberFormat precision) {
  return precision == NumberFormat::binary64 || all_consist_of(query, precision);
}

Scene rounded(Scene scene, NumberFormat precision) {
  return all_rounded(std::move(scene), precision);
}
Query rounded(Query query, NumberFormat precision) {
  return all_rounded(std::move(query), precision);
}

}  // namespace lorentz
