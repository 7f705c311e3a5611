#include "judge/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <lorentz/geometry.hpp>
#include "src/exchange/exchange_number.hpp"
#include "src/problem/same_answer.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::judge {

using question::smallest_semiaxis;

namespace {

double smallest_radius(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_atom(scene, [&](const Atom& atom) {
    smallest = std::min(smallest, smallest_semiaxis(atom, scene.dimension));
  });
  return smallest;
}

// The nearest binary64 number; an infinity beyond its range.
double as_double(const Integer& number) {
  return *nearest_decimal(number.decimal());
}

// The largest number in the cells that a question is about; kNone if it is about no cell, as for `never`.
double largest_number(const Question& question) {
  double largest = Features::kNone;
  const auto see = [&](const ObstacleId& obstacle) {
    for (const Integer& number : obstacle.cell) largest = std::fmax(largest, std::fabs(as_double(number)));
  };
  if (names_obstacle(question.exact)) see(question.exact.obstacle);
  if (question.query.from) see(*question.query.from);
  return largest;
}

// Sets what is about the obstacle in question. Its radius, for an ellipsoid, is the smallest semiaxis.
void measure_from(const Question& question, const ObstacleId& obstacle, Features& its) {
  const Scene& scene = question.place->scene();
  const Lattice& lattice = scene.lattices[static_cast<std::size_t>(obstacle.lattice)];
  const Atom& atom = lattice.atoms[static_cast<std::size_t>(obstacle.atom)];
  Vec centre = atom.position;
  for (int i = 0; i < lattice.rank_in(scene.dimension); ++i)
    centre = plus(centre, as_double(obstacle.cell[i]), lattice.vectors[i]);
  const Vec away = plus(centre, -1, question.query.x);
  its.distance = std::hypot(away[0], away[1], away[2]) / smallest_semiaxis(atom, scene.dimension);
  its.centre = std::hypot(centre[0], centre[1], centre[2]);
  const oracle::Approach approach = question.place->margins().approach(question.query, obstacle);
  its.start_gap = std::fabs(approach.start_gap);
  if (question.exact.outcome == Outcome::hit && question.exact.obstacle == obstacle)
    its.depth = -approach.gap;
}

// Sets where x lies among the cells of the first lattice that repeats; among single obstacles only the signs.
void measure_cell(const Question& question, Features& its) {
  const Scene& scene = question.place->scene();
  const Vec& x = question.query.x;
  for (int i = 0; i < scene.dimension; ++i) its.negative_start |= x[i] < 0;
  const auto repeating = std::ranges::find_if(scene.lattices, [&](const Lattice& lattice) {
    return lattice.rank_in(scene.dimension) == scene.dimension;
  });
  if (repeating == scene.lattices.end()) return;
  its.negative_start = false;
  const Vec cell = coordinates(dual_of(repeating->vectors, scene.dimension), x);
  for (int i = 0; i < scene.dimension; ++i) {
    its.negative_start |= cell[i] < 0;
    its.outside_first_cell |= cell[i] < 0 || cell[i] >= 1;
  }
}

void measure_velocity(const Query& query, int dimension, Features& its) {
  constexpr double kUnit = 1e-9;
  for (int i = 0; i < dimension; ++i) {
    its.zero_component |= query.v[i] == 0;
    its.negative[static_cast<std::size_t>(i)] = query.v[i] < 0;
  }
  its.speed = std::hypot(query.v[0], query.v[1], query.v[2]);
  its.is_unit_speed = std::fabs(its.speed - 1) <= kUnit;
}

double largest_coordinate(const Scene& scene, const Query& query) {
  double largest = largest_component(query.x);
  for_each_atom(scene, [&](const Atom& a) { largest = std::max(largest, largest_component(a.position)); });
  return largest;
}

}  // namespace

