#include "statistics/theory/laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <lorentz/geometry.hpp>
#include <lorentz/scene_check.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/theory/incommensurate.hpp"
#include "statistics/theory/small_obstacles.hpp"

namespace lorentz::flights {
namespace {

constexpr double kPi2 = std::numbers::pi * std::numbers::pi, kLn2 = std::numbers::ln2;

// From here on the series in 1/s is used. It converges like (2/s)^n, and the closed forms lose digits because
// their terms cancel.
constexpr double kFar = 2.5;

// x ln |x|
double x_log_x(double x) {
  return x == 0 ? 0 : x * std::log(std::fabs(x));
}

// Li2(x), 0 <= x <= 1
double dilogarithm(double x) {
  if (x == 1) return kPi2 / 6;
  if (x > 0.5) return kPi2 / 6 - std::log(x) * std::log1p(-x) - dilogarithm(1 - x);
  double sum = 0, power = x;
  for (int n = 1; power > 1e-18 * n * n * sum; ++n, power *= x) sum += power / (static_cast<double>(n) * n);
  return sum;
}

// L(u) = Re Li2(1/u), an antiderivative of ln|1 - 1/u| / u; u > 0
double log_integral(double u) {
  if (u >= 1) return dilogarithm(1 / u);
  const double log = std::log(u);
  return kPi2 / 3 - log * log / 2 - dilogarithm(u);
}

double log_difference(double u) {
  return x_log_x(u - 1) - x_log_x(u);
}

// First and second antiderivatives of k(u) = (1 - 1/u)^2 ln|1 - 1/u|; g(s) = 1/s + 2 k(s) - k(s/2) / 2.
double kernel_integral(double u) {
  return log_difference(u) - 2 * log_integral(u) + x_log_x(1 - 1 / u) + 1 / u;
}
double kernel_integral_2(double u) {
  return ((u - 1) * x_log_x(u - 1) - u * x_log_x(u)) / 2 + (2 * u - 1) / 4 - (2 * u + 1) * log_integral(u) +
         3 * log_difference(u) + std::log(u);
}

// For s > 2: g(s) = sum over n >= 3 of (2^n - 4) / (n (n-1) (n-2)) s^-n, integrated once or twice from s to
// infinity, which gives each term the factors s / (n-1) and s / (n-2). Written as 8 s^-3 times a series in
// 2/s, because s may be huge.
double far(double s, int integrals) {
  double sum = 0, power = 1, four = 0.5;  // (2/s)^(n-3), 4 / 2^n
  for (int n = 3; power > 1e-17; ++n, power *= 2 / s, four /= 2) {
    const double term = power * (1 - four) / (static_cast<double>(n) * (n - 1) * (n - 1) * (n - 2));
    sum += integrals > 1 ? term / (n - 2) : term;
  }
  for (int factors = 3; factors > integrals; --factors) sum /= s;
  return 8 * sum;
}

}  // namespace

double limit_survival_from_surface(double s) {
  if (s <= 0) return 1;
  if (s <= 1) return 1 - 6 / kPi2 * s;
  if (s > kFar) return 6 / kPi2 * far(s, 1);
  return -6 / kPi2 * (1 + kLn2 + std::log(s) + 2 * kernel_integral(s) - kernel_integral(s / 2));
}

double limit_survival_from_uniform(double s) {
  if (s <= 0) return 1;
  if (s <= 1) return 1 - s + 3 / kPi2 * s * s;
  if (s > kFar) return 6 / kPi2 * far(s, 2);
  return 6 / kPi2 * (kLn2 * (s + 3) + x_log_x(s) + 2 * (kernel_integral_2(s) - kernel_integral_2(s / 2)));
}

// ---- The laws of scenes

namespace {

// For one direction. A uniform start is uniform in every lattice.
double longer_from_uniform(const Rates& rates, double t) {
  double product = 1;
  for (const double rate : rates) product *= limit_survival_from_uniform(rate * t);
  return product;
}

// For one direction: the rate of collisions after which all lattices are free for t. A particle that leaves
// an obstacle of one lattice has a uniform position in the others.
double rate_of_longer(const Rates& rates, double t) {
  double sum = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    double product = rates[i] * limit_survival_from_surface(rates[i] * t);
    for (std::size_t k = 0; k < rates.size(); ++k)
      if (k != i) product *= limit_survival_from_uniform(rates[k] * t);
    sum += product;
  }
  return sum;
}

double survival_among_small(const SmallObstacles& small, Ensemble ensemble, double t) {
  double sum = 0;
  for (const Rates& rates : small.directions)
    sum += ensemble == Ensemble::uniform ? longer_from_uniform(rates, t) : rate_of_longer(rates, t);
  sum /= static_cast<double>(small.directions.size());
  return ensemble == Ensemble::uniform ? sum : sum / small.mean_rate();
}

std::string law_name(const SmallObstacles& small) {
  std::string name = "Boca-Zaharescu";
  if (small.lattices() > 1) name += " (" + std::to_string(small.lattices()) + " incommensurate lattices)";
  if (!small.discs) name += " (over directions)";
  return name;
}

// Seen from the obstacle that a particle leaves, the other obstacles stand at the distances of the lattice,
// and the first few shells are visible in the statistics. The shells up to t have about t^2 obstacles, with a
// relative unevenness of t^-3/2. From kSpacings on, this is below the statistical error of 10^8 flights at
// r = 1e-4. A uniform start sees no shells.
double smooth_from(const Scene& scene, Ensemble ensemble) {
  constexpr double kSpacings = 64;
  if (ensemble == Ensemble::uniform) return 0;
  double largest = 0;
  for (const Lattice& lattice : scene.lattices)
    largest = std::max(largest, length(with_short_vectors(lattice, 2).vectors[1]));
  return kSpacings * largest;
}

}  // namespace

