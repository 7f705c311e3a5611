#include "judge/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "report/files/scene_file.hpp"

namespace lorentz::judge {

using starts::Kind;

namespace {

// Seconds of the parts, by JudgePart, of a whole run and of a quick one; their proportions also hold for another time.
constexpr double kPartTimes[][2] = {{15, 4}, {8, 2.5}, {3, 1}, {24, 3.5}, {58, 4.5}, {12, 3}, {4, 1}};
static_assert(std::size(kPartTimes) == static_cast<std::size_t>(JudgePart::speed) + 1);

// The largest number of flights of a drawn row; a hard row in the same scenes has twice as many.
constexpr std::size_t kDrawn = 4000, kDrawnQuickly = 500;

// The scenes of the catalogue that are examined, and their radii; scenes without radii keep their own sizes.
using Scenery = std::pair<const char*, std::vector<double>>;
const std::vector<Scenery> kSceneries{{"square", {0.3, 0.1, 0.01, 0.001, 1e-6}},
                                      {"cubic", {0.3, 0.1, 0.01, 0.001}},
                                      {"triangular", {0.1, 0.001}},
                                      {"oblique", {}},
                                      {"honeycomb", {}},
                                      {"fcc", {}},
                                      {"hcp", {}},
                                      {"diamond", {}},
                                      {"superposition-pi-5", {}},
                                      {"overlapping", {}},
                                      {"ellipse", {}},
                                      {"ellipsoid", {}},
                                      {"ball", {}}};

// The scenes of the row `free paths`, and its number of flights.
constexpr std::pair<const char*, double> kFlown[] = {{"square", 0.1}, {"square", 0.01}, {"cubic", 0.1}};
constexpr std::size_t kFlights = 30'000;

std::vector<NamedPlace> places_of(const Scenery& scenery, const Claim& claim) {
  const auto& [scene, radii] = scenery;
  if (radii.empty()) return {{scene, place_for(read_scene(scene, {}), claim)}};
  std::vector<NamedPlace> places;
  for (const double radius : radii)
    places.push_back(
        {fmt::format("{}, r = {:g}", scene, radius), place_for(read_scene(scene, radius), claim)});
  return places;
}

// The committed sets that an engine is asked about. Sets in binary32 are for engines in binary32 only; for
// other engines the same families are harder in binary64.
// Only a program reads invalid questions by itself.
std::vector<std::string> golden_sets_for(const JudgeOrder& order) {
  std::vector<std::string> files = golden::committed_sets();
  std::erase_if(files, [&](const std::string& file) {
    const golden::Header header = golden::Reader(file).header();
    const bool is_other =
        order.claim.precision == NumberFormat::binary64 && header.precision != order.claim.precision;
    return is_other || (header.name == "bad-queries" && !order.engine.is_command());
  });
  return files;
}

}  // namespace

double JudgeOrder::seconds() const {
  if (time) return *time;
  double all = 0;
  for (const auto& part : kPartTimes) all += part[quick];
  return all;
}

double seconds_of(JudgePart part, const JudgeOrder& order, double left) {
  const auto number = static_cast<std::size_t>(part);
  double all = 0, needed = 0;
  for (std::size_t i = 0; i < std::size(kPartTimes); ++i) {
    all += kPartTimes[i][order.quick];
    if (i >= number) needed += kPartTimes[i][order.quick];
  }
  return kPartTimes[number][order.quick] * std::min(order.seconds() / all, left / needed);
}

void JudgePlan::add(JudgePart part, ExaminedRow row, Source source) {
  rows_.push_back({part, std::move(row), std::move(source), {}});
}

// The places of the flights that are retold: the cells are cubes, so that starts can be moved exactly.
constexpr const char* kRetold[] = {"square, r = 0.1", "square, r = 0.01", "cubic, r = 0.1", "ball"};

// The flights in other words; one row for each scene; then two rows of hard flights in all these scenes that have balls; then free paths and
// golden sets.
JudgePlan::JudgePlan(const JudgeOrder& order) : order_(order) {
  for (const Scenery& scenery : kSceneries) sceneries_.push_back(places_of(scenery, order_.claim));
  const std::size_t number = order_.questions.value_or(order_.quick ? kDrawnQuickly : kDrawn);
  for (const auto& scenery : sceneries_) places_.insert(places_.end(), scenery.begin(), scenery.end());
  for (const char* name : kRetold)
    plain_places_.push_back(*std::ranges::find(places_, name, &NamedPlace::name));
  for (const Retelling how :
       {Retelling::plain, Retelling::moved, Retelling::mirrored, Retelling::faster, Retelling::limited})
    add(JudgePart::drawn,
        {.name = row_words_of(how).name, .explanation = row_words_of(how).explanation, .is_hard = false},
        retold(plain_places_, how, order_.seed, number, outside_));
  for (std::size_t i = 0; i < kSceneries.size(); ++i) {
    add(JudgePart::drawn,
        {.name = fmt::format("drawn {}", kSceneries[i].first),
         .explanation = starts::kVariedWords,
         .is_hard = false},
        drawn(sceneries_[i], Kind::uniform, order_.seed, number, outside_));
  }
  add(JudgePart::hard,
      {.name = "near-rational",
       .explanation = "directions along small lattice vectors but for ulps to 2^-40, in these scenes"},
      drawn(places_, Kind::near_rational, order_.seed, 2 * number, outside_));
  add(JudgePart::hard,
      {.name = "grazing",
       .explanation = "the first ball is passed or met within r 2^-10 to r 2^-52 of its edge"},
      drawn(places_, Kind::grazing, order_.seed, 2 * number, outside_));
  for (const auto& [scene, radius] : kFlown) {
    flown_.emplace_back(scene, radius);
    flown_places_.push_back({flown_.back().name(), place_for(read_scene(scene, radius), order_.claim)});
  }
  add(JudgePart::paths,
      {.name = "free paths",
       .explanation = "from collision to collision: starts on obstacles, by the cosine law",
       .is_hard = false},
      drawn(flown_places_, Kind::surface, order_.seed, kFlights, outside_));
  rows_.back().look = [this](const question::Judged& judged) {
    for (std::size_t i = 0; i < flown_.size(); ++i)
      if (judged.question.place == flown_places_[i].place)
        flown_[i].add(judged.question, judged.reply.answer);
  };
  for (const std::string& file : golden_sets_for(order_)) {
    const golden::Header header = golden::Reader(file).header();
    add(JudgePart::golden,
        {.name = "golden " + std::filesystem::path(file).stem().string(),
         .explanation = header.description,
         .records = header.count},
        golden_set(file, order_.claim, outside_));
  }
}

std::vector<FlownScene> JudgePlan::flown() const {
  std::vector<FlownScene> flown = flown_;
  std::erase_if(flown, [](const FlownScene& scene) { return scene.flights() == 0; });
  return flown;
}

ExaminedRow campaign_row() {
  return {.name = "campaign",
          .explanation = "constructed cases of all families, and variants of the smallest margin"};
}

Source JudgePlan::campaign(unsigned part, unsigned parts) {
  const fuzz::Scope scope = scope_of(places_);
  const auto source = [&] {
    return judge::campaign(order_.seed, scope, !order_.questions, part, parts, order_.claim, outside_);
  };
  if (part == 0 && (!campaign_ || scope != scope_)) campaign_ = source(), scope_ = scope;
  return part == 0 ? campaign_ : source();
}

}  // namespace lorentz::judge
