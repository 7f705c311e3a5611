#include "fuzz/campaign/rewording.hpp"

#include <algorithm>
#include <limits>

namespace lorentz::fuzz {

using namespace cases;

namespace {

constexpr DrawStep kSteps[] = {draw_basis,          draw_basis,       draw_superlattice,
                               draw_axes,           draw_moved_scene, draw_scaled,
                               draw_plane_in_space, draw_ellipsoids,  draw_order};
constexpr std::uint64_t kMostSteps = 4;
constexpr int kFewestBits = 1, kMostBits = 50;

IntegerVec integers_of(const std::array<std::int64_t, 3>& n) {
  return {Z(static_cast<long>(n[0])), Z(static_cast<long>(n[1])), Z(static_cast<long>(n[2]))};
}

bool is_normal_above_least(double t) {
  return std::isfinite(t) && t > std::numeric_limits<double>::min();
}

void change_speed(Random& random, Reworded& reworded) {
  Vec& v = reworded.query.v;
  BitRange range;
  range.see(v);
  // least <= 0 <= most, because the components are binary64 values as they are.
  const long least = std::max<long>(kLeastExponent, kLeastExponent - range.lowest),
             most = std::min<long>(kLargestExponent, kLargestExponent - range.highest);
  const long drawn = random.one_in(4)   ? least + static_cast<long>(random.below(4))
                     : random.one_in(3) ? most - static_cast<long>(random.below(4))
                     : random.one_in(2) ? static_cast<long>(random.integer(-8, 8))
                                        : static_cast<long>(random.integer(least, most));
  reworded.speed = static_cast<int>(std::clamp(drawn, least, most));
  v = *exact_scaled(v, reworded.speed);
}

}  // namespace

Periods::Periods(const Scene& scene) {
  if (!is_crystal(scene)) {
    if (scene.lattices.size() == 1 && scene.lattices[0].rank_in(scene.dimension) > 0)
      in_cells.push_back(identity());
    return;
  }
  oracle::CommonExponent common;
  for (const Lattice& lattice : scene.lattices)
    for (int k = 0; k < scene.dimension; ++k)
      for (const double component : lattice.vectors[k]) common.see(component);
  const auto integers = [&](const Lattice& lattice) {
    return to_integers(lattice.vectors, scene.dimension, common.get());
  };
  const IntegerMatrix first = integers(scene.lattices[0]);
  std::vector<std::pair<IntegerMatrix, Z>> fractions;  // of U_l^-1 U_0
  for (const Lattice& lattice : scene.lattices) {
    const IntegerMatrix u = integers(lattice), a = adjugate(u);
    fractions.push_back({{a * first[0], a * first[1], a * first[2]}, determinant(u)});
    for (const IntegerVec& column : fractions.back().first)
      for (const Z& entry : column) {
        const Z shared = gcd(entry, fractions.back().second);
        multiple = lcm(multiple, Z(fractions.back().second / shared));
      }
    if (oracle::bit_length(multiple) > kMostBitsOfMultiple) return;
  }
  for (auto& [numerator, denominator] : fractions) {
    for (IntegerVec& column : numerator)
      for (Z& entry : column) entry = entry * multiple / denominator;
    in_cells.push_back(std::move(numerator));
  }
}

Rewording::Rewording(Random& random, const Scene& old)
    : rank_(old.lattices[0].rank_in(old.dimension)),
      scene_(old),
      vectors_(old.lattices[0].vectors),
      periods_(old) {
  if (old.dimension == 2) vectors_[2] = {};
  for (std::uint64_t count = 1 + random.below(kMostSteps); count > 0; --count)
    if (auto step = kSteps[random.below(std::size(kSteps))](random, scene_))
      steps_.push_back(std::move(*step));
}

// Moves the start by up to 2^50 periods, or by fewer if the sum is not a binary64 value: along one vector
// or along all.
void Rewording::move_start(Random& random, Reworded& reworded) const {
  const auto drawn = static_cast<int>(random.integer(kFewestBits, kMostBits));
  const bool along_one = random.one_in(2), powers = random.one_in(2);
  const std::uint64_t one = random.below(static_cast<std::uint64_t>(rank_));
  const bool may_round = random.one_in(4);
  for (int bits = drawn; bits > 0; bits = bits / 2) {
    std::array<std::int64_t, 3> k{};
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(rank_); ++i) {
      const std::int64_t size = std::int64_t{1} << bits;
      const std::int64_t n = powers ? (random.one_in(2) ? size : -size) : random.integer(-size, size);
      if (!along_one || i == one) k[i] = n;
    }
    IntegerVec cells = integers_of(k);
    for (Z& n : cells) n *= periods_.multiple;
    if (auto x = exact_sum(reworded.query.x, cells, vectors_)) {
      reworded.query.x = *x;
      reworded.periods = k;
      return;
    }
    if (may_round) return round_start(k, cells, reworded);
  }
}

