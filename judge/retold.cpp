// The same plain flights in other words. An engine that goes wrong in some rows only shows by which one it is.
#include <fmt/format.h>

#include <cmath>

#include <lorentz/geometry.hpp>
#include "judge/plan.hpp"

namespace lorentz::judge {
namespace {

using cases::Random;

constexpr int kSpeed = 10, kFarthest = 30;  // exponents of two
constexpr std::int64_t kAway = 1000;        // by which single obstacles are moved, at most

// Starts are multiples of 2^-grid, so that they can be moved exactly.
int grid_of(NumberFormat format) {
  return (bits_of(format) - 13) / 2;
}

// The number of bits of a count of cells after which a start is still a number of the format.
int bits_to_move(NumberFormat format) {
  return std::min(kFarthest, bits_of(format) - grid_of(format) - 2);
}

class Retold {
 public:
  Retold(const std::vector<NamedPlace>& places, Retelling how, std::uint64_t seed, Outside& outside)
      : places_(places), how_(how), seed_(seed), outside_(outside) {
    Random random(seed, "retold places", 0);
    for (int i = 0; i < 3; ++i) away_[i] = random.whole(-kAway, kAway);
    for (const NamedPlace& named : places) {
      const Place& place = *named.place;
      starts_.emplace_back(place.scene(), starts::Kind::uniform, seed, place.claim().precision);
      const Scene scene = retold(place.scene());
      retold_.push_back(scene == place.scene() ? named.place : place_for(scene, place.claim()));
    }
  }

  const std::vector<std::shared_ptr<Place>>& places() const { return retold_; }
  std::optional<Question> question(std::size_t place, std::size_t index) const {
    const auto plain = plain_flight(place, index);
    return plain ? asked(place, index, *plain) : std::nullopt;
  }

 private:
  // A single obstacle is moved together with the start.
  Scene retold(Scene scene) const {
    const bool repeats = scene.lattices[0].rank_in(scene.dimension) > 0;
    for_each_atom(scene, [&](Atom& atom) {
      if (how_ == Retelling::mirrored) atom.position = scaled(atom.position, -1);
      if (how_ == Retelling::moved && !repeats) atom.position = sum(atom.position, away_);
    });
    return scene;
  }

  // The same in all rows; nothing if the start lies in an obstacle after its rounding to the grid.
  std::optional<Query> plain_flight(std::size_t which, std::size_t index) const {
    const Place& place = *places_[which].place;
    const int grid = grid_of(place.claim().precision);
    Query query = starts_[which][index];
    for (double& x : query.x) x = std::ldexp(std::floor(std::ldexp(x, grid)), -grid);
    if (place.exact(query).outcome == Outcome::inside) return std::nullopt;
    return query;
  }

  Query retold(Random& random, const Place& place, Query query) const {
    const Scene& scene = place.scene();
    const Lattice& lattice = scene.lattices[0];
    if (how_ == Retelling::mirrored) query.x = scaled(query.x, -1), query.v = scaled(query.v, -1);
    if (how_ == Retelling::faster) query.v = scaled(query.v, std::ldexp(1, random.exponent(-kSpeed, kSpeed)));
    if (how_ != Retelling::moved) return query;
    const int bits = random.exponent(0, bits_to_move(place.claim().precision)),
              rank = lattice.rank_in(scene.dimension);
    if (rank == 0) query.x = sum(query.x, away_);
    for (int i = 0; i < rank; ++i)
      query.x = plus(query.x, random.whole(-(std::int64_t{1} << bits), std::int64_t{1} << bits),
                     lattice.vectors[i]);
    return query;
  }

  std::optional<Question> asked(std::size_t which, std::size_t index, const Query& plain) const {
    const std::shared_ptr<Place>& place = retold_[which];
    Random random(seed_, "retold flights", index);
    auto question =
        question_in(place, retold(random, *place, plain),
                    fmt::format("{}, {}", row_words_of(how_).name, places_[which].name), outside_);
    if (!question || how_ != Retelling::limited) return question;
    const double time = question->exact.time.value_or(1 / length_of_any(question->query.v));
    question->max_time = rounded(time * random.octave(-2, 2), place->claim().precision);
    const bool is_limit = question->max_time > 0 && std::isfinite(question->max_time);
    if (!is_limit || !place->claim().domain.limits) return ++outside_, std::nullopt;
    return question;
  }

  const std::vector<NamedPlace>& places_;
  const Retelling how_;
  const std::uint64_t seed_;
  Outside& outside_;
  Vec away_{};
  std::vector<starts::FreeStarts> starts_;
  std::vector<std::shared_ptr<Place>> retold_;
};

}  // namespace

RowWords row_words_of(Retelling how) {
  constexpr RowWords kWords[] = {
      {"plain", "starts in the first cell, |v| = 1; the next rows ask the same flights in other words"},
      {"plain moved", "the same flights, up to 2^30 cells away; single obstacles, moved with the start"},
      {"plain mirrored", "the same flights with x, v and the obstacles negated"},
      {"plain at other speeds", "the same flights with v times 2^-10 to 2^10"},
      {"plain limited", "the same flights, until 1/4 to 4 times their times (max_time)"}};
  return kWords[static_cast<std::size_t>(how)];
}

Source retold(const std::vector<NamedPlace>& places, Retelling how, std::uint64_t seed, std::size_t count,
              Outside& outside) {
  const auto maker = std::make_shared<Retold>(places, how, seed, outside);
  return in_turn(maker->places(), count,
                 [maker](std::size_t place, std::size_t index) { return maker->question(place, index); });
}

}  // namespace lorentz::judge