Features features_of(const Question& question, const std::optional<ObstacleId>& in_question) {
  const Scene& scene = question.place->scene();
  const Query& query = question.query;
  const bool repeats = std::ranges::any_of(
      scene.lattices, [&](const Lattice& lattice) { return lattice.rank_in(scene.dimension) > 0; });
  const double unit = repeats ? shortest_vector(scene) : Features::kNone;
  Features its;
  its.in_space = scene.dimension == 3;
  measure_velocity(query, scene.dimension, its);
  measure_cell(question, its);
  its.coordinates = largest_coordinate(scene, query);
  its.leaving = query.from.has_value();
  its.several_lattices = scene.lattices.size() > 1;
  for (const Lattice& lattice : scene.lattices) its.several_atoms |= lattice.atoms.size() > 1;
  for_each_atom(scene, [&](const Atom& atom) { its.ellipsoids |= !atom.is_ball(); });
  its.other_cell = !is_unit_scene(scene);
  its.outcome = question.exact.outcome;
  its.radius = smallest_radius(scene) / unit;
  its.start = length_of_any(query.x) / unit;
  its.cell = largest_number(question);
  if (in_question || is_one_obstacle(scene)) measure_from(question, in_question.value_or(ObstacleId{}), its);
  if (question.exact.outcome != Outcome::hit) return its;
  its.time = question.exact.time.value_or(Features::kNone);
  const double flown = its.time * its.speed;
  its.flight = flown / unit;
  const ObstacleId& hit = question.exact.obstacle;
  const Atom& atom =
      scene.lattices[static_cast<std::size_t>(hit.lattice)].atoms[static_cast<std::size_t>(hit.atom)];
  its.flight_in_radii = flown / smallest_semiaxis(atom, scene.dimension);
  if (std::isnan(its.depth))
    its.depth = -question.place->margins().approach(query, question.exact.obstacle).gap;
  its.chord = 2 * smallest_semiaxis(atom, scene.dimension) * std::sqrt(its.depth * (2 - its.depth));
  return its;
}

