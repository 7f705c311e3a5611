#include "judge/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "question/radii.hpp"
#include "src/exchange/exchange_number.hpp"
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

// The only obstacle of a scene; nothing if there are several.
std::optional<ObstacleId> lone_obstacle(const Scene& scene) {
  const Lattice& first = scene.lattices[0];
  const bool is_lone =
      scene.lattices.size() == 1 && first.atoms.size() == 1 && first.rank(scene.dimension) == 0;
  return is_lone ? std::optional(ObstacleId{}) : std::nullopt;
}

// Sets the distance from x to the obstacle's centre, in its radii (for an ellipsoid, the smallest semiaxis).
void measure_from(const Question& question, const ObstacleId& obstacle, Features& its) {
  const Scene& scene = question.place->scene();
  const Lattice& lattice = scene.lattices[static_cast<std::size_t>(obstacle.lattice)];
  const Atom& atom = lattice.atoms[static_cast<std::size_t>(obstacle.atom)];
  Vec centre = atom.position;
  for (int i = 0; i < lattice.rank(scene.dimension); ++i)
    centre = plus(centre, as_double(obstacle.cell[i]), lattice.vectors[i]);
  const Vec away = plus(centre, -1, question.query.x);
  its.distance = std::hypot(away[0], away[1], away[2]) / smallest_semiaxis(atom, scene.dimension);
}

}  // namespace

Features features_of(const Question& question, const std::optional<ObstacleId>& in_question) {
  const Scene& scene = question.place->scene();
  const Query& query = question.query;
  const bool repeats = std::ranges::any_of(
      scene.lattices, [&](const Lattice& lattice) { return lattice.rank(scene.dimension) > 0; });
  const double unit = repeats ? shortest_vector(scene) : Features::kNone;
  Features its;
  its.in_space = scene.dimension == 3;
  for (int i = 0; i < scene.dimension; ++i) its.zero_component |= query.v[i] == 0;
  its.leaving = query.from.has_value();
  its.several_lattices = scene.lattices.size() > 1;
  for (const Lattice& lattice : scene.lattices) its.several_atoms |= lattice.atoms.size() > 1;
  for_each_atom(scene, [&](const Atom& atom) { its.ellipsoids |= !atom.is_ball(); });
  its.other_cell = !is_unit_scene(scene);
  its.never = question.exact.outcome == Outcome::never;
  its.radius = smallest_radius(scene) / unit;
  its.start = length(query.x) / unit;
  its.cell = largest_number(question);
  its.speed = length(query.v);
  if (const auto obstacle = in_question ? in_question : lone_obstacle(scene))
    measure_from(question, *obstacle, its);
  if (question.exact.outcome != Outcome::hit) return its;
  const double flown = question.exact.time.value_or(Features::kNone) * its.speed;
  its.flight = flown / unit;
  const ObstacleId& hit = question.exact.obstacle;
  const Atom& atom =
      scene.lattices[static_cast<std::size_t>(hit.lattice)].atoms[static_cast<std::size_t>(hit.atom)];
  its.flight_in_radii = flown / smallest_semiaxis(atom, scene.dimension);
  its.depth = -question.place->margins().approach(query, question.exact.obstacle).gap;
  return its;
}