std::optional<Law> law_of(const Scene& scene, Ensemble ensemble, std::string* why_not) {
  std::string why = "for crystals only";
  const auto small = is_crystal(scene) ? small_obstacles_of(scene, why) : std::nullopt;
  if (!small && why_not) *why_not = why;
  if (!small) return std::nullopt;
  return Law{law_name(*small), small->discs ? "r -> 0" : "small obstacles",
             [small = *small, ensemble](double t) { return survival_among_small(small, ensemble, t); },
             1 / small->mean_rate(), smooth_from(scene, ensemble)};
}

// ---- The mean free path between collisions, by Santalo's formula: free volume over surface

namespace {

constexpr const char* kBeyond = "not given: beyond the range of binary64";

// Why overlaps cannot be excluded; empty if they can.
std::string overlap_in(const Scene& scene, oracle::Pairs pairs) {
  const oracle::Contacts contacts = oracle::contacts_in(scene, 1000, pairs);
  for (const oracle::Contact& contact : contacts.found)
    if (contact.overlap) return "not given: " + oracle::description_of(contact);
  return contacts.end == oracle::SearchEnd::complete
             ? ""
             : "not given: obstacles may overlap, not every pair was looked at";
}

MeanFreePath without_overlaps(const Scene& scene) {
  const std::optional<Filling> filling = filling_of(scene);
  if (!filling) return {std::nullopt, kBeyond};
  return {filling->mean_free_path, "exact: free volume over surface"};
}

// Each lattice covers its share of the space and of the surface that the others leave free.
MeanFreePath of_independent(const Scene& scene) {
  double free = 1, surface = 0;
  for (const Lattice& lattice : scene.lattices) {
    const std::optional<Filling> filling = filling_of({scene.dimension, {lattice}});
    if (!filling) return {std::nullopt, kBeyond};
    surface = surface * (1 - filling->fraction) + filling->surface * free;
    free *= 1 - filling->fraction;
  }
  const double mean = (scene.dimension == 2 ? std::numbers::pi : 4) * free / surface;
  if (!std::isfinite(mean)) return {std::nullopt, kBeyond};
  return {mean, "exact for independent lattices: free volume over surface, with overlaps"};
}

}  // namespace

MeanFreePath mean_free_path_of(const Scene& scene) {
  if (!is_crystal(scene))
    return {std::nullopt, "not given: most flights never end, because the scene is not a crystal"};
  if (std::string why = overlap_in(scene, oracle::Pairs::within_lattices); !why.empty())
    return {std::nullopt, why};
  if (scene.lattices.size() == 1) return without_overlaps(scene);
  const bool are_few = scene.lattices.size() <= kMostLattices;
  if (are_few && independent(scene)) return of_independent(scene);
  if (const std::string why = overlap_in(scene, oracle::Pairs::all); !why.empty())
    return {std::nullopt, are_few ? why : "not given: more than 24 lattices are not compared"};
  return without_overlaps(scene);
}

}  // namespace lorentz::flights