// Far from the origin most starts are not binary64 values. The nearest binary64 start is another question.
void Rewording::round_start(const std::array<std::int64_t, 3>& k, const IntegerVec& cells,
                            Reworded& reworded) const {
  Vec x = reworded.query.x;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) x[i] += cells[j].get_d() * vectors_[j][i];
  if (!std::isfinite(x[0] + x[1] + x[2])) return;
  reworded.query.x = x;
  reworded.periods = k;
  reworded.rounded = true;
}

std::string Rewording::words(const Reworded& reworded) const {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  for (const RewordingStep& step : steps_) add(step.words);
  std::int64_t farthest = 0;
  for (const std::int64_t n : reworded.periods) farthest = std::max(farthest, std::abs(n));
  if (farthest > 0)
    add("start moved 2^" + std::to_string(std::ilogb(static_cast<double>(farthest))) +
        (reworded.rounded ? " and rounded" : ""));
  if (reworded.speed != 0) add("velocity 2^" + std::to_string(reworded.speed));
  return text;
}

std::optional<Reworded> Rewording::reword(Random& random, const Query& query) const {
  Reworded reworded{query};
  if (!periods_.in_cells.empty() && random.one_in(2)) move_start(random, reworded);
  if (random.one_in(2)) change_speed(random, reworded);
  for (const RewordingStep& step : steps_)
    if (!step.reword(reworded.query.x, reworded.query.v)) return std::nullopt;
  if (query.from) reworded.query.from = there(*query.from, reworded);
  return reworded;
}

// Moves the obstacle by as many cells as the start was moved, or back by them.
void Rewording::shift(ObstacleId& id, const Reworded& reworded, int sign) const {
  if (reworded.periods == std::array<std::int64_t, 3>{}) return;
  IntegerVec n = to_integers(id.cell);
  const IntegerVec moved = periods_.in_cells[id.lattice] * integers_of(reworded.periods);
  for (std::size_t i = 0; i < 3; ++i) n[i] += sign * moved[i];
  id.cell = to_cell(n);
}

ObstacleId Rewording::there(ObstacleId id, const Reworded& reworded) const {
  shift(id, reworded, 1);
  for (const RewordingStep& step : steps_) step.there(id);
  return id;
}

ObstacleId Rewording::back(ObstacleId id, const Reworded& reworded) const {
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) step->back(id);
  shift(id, reworded, -1);
  return id;
}

// The rounded time in other units is the time rounded there if both are normal numbers. A time that
// underflowed, or lies beyond the largest number, has lost the digits that decide.
std::optional<Answer> Rewording::carried(const Answer& exact, const Reworded& reworded) const {
  if (reworded.rounded) return std::nullopt;
  if (exact.outcome == Outcome::never) return Answer::never();
  if (exact.outcome == Outcome::inside) return Answer::inside(there(exact.obstacle, reworded));
  if (exact.outcome != Outcome::hit || !exact.time) return std::nullopt;
  int exponent = -reworded.speed;
  for (const RewordingStep& step : steps_) exponent += step.time_exponent;
  double time = *exact.time;
  if (exponent != 0) {
    time = std::ldexp(time, exponent);
    if (!is_normal_above_least(*exact.time) || !is_normal_above_least(time)) return std::nullopt;
  }
  return Answer::hit(there(exact.obstacle, reworded), time);
}

}  // namespace lorentz::fuzz
