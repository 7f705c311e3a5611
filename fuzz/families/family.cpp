#include "fuzz/families/family.hpp"

#include <stdexcept>

#include <lorentz/scene_check.hpp>
#include "question/cases/drawn_flights.hpp"

namespace lorentz::cases {

namespace {

constexpr std::uint64_t kMostAttempts = 1000;  // more than any family needs: needing more is a bug
constexpr std::uint64_t kMostIntoObstacles = 100;

}  // namespace

bool is_sound(const Scene& scene) {
  return !flaw_of(scene) && !oracle::dependence_in(scene);
}

std::vector<Tag> Family::tags(NumberFormat precision) const {
  if (precision == NumberFormat::binary64) return tags_;
  std::vector<Tag> found;
  for (const Tag& tag : tags_)
    if (!tag.note_in_binary32.empty()) found.push_back({tag.name, tag.note_in_binary32});
  return found;
}

Case Family::attempt(std::uint64_t seed, std::uint64_t index, NumberFormat precision, std::uint64_t scene,
                     std::uint64_t query) const {
  const Series series(name_);
  Source source{index, Random(seed, series, index / kCasesPerScene, Use::scenes, scene),
                Random(seed, series, index, Use::cases, query), precision};
  Case made;
  maker_(source, made);
  return made;
}

// The scene depends only on its own random numbers, and so does the number of the first sound attempt at it.
// So all cases that share a scene agree on it.
Case Family::make(std::uint64_t seed, std::uint64_t index, NumberFormat precision) const {
  if (precision == NumberFormat::binary64) return attempt(seed, index, precision, 0, 0);
  std::uint64_t scene = 0;
  for (std::uint64_t query = 0; scene + query < kMostAttempts;) {
    const Case drawn = attempt(seed, index, precision, scene, query);
    Case made{rounded(drawn.scene, precision), rounded(drawn.query, precision), drawn.tags};
    if (!is_sound(made.scene)) {
      ++scene;
    } else if (flaw_of(made.query, made.scene)) {
      ++query;
    } else if (query < kMostIntoObstacles && starts_inside(made.scene, made.query) &&
               !starts_inside(drawn.scene, drawn.query)) {
      ++query;
    } else {
      return made;
    }
  }
  throw std::logic_error(std::string(name_) + ": no case in " + name_of(precision));
}

Case Target::make(std::uint64_t seed, std::uint64_t index, NumberFormat precision) const {
  const std::uint64_t row = index / kCasesPerScene, count = families_.size();
  return families_[row % count].make(seed, row / count * kCasesPerScene + index % kCasesPerScene, precision);
}

}  // namespace lorentz::cases
