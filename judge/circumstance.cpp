#include "judge/circumstance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lorentz::judge {
namespace {

constexpr double kCommon = 0.5, kByChance = 1e-3;

struct Predicate {
  std::string text;
  std::function<bool(const Features&)> holds;
  bool is_of_depth = false;
};

std::vector<Predicate> plain_predicates() {
  return {{"in 3D", [](const Features& f) { return f.in_space; }},
          {"in 2D", [](const Features& f) { return !f.in_space; }},
          {"where a component of v is zero", [](const Features& f) { return f.zero_component; }},
          {"of particles that leave an obstacle (from)", [](const Features& f) { return f.leaving; }},
          {"in scenes of several lattices", [](const Features& f) { return f.several_lattices; }},
          {"in scenes of several atoms a cell", [](const Features& f) { return f.several_atoms; }},
          {"among ellipses or ellipsoids", [](const Features& f) { return f.ellipsoids; }},
          {"in cells other than the unit square or cube", [](const Features& f) { return f.other_cell; }},
          {"where nothing is ever hit", [](const Features& f) { return f.never; }}};
}

using Quantity = double Features::*;

// "below 1e-9", with the least power of ten above all failing questions. Nothing if one of them lacks the
// quantity, or if that power is `says_nothing` or more.
std::optional<Predicate> where_below(const std::vector<Features>& failing, Quantity quantity,
                                     const char* text,
                                     double says_nothing = std::numeric_limits<double>::infinity()) {
  double most = 0;
  for (const Features& f : failing) {
    if (!(f.*quantity >= 0)) return std::nullopt;
    most = std::max(most, f.*quantity);
  }
  if (!(most > 0) || !std::isfinite(most)) return std::nullopt;
  const double limit = std::pow(10, std::floor(std::log10(most)) + 1);
  if (limit >= says_nothing) return std::nullopt;
  return Predicate{fmt::format(fmt::runtime(text), limit),
                   [=](const Features& f) { return f.*quantity < limit; }};
}

std::optional<Predicate> least(Quantity quantity, double limit, const std::string& text) {
  return Predicate{text, [=](const Features& f) { return f.*quantity >= limit; }};
}

// The smallest value; nothing if one of the questions lacks the quantity.
std::optional<double> smallest(const std::vector<Features>& failing, Quantity quantity) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Features& f : failing) {
    if (!(f.*quantity > 0)) return std::nullopt;
    smallest = std::min(smallest, f.*quantity);
  }
  return std::isfinite(smallest) ? std::optional(smallest) : std::nullopt;
}

// The greatest power of ten that all failing questions reach.
std::optional<Predicate> from(const std::vector<Features>& failing, Quantity quantity, const char* text) {
  const auto reached = smallest(failing, quantity);
  if (!reached) return std::nullopt;
  const double limit = std::pow(10, std::floor(std::log10(*reached)));
  return least(quantity, limit, fmt::format(fmt::runtime(text), limit));
}

// The greatest power of two that all failing questions reach, for lengths in radii, if it is far, because
// nothing cancels nearby.
std::optional<Predicate> from_afar(const std::vector<Features>& failing, Quantity quantity,
                                   const char* text) {
  constexpr int kFar = 10;
  const auto reached = smallest(failing, quantity);
  const int exponent = reached ? std::ilogb(*reached) : 0;
  if (exponent < kFar) return std::nullopt;
  return least(quantity, std::ldexp(1, exponent), fmt::format(fmt::runtime(text), exponent));
}

std::vector<Predicate> predicates_for(const std::vector<Features>& failing) {
  std::vector<Predicate> all = plain_predicates();
  if (auto depth = where_below(failing, &Features::depth,
                               "where the line enters the obstacle by less than {:g} of its radii", 1)) {
    depth->is_of_depth = true;
    all.push_back(*depth);
  }
  for (auto& one :
       {where_below(failing, &Features::radius, "at radii below {:g} lattice vectors"),
        from(failing, &Features::radius, "at radii of {:g} lattice vectors or more"),
        from(failing, &Features::flight, "after flights of {:g} lattice vectors or more"),
        where_below(failing, &Features::flight, "on flights shorter than {:g} lattice vectors"),
        from(failing, &Features::start, "from starts {:g} lattice vectors or more from the origin"),
        from(failing, &Features::cell, "in far cells, with numbers of {:g} or more"),
        from_afar(failing, &Features::distance,
                  "from starts 2^{} radii or more from the obstacle in question"),
        from_afar(failing, &Features::flight_in_radii, "after flights of 2^{} radii or more"),
        where_below(failing, &Features::speed, "at velocities shorter than {:g}"),
        from(failing, &Features::speed, "at velocities of length {:g} or more")})
    if (one) all.push_back(*one);
  return all;
}

}  // namespace

std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right) {
  if (failing.empty() || right.empty()) return std::nullopt;
  std::optional<Circumstance> rarest;
  for (const Predicate& predicate : predicates_for(failing)) {
    if (!std::all_of(failing.begin(), failing.end(), predicate.holds)) continue;
    const auto number = std::count_if(right.begin(), right.end(), predicate.holds);
    const double share = static_cast<double>(number) / static_cast<double>(right.size());
    // With this number of right answers, a share that was not seen may still be this large.
    const double possible = std::max(share, 3 / static_cast<double>(right.size()));
    if (share > kCommon || std::pow(possible, failing.size()) > kByChance) continue;
    if (!rarest || share < rarest->share)
      rarest = Circumstance{predicate.text, share, predicate.is_of_depth, predicate.holds};
  }
  return rarest;
}

}  // namespace lorentz::judge
