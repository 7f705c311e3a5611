#include "flights/sample/free_starts.hpp"

#include <lorentz/certified.hpp>
#include <lorentz/errors.hpp>
#include "flights/sample/hard_starts.hpp"
#include "flights/starts/starts.hpp"

namespace lorentz::flights {

using cases::Random;
using cases::Series;

const std::vector<std::string>& kind_names() {
  static const std::vector<std::string> names{"uniform", "surface", "near-rational", "grazing"};
  return names;
}

struct FreeStarts::Inside {
  Inside(const Scene& of, Kind what, std::uint64_t number)
      : scene(of),
        kind(what),
        seed(number),
        starts(of, what == Kind::surface ? Ensemble::surface : Ensemble::uniform, number),
        oracle(of),
        certified(of) {}

  bool is_free(const Query& start) const {
    oracle::Request at_once;
    at_once.max_time = 0;
    return certified.first_hit(start, at_once).outcome != Outcome::inside;
  }

  // True if the candidate became a start of the kind.
  bool make(Random& random, Query& start) const {
    if (kind == Kind::grazing) return move_to_graze(random, scene, oracle, start);
    if (!is_free(start)) return false;
    if (kind == Kind::near_rational) start.v = near_rational_direction(random, scene);
    return true;
  }

  Scene scene;
  Kind kind;
  std::uint64_t seed;
  Starts starts;
  oracle::Oracle oracle;
  oracle::Certified certified;
};

FreeStarts::FreeStarts(const Scene& scene, Kind kind, std::uint64_t seed)
    : inside_(std::make_unique<const Inside>(scene, kind, seed)) {}
FreeStarts::~FreeStarts() = default;
FreeStarts::FreeStarts(FreeStarts&&) noexcept = default;

void FreeStarts::draw(std::uint64_t index, Query& start) const {
  constexpr Series kHard("hard starts");
  for (std::uint64_t attempt = 0; attempt < Starts::kMostAttempts; ++attempt) {
    Random random(inside_->seed, kHard, index, cases::Use::cases, attempt);
    inside_->starts.draw(index, attempt, start);
    if (inside_->make(random, start)) return;
  }
  throw InputError(nowhere_to_start(Starts::kMostAttempts));
}

}  // namespace lorentz::flights