namespace {

// About 50 circumstances are tried: together they hold by chance in 1 of 1000 cases.
constexpr double kCommon = 0.5, kByChance = 1e-3 / 50;
// If some failing questions lack it, it must be rare among right answers, and failures without it must be
// rarer by a factor. A power of ten takes in right questions on the near side of the true limit.
constexpr double kRare = 0.1, kRareLimit = 0.35, kLessOften = 5;
// What sets only a part of them apart must be rarer among right answers by this factor.
constexpr double kRarer = 10;
// By this factor a property must outweigh those before it in the tables.
constexpr double kBetter = 1.1, kBetterOfScene = 2;
constexpr std::size_t kFewestRight = 20;

// Properties without a limit, with what a question needs to have them.
const std::vector<Circumstance> kProperties{
    {"on-surface", "where x lies on the surface of the obstacle in question",
     [](const Features& f) { return f.start_gap == 0; }, &Features::start_gap},
    {"at-once", "where the exact time is 0", [](const Features& f) { return f.time == 0; }, &Features::time},
    {"extreme-speed", "where v.v leaves the range of binary64",
     [](const Features& f) { return f.speed < 1e-154 || f.speed > 1e154; }},
    {"speed-not-1", "where |v| is not 1", [](const Features& f) { return !f.is_unit_speed; }},
    {"centre", "where the obstacle's centre is not at 0", [](const Features& f) { return f.centre > 0; },
     &Features::centre},
    {"x-negative", "where a coordinate of x is negative", [](const Features& f) { return f.negative_start; }},
    {"x-outside", "where x lies outside of the first cell",
     [](const Features& f) { return f.outside_first_cell; }},
    {"from", "of particles that leave an obstacle (from)", [](const Features& f) { return f.leaving; }},
    {"v-zero", "where a component of v is zero", [](const Features& f) { return f.zero_component; }},
    {"v-negative", "where v[0] is negative", [](const Features& f) { return f.negative[0]; }},
    {"v-negative", "where v[1] is negative", [](const Features& f) { return f.negative[1]; }},
    {"v-negative", "where v[2] is negative", [](const Features& f) { return f.negative[2]; }},
    {"v-negative", "where a component of v is negative",
     [](const Features& f) { return f.negative[0] || f.negative[1] || f.negative[2]; }},
    {"never", "where nothing is ever hit", [](const Features& f) { return f.outcome == Outcome::never; }}};

// Properties of scenes, which questions of one row often share by accident.
const std::vector<Circumstance> kSceneProperties{
    {"several-lattices", "in scenes of several lattices",
     [](const Features& f) { return f.several_lattices; }},
    {"several-atoms", "in scenes of several atoms a cell", [](const Features& f) { return f.several_atoms; }},
    {"ellipsoids", "among ellipses or ellipsoids", [](const Features& f) { return f.ellipsoids; }},
    {"other-cell", "in cells other than the unit square or cube",
     [](const Features& f) { return f.other_cell; }},
    {"in-3d", "in 3D", [](const Features& f) { return f.in_space; }},
    {"in-2d", "in 2D", [](const Features& f) { return !f.in_space; }}};

// A limit on a quantity: a power of ten above the failing questions, one that they reach, or a power of two
// that they reach, for lengths in radii, if it is far, because nothing cancels nearby.
enum class LimitSide { below, from, from_afar };
struct Limit {
  const char* name;
  double Features::*quantity;
  LimitSide bound;
  double telling;    // the largest, or the smallest, limit that says something; of radii the exponent
  const char* text;  // with the limit, or with the exponent of two; and the plural's s
};
constexpr Limit kLimits[] = {
    {"depth", &Features::depth, LimitSide::below, 0.1,
     "where the line enters the obstacle that is hit by less than {:g} of its radii"},
    {"short-chord", &Features::chord, LimitSide::below, 1,
     "where the chord in the obstacle is shorter than {:g}"},
    {"near-surface", &Features::start_gap, LimitSide::below, 0.01,
     "where x lies within {:g} radii of the surface of the obstacle in question"},
    {"short-time", &Features::time, LimitSide::below, 0.1, "where the exact time is below {:g}"},
    {"small-radius", &Features::radius, LimitSide::below, 0.1, "at radii below {:g} lattice vector{}"},
    {"long-flight", &Features::flight, LimitSide::from, 1, "after flights of {:g} lattice vector{} or more"},
    {"short-flight", &Features::flight, LimitSide::below, 10,
     "on flights shorter than {:g} lattice vector{}"},
    {"far-start", &Features::start, LimitSide::from, 10,
     "from starts {:g} lattice vector{} or more from the origin"},
    {"far-cell", &Features::cell, LimitSide::from, 100, "in far cells, with numbers of {:g} or more"},
    {"far-obstacle", &Features::distance, LimitSide::from_afar, 10,
     "from starts 2^{:g} radii or more from the obstacle in question"},
    {"long-flight-in-radii", &Features::flight_in_radii, LimitSide::from_afar, 10,
     "after flights of 2^{:g} radii or more"},
    {"low-speed", &Features::speed, LimitSide::below, 0.1, "at velocities shorter than {:g}"},
    {"high-speed", &Features::speed, LimitSide::from, 10, "at velocities of length {:g} or more"}};

// The exponent of the limit that just takes in this value.
double exponent_of(LimitSide bound, double value) {
  if (bound == LimitSide::from_afar) return std::ilogb(value);
  return std::floor(std::log10(value)) + (bound == LimitSide::below ? 1 : 0);
}

// Nothing if the limit says nothing.
std::optional<Circumstance> circumstance_with(const Limit& its, double exponent) {
  const auto quantity = its.quantity;
  const bool is_below = its.bound == LimitSide::below, is_far = its.bound == LimitSide::from_afar;
  const double limit = std::pow(is_far ? 2 : 10, exponent), said = is_far ? exponent : limit;
  if (is_below ? said > its.telling * (1 + 1e-9) : said < its.telling * (1 - 1e-9)) return std::nullopt;
  return Circumstance{.name = its.name,
                      .text = fmt::format(fmt::runtime(its.text), said, said == 1 ? "" : "s"),
                      .holds = [=](const Features& f) { return (f.*quantity < limit) == is_below; },
                      .quantity = quantity,
                      .is_limit = true};
}

// Limits at quantiles of the failing questions: that of all, and those that leave a part of them out.
void add_limits(const Limit& its, const std::vector<Features>& failing, std::vector<Circumstance>& all) {
  constexpr double kParts[] = {1, 0.97, kNearlyAll, 0.75, 0.5, 0.25, kClearPart};
  std::vector<double> values;
  for (const Features& f : failing)
    if (f.*its.quantity >= 0) values.push_back(f.*its.quantity);
  if (its.bound == LimitSide::below)
    std::ranges::sort(values);
  else
    std::ranges::sort(values, std::greater());
  std::set<double> exponents;
  for (const double part : kParts) {
    const auto number = static_cast<std::size_t>(std::ceil(part * static_cast<double>(failing.size())));
    if (number == 0 || number > values.size()) continue;
    const double value = values[number - 1];
    if (!(value > 0) || !std::isfinite(value)) continue;
    const double exponent = exponent_of(its.bound, value);
    if (!exponents.insert(exponent).second) continue;
    if (auto one = circumstance_with(its, exponent)) all.push_back(std::move(*one));
  }
}

std::vector<Circumstance> circumstances_for(const std::vector<Features>& failing) {
  std::vector<Circumstance> all = kProperties;
  for (const Limit& limit : kLimits) add_limits(limit, failing, all);
  for (const Circumstance& its : kSceneProperties) all.emplace_back(its).is_of_scene = true;
  return all;
}

// D(q || p), the exponent of Chernoff's bound; below 0 if q is no larger than p.
double divergence(double q, double p) {
  if (q <= p) return -1;
  return q * std::log(q / p) + (q < 1 ? (1 - q) * std::log((1 - q) / (1 - p)) : 0);
}

// The right answers to compare with: those with what a cause implies, the exact outcome and that an obstacle
// is grazed, if nearly all failing questions have it. (Few right answers may graze; then all are compared.)
std::vector<Features> comparable(const std::vector<Features>& failing, std::vector<Features> right) {
  const auto nearly_all = [&](const auto& has) {
    return static_cast<double>(std::ranges::count_if(failing, has)) >=
           kNearlyAll * static_cast<double>(failing.size());
  };
  for (const Outcome outcome : {Outcome::hit, Outcome::never, Outcome::inside}) {
    const auto has = [=](const Features& f) { return f.outcome == outcome; };
    if (nearly_all(has)) std::erase_if(right, std::not_fn(has));
  }
  const auto grazes = [](const Features& f) { return f.depth < kGrazing; };
  if (nearly_all(grazes) && std::ranges::count_if(right, grazes) >= static_cast<std::ptrdiff_t>(kFewestRight))
    std::erase_if(right, std::not_fn(grazes));
  return right;
}

// The share of failing questions, within a circumstance or without.
double rate(double failing, double right) {
  return failing == 0 ? 0 : failing / (failing + right);
}

// Counts the questions that have it, and weighs them. False if it says too little.
bool weigh(Circumstance& one, const std::vector<Features>& failing, const std::vector<Features>& right) {
  const auto has = [&](const Features& f) { return one.can_hold(f) && one.holds(f); };
  const auto all_right = std::ranges::count_if(right, [&](const Features& f) { return one.can_hold(f); });
  if (all_right < static_cast<std::ptrdiff_t>(kFewestRight)) return false;
  const auto all = static_cast<double>(all_right),
             those = static_cast<double>(std::ranges::count_if(right, has));
  one.number = static_cast<std::size_t>(std::ranges::count_if(failing, has));
  one.of = failing.size();
  one.share = those / all;
  // With this number of right answers, a share that was not seen may still be this large.
  const double exponent = divergence(one.part(), std::max(one.share, 3 / all));
  one.weight = one.part() * exponent;
  if (one.share > kCommon || exponent * static_cast<double>(one.of) < -std::log(kByChance)) return false;
  if (one.part() == 1) return true;
  if (one.part() < kNearlyAll && kRarer * one.share > one.part()) return false;
  const auto within = static_cast<double>(one.number), without = static_cast<double>(one.of - one.number);
  return one.share <= (one.is_limit ? kRareLimit : kRare) &&
         kLessOften * rate(without, all - those) <= rate(within, those);
}

}  // namespace

std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right, double least, double below) {
  if (failing.empty()) return std::nullopt;
  const std::vector<Features> compared = comparable(failing, right);
  std::optional<Circumstance> heaviest;
  for (Circumstance& one : circumstances_for(failing))
    if (weigh(one, failing, compared) && one.part() >= least && one.part() < below &&
        (!heaviest || one.weight > (one.is_of_scene ? kBetterOfScene : kBetter) * heaviest->weight))
      heaviest = std::move(one);
  return heaviest;
}

}  // namespace lorentz::judge
