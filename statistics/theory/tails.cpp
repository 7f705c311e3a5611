// Tails: how the probability of long free paths falls.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <lorentz/horizon.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/theory/incommensurate.hpp"
#include "statistics/theory/laws.hpp"
#include "statistics/theory/small_obstacles.hpp"

namespace lorentz::flights {
namespace {

constexpr double kPi = std::numbers::pi, kZeta3 = 1.2020569031595942854;

// The tail of an ensemble, given the tail C / t^power of uniform starts. Their density is the survival
// between collisions divided by the mean free path, so that the tail between collisions has one power more.
Tail tail_of(const char* when, int power, double uniform_constant, std::optional<double> mean,
             Ensemble ensemble, std::string remark) {
  Tail tail{when, power + 1.0, uniform_constant, std::move(remark)};
  if (ensemble == Ensemble::uniform) return tail;
  tail.exponent = power + 2.0;
  tail.constant = mean ? std::optional(*mean * power * uniform_constant) : std::nullopt;
  if (!mean) tail.remark += "; the mean free path is not known";
  return tail;
}

// The survival of each lattice's limit law falls like 2 / (pi^2 s).
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

// With xi = r^2 t / V, the density from a uniform start is pi / (48 zeta(3)) xi^-2, and the mean is 1 / pi.
std::optional<Tail> tail_3d_of_small(const Scene& scene, Ensemble ensemble) {
  const Atom* ball = only_ball(scene, 3);
  if (!ball) return std::nullopt;
  const double r = ball->radius, unit = cell_volume(scene.lattices[0], 3) / (r * r);
  return tail_of("r -> 0", 1, kPi / (48 * kZeta3) * unit, unit / kPi, ensemble,
                 "of the limit law; approached like (r^2 t / V)^(-2/3)");
}

constexpr const char* kLongPaths = "t -> infinity";

Tail tail_without(const char* remark) {
  Tail tail{kLongPaths, std::nullopt, std::nullopt, remark};
  tail.open = false;
  return tail;
}

// The tail of open corridors or planar channels. They determine the power, whatever the rest of the scene is.
Tail tail_of_channels(const Scene& scene, Ensemble ensemble, const std::optional<double>& constant,
                      std::string remark) {
  Tail tail = tail_of(kLongPaths, 1, constant.value_or(1), mean_free_path_of(scene).value, ensemble,
                      std::move(remark));
  if (!constant) tail.constant.reset();
  tail.open = true;
  return tail;
}

Tail not_known(std::string why) {
  return {kLongPaths, std::nullopt, std::nullopt, std::move(why)};
}

// The tail if no corridor, or no planar channel, is open.
Tail tail_of_shut(const Scene& scene) {
  if (const auto angle = nearly_common_way(scene)) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1g", *angle);
    return not_known(std::string("ways of the lattices are parallel to ") + text +
                     " radians, though not exactly: as good as open until t is about one over that");
  }
  if (scene.dimension == 2) return tail_without("none: every path ends");
  Tail tail = tail_without("no planar channel is open: the density falls faster than with one");
  tail.constant = 0;
  return tail;
}

// Whether a wide channel is open. For obstacles that are too small for a search of all directions.
bool has_wide_channel(const Scene& scene) {
  constexpr double kWide = 0.03;  // of the cell's size: about 10^4 to 10^5 directions, a second
  const double wide =
      kWide * std::pow(cell_volume(scene.lattices[0], scene.dimension), 1.0 / scene.dimension);
  try {
    return !oracle::horizon_of(scene, wide, false).channels.empty();
  } catch (const oracle::TooManyChannels&) {
    return false;
  }
}

Tail tail_of_horizon(const Scene& scene, Ensemble ensemble) {
  const bool flat = scene.dimension == 2;
  const std::string channel = flat ? "corridor" : "planar channel",
                    unknown = "it is not known whether a " + channel + " is open: ";
  const auto without_constant = [&](const std::string& why) {
    return tail_of_channels(scene, ensemble, std::nullopt,
                            "of the " + channel + "s; the constant is not known (" + why + ")");
  };
  try {
    const oracle::Horizon horizon = oracle::horizon_of(scene, 0, false);
    if (horizon.channels.empty())
      return horizon.undecided.empty()
                 ? tail_of_shut(scene)
                 : not_known(unknown + "three lattices or more with long common periods are undecided");
    if (!horizon.tail_constant) return without_constant(horizon.no_tail_constant);
    Tail tail = tail_of_channels(scene, ensemble, horizon.tail_constant,
                                 "of the " + channel + "s" + (flat ? "" : "; approached like t^(-2/3)"));
    if (!flat) tail.approach = 2.0 / 3;
    return tail;
  } catch (const oracle::TooManyChannels& error) {
    return has_wide_channel(scene) ? without_constant("there are too many")
                                   : not_known(unknown + error.what());
  }
}

// For one lattice of discs that are so small that some corridor is wide. The sum in binary64 cannot miss it
// and is immediate, where the exact search is slow or refuses.
std::optional<Tail> tail_of_small_discs(const Scene& scene, Ensemble ensemble) {
  constexpr double kSmall = 0.1;  // in units of the square root of the cell's area; the shortest vector is at
                                  // most 1.07, so that its corridor is at least 0.7 wide
  const Atom* disc = only_ball(scene, 2);
  if (!disc || disc->radius > kSmall * std::sqrt(cell_volume(scene.lattices[0], 2))) return std::nullopt;
  if (!mean_free_path_of(scene).value) return std::nullopt;  // the sum is for discs that don't overlap
  bool of_limit = false;
  const auto sum = corridor_tail_constant(scene.lattices[0], &of_limit);
  return tail_of_channels(scene, ensemble, sum,
                          !sum       ? "of the corridors; too many to be added up"
                          : of_limit ? "of the limit law: there are too many corridors to be added up"
                                     : "of the corridors");
}

}  // namespace

Tail tail_of_long_paths(const Scene& scene, Ensemble ensemble) {
  if (const auto tail = tail_of_small_discs(scene, ensemble)) return *tail;
  return tail_of_horizon(scene, ensemble);
}

std::vector<Tail> tails_of(const Scene& scene, Ensemble ensemble) {
  std::vector<Tail> tails;
  const auto small =
      scene.dimension == 2 ? tail_2d_of_small(scene, ensemble) : tail_3d_of_small(scene, ensemble);
  if (small) tails.push_back(*small);
  tails.push_back(tail_of_long_paths(scene, ensemble));
  return tails;
}

}  // namespace lorentz::flights
