#include <lorentz/claim.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace lorentz {
namespace {

// Calls visit(number) for each number of a query or a scene, constant or not.
template <class Q, class Visit>
requires std::same_as<std::remove_const_t<Q>, Query>
void for_each_number(Q& query, const Visit& visit) {
  for (auto& component : query.x) visit(component);
  for (auto& component : query.v) visit(component);
}

template <class S, class Visit>
requires std::same_as<std::remove_const_t<S>, Scene>
void for_each_number(S& scene, const Visit& visit) {
  const auto visit_all = [&](auto& vectors) {
    for (auto& vector : vectors)
      for (auto& component : vector) visit(component);
  };
  for (auto& lattice : scene.lattices) visit_all(lattice.vectors);
  for_each_atom(scene, [&](auto& atom) {
    for (auto& component : atom.position) visit(component);
    visit(atom.radius);
    visit_all(atom.semiaxes);
  });
}

template <class T>
T all_rounded(T of, NumberFormat precision) {
  for_each_number(of, [&](double& number) { number = rounded(number, precision); });
  return of;
}

template <class T>
bool all_consist_of(const T& of, NumberFormat precision) {
  bool yes = true;
  for_each_number(of, [&](double number) { yes &= rounded(number, precision) == number; });
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