namespace {

constexpr double kCommon = 0.5, kByChance = 1e-3;

using Holds = std::function<bool(const Features&)>;

std::vector<Circumstance> plain_circumstances() {
  const std::pair<const char*, Holds> all[] = {
      {"in 3D", [](const Features& f) { return f.in_space; }},
      {"in 2D", [](const Features& f) { return !f.in_space; }},
      {"where a component of v is zero", [](const Features& f) { return f.zero_component; }},
      {"of particles that leave an obstacle (from)", [](const Features& f) { return f.leaving; }},
      {"in scenes of several lattices", [](const Features& f) { return f.several_lattices; }},
      {"in scenes of several atoms a cell", [](const Features& f) { return f.several_atoms; }},
      {"among ellipses or ellipsoids", [](const Features& f) { return f.ellipsoids; }},
      {"in cells other than the unit square or cube", [](const Features& f) { return f.other_cell; }},
      {"where nothing is ever hit", [](const Features& f) { return f.never; }}};
  std::vector<Circumstance> circumstances;
  for (const auto& [text, holds] : all) circumstances.push_back({.text = text, .holds = holds});
  return circumstances;
}

// A limit on a quantity: the least power of ten above all failing questions, the greatest power of ten that
// they reach, or the greatest power of two, for lengths in radii, if it is far, because nothing cancels
// nearby.
enum class LimitSide { below, from, from_afar };
struct Limit {
  double Features::*quantity;
  LimitSide bound;
  const char* text;  // with the limit, or with the exponent of two
};
constexpr Limit kLimits[] = {
    {&Features::depth, LimitSide::below, "where the line enters the obstacle by less than {:g} of its radii"},
    {&Features::radius, LimitSide::below, "at radii below {:g} lattice vectors"},
    {&Features::radius, LimitSide::from, "at radii of {:g} lattice vectors or more"},
    {&Features::flight, LimitSide::from, "after flights of {:g} lattice vectors or more"},
    {&Features::flight, LimitSide::below, "on flights shorter than {:g} lattice vectors"},
    {&Features::start, LimitSide::from, "from starts {:g} lattice vectors or more from the origin"},
    {&Features::cell, LimitSide::from, "in far cells, with numbers of {:g} or more"},
    {&Features::distance, LimitSide::from_afar,
     "from starts 2^{:g} radii or more from the obstacle in question"},
    {&Features::flight_in_radii, LimitSide::from_afar, "after flights of 2^{:g} radii or more"},
    {&Features::speed, LimitSide::below, "at velocities shorter than {:g}"},
    {&Features::speed, LimitSide::from, "at velocities of length {:g} or more"}};

// The exponent of the limit, for the largest or the smallest of the failing questions.
double exponent_of(LimitSide bound, double extreme) {
  if (bound == LimitSide::from_afar) return std::ilogb(extreme);
  return std::floor(std::log10(extreme)) + (bound == LimitSide::below ? 1 : 0);
}

// Nothing if a failing question lacks the quantity, or if the limit says nothing: that a line enters by less
// than a radius, or that something near is far.
std::optional<Circumstance> circumstance_for(const Limit& its, const std::vector<Features>& failing) {
  constexpr double kFar = 10;
  const auto quantity = its.quantity;
  const bool is_below = its.bound == LimitSide::below, is_far = its.bound == LimitSide::from_afar,
             is_of_depth = quantity == &Features::depth;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Features& f : failing) {
    if (!(f.*quantity >= 0)) return std::nullopt;
    least = std::min(least, f.*quantity), most = std::max(most, f.*quantity);
  }
  const double extreme = is_below ? most : least;
  if (!(extreme > 0) || !std::isfinite(extreme)) return std::nullopt;
  const double exponent = exponent_of(its.bound, extreme), limit = std::pow(is_far ? 2 : 10, exponent);
  if ((is_of_depth && limit >= 1) || (is_far && exponent < kFar)) return std::nullopt;
  return Circumstance{
      .text = fmt::format(fmt::runtime(its.text), is_far ? exponent : limit),
      .is_of_depth = is_of_depth,
      .holds = [=](const Features& f) { return is_below ? f.*quantity < limit : f.*quantity >= limit; }};
}

std::vector<Circumstance> circumstances_for(const std::vector<Features>& failing) {
  std::vector<Circumstance> all = plain_circumstances();
  for (const Limit& limit : kLimits)
    if (const auto one = circumstance_for(limit, failing)) all.push_back(*one);
  return all;
}

}  // namespace

std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right) {
  if (failing.empty() || right.empty()) return std::nullopt;
  std::optional<Circumstance> rarest;
  for (Circumstance& one : circumstances_for(failing)) {
    if (!std::all_of(failing.begin(), failing.end(), one.holds)) continue;
    const auto number = std::count_if(right.begin(), right.end(), one.holds);
    const double share = static_cast<double>(number) / static_cast<double>(right.size());
    // With this number of right answers, a share that was not seen may still be this large.
    const double possible = std::max(share, 3 / static_cast<double>(right.size()));
    if (share > kCommon || std::pow(possible, failing.size()) > kByChance) continue;
    one.share = share;
    if (!rarest || share < rarest->share) rarest = std::move(one);
  }
  return rarest;
}

}  // namespace lorentz::judge
