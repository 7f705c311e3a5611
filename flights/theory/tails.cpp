// How the probability of long free paths falls.
#include <numbers>

#include <lorentz/horizon.hpp>
#include "flights/theory/corridor_sum.hpp"
#include "flights/theory/laws.hpp"
#include "flights/theory/small_obstacles.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::flights {
namespace {

constexpr double kPi = std::numbers::pi, kZeta3 = 1.2020569031595942854;

// From the tail C / t^power of uniform starts: the density of these is the survival from collisions over the
// mean free path, so collisions have one power more.
Tail tail_of(const char* when, int power, double uniform_constant, std::optional<double> mean,
             Ensemble ensemble, std::string remark) {
  Tail tail{when, power + 1.0, uniform_constant, std::move(remark)};
  if (ensemble == Ensemble::uniform) return tail;
  tail.exponent = power + 2.0;
  tail.constant.reset();
  if (mean) tail.constant = *mean * power * uniform_constant;
  if (uniform_constant == 0) tail.constant = 0;
  if (!tail.constant) tail.remark += "; the mean free path is not known";
  return tail;
}

// The limit law's survival falls like 2 / (pi^2 s), each lattice's.
std::optional<Tail> tail_2d_of_small(const Scene& scene, Ensemble ensemble) {
  std::string why_not;
  const auto small = small_obstacles_of(scene, why_not);
  if (!small) return std::nullopt;
  double sum = 0;
  for (const Rates& rates : small->directions) {
    double product = 1;
    for (const double rate : rates) product *= 2 / (kPi * kPi * rate);
    sum += product;
  }
  return tail_of("r -> 0", static_cast<int>(small->lattices()),
                 sum / static_cast<double>(small->directions.size()), 1 / small->mean_rate(), ensemble,
                 "of the limit law");
}

// xi = r^2 t / V: the density from a uniform start is pi / (48 zeta(3)) xi^-2, and 1 / pi is the mean.
std::optional<Tail> tail_3d_of_small(const Scene& scene, Ensemble ensemble) {
  const bool ball = scene.lattices.size() == 1 && scene.lattices[0].atoms.size() == 1 &&
                    scene.lattices[0].atoms[0].is_ball();
  if (!ball) return std::nullopt;
  const double r = scene.lattices[0].atoms[0].radius, unit = cell_volume(scene.lattices[0], 3) / (r * r);
  return tail_of("r -> 0", 1, kPi / (48 * kZeta3) * unit, unit / kPi, ensemble,
                 "of the limit law; approached like (r^2 t / V)^(-2/3)");
}

// From the channels, all of them.
Tail tail_of_horizon(const Scene& scene, Ensemble ensemble, const char* when) {
  try {
    const oracle::Horizon horizon = oracle::horizon_of(scene, 0, false);
    if (horizon.is_finite()) return {when, std::nullopt, std::nullopt, "none: every path ends"};
    if (!horizon.tail_constant) return {when, std::nullopt, std::nullopt, horizon.no_tail_constant};
    if (*horizon.tail_constant == 0)
      return {when, std::nullopt, 0, "no planar channel is open: it falls faster than with one"};
    const bool flat = scene.dimension == 2;
    Tail tail = tail_of(when, 1, *horizon.tail_constant, mean_free_path_of(scene).value, ensemble,
                        flat ? "of the corridors" : "of the planar channels; approached like t^(-2/3)");
    if (!flat) tail.approach = 2.0 / 3;
    return tail;
  } catch (const oracle::TooManyChannels& error) {
    return {when, std::nullopt, std::nullopt, error.what()};
  }
}

Tail tail_of_long_paths(const Scene& scene, Ensemble ensemble) {
  constexpr const char* kWhen = "t -> infinity";
  std::string why_not;
  const auto small = small_obstacles_of(scene, why_not);
  if (small && small->lattices() > 1)
    return {kWhen, std::nullopt, std::nullopt,
            "not that of the limit: incommensurate lattices shut each other's corridors"};
  if (!small || !small->discs) return tail_of_horizon(scene, ensemble, kWhen);
  const MeanFreePath mean = mean_free_path_of(scene);
  if (!mean.value) return {kWhen, std::nullopt, std::nullopt, mean.how};
  const auto sum = corridor_tail_constant(scene.lattices[0]);
  if (!sum) return {kWhen, std::nullopt, std::nullopt, "too many corridors to be added up"};
  if (sum->value == 0) return {kWhen, std::nullopt, std::nullopt, "none: every path ends"};
  return tail_of(
      kWhen, 1, sum->value, mean.value, ensemble,
      sum->of_limit ? "of the limit law: there are too many corridors to be added up" : "of the corridors");
}

}  // namespace

std::vector<Tail> tails_of(const Scene& scene, Ensemble ensemble) {
  std::vector<Tail> tails;
  const auto small =
      scene.dimension == 2 ? tail_2d_of_small(scene, ensemble) : tail_3d_of_small(scene, ensemble);
  if (small) tails.push_back(*small);
  tails.push_back(tail_of_long_paths(scene, ensemble));
  return tails;
}

}  // namespace lorentz::flights
