#include "judge/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <tuple>

#include "fuzz/campaign/variants.hpp"
#include "fuzz/families/family.hpp"
#include "judge/golden/reader.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::judge {
namespace {

// Numbered starts in one place.
using Starts = std::function<starts::VariedStart(std::uint64_t index)>;

Starts starts_in(const Place& place, starts::Kind kind, std::uint64_t seed) {
  if (kind == starts::Kind::uniform)
    return [all = std::make_shared<starts::VariedStarts>(place.scene(), seed, place.claim())](
               std::uint64_t index) { return (*all)[index]; };
  return [all = std::make_shared<starts::FreeStarts>(place.scene(), kind, seed, place.claim().precision)](
             std::uint64_t index) { return starts::VariedStart{(*all)[index]}; };
}

class CampaignQuestions {
 public:
  CampaignQuestions(std::uint64_t seed, const fuzz::Scope& scope, bool same_time, unsigned part,
                    unsigned parts, const Claim& claim, Outside& outside)
      : outside_(outside),
        seed_(seed),
        scope_(scope),
        claim_(claim),
        same_time_(same_time),
        stride_(parts * cases::kCasesPerScene) {
    for (const cases::Target& target : cases::targets())
      if (scope_.meets(target, seed_)) tracks_.push_back({&target, part * cases::kCasesPerScene});
  }

  std::optional<Question> next() {
    for (std::size_t tried = 0; questions_.empty() && tried < kTries; ++tried) make();
    if (questions_.empty()) return std::nullopt;
    Question question = std::move(questions_.front());
    questions_.pop_front();
    return question;
  }

 private:
  static constexpr std::size_t kTries = 10'000;  // most scenes in a row that the scope may leave out

  // A target, its next case, and the time that it has taken.
  struct TargetTrack {
    const cases::Target* target;
    std::uint64_t next = 0;
    double seconds = 0;
  };

  void make() {
    if (tracks_.empty()) return;
    TargetTrack& track =
        *std::min_element(tracks_.begin(), tracks_.end(), [](const TargetTrack& a, const TargetTrack& b) {
          return std::tie(a.seconds, a.next) < std::tie(b.seconds, b.next);
        });
    const auto start = std::chrono::steady_clock::now();
    make(*track.target, track.next);
    track.next += stride_;
    if (!same_time_) return;
    track.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // Makes the cases of one scene of the target, and the variants of one of them.
  void make(const cases::Target& target, std::uint64_t begin) {
    const cases::Case base = target.make(seed_, begin, claim_.precision);
    if (!scope_.admits(base.scene)) return;
    const auto place = place_for(base.scene, claim_);
    const auto add = [&](const Query& query, std::uint64_t index, int step) {
      std::string where =
          fmt::format("campaign, {}/{}{}", target.name(), index, step > 0 ? fmt::format(".{}", step) : "");
      if (auto question = question_in(place, query, std::move(where), outside_))
        questions_.push_back(std::move(*question));
    };
    for (std::uint64_t index = begin; index < begin + kCases; ++index) {
      const cases::Case one = target.make(seed_, index, claim_.precision);
      if (one.scene == base.scene) add(one.query, index, 0);
    }
    const std::optional<Query> inside = place->brought_inside(base.query);
    if (!inside) return;
    int step = 0;
    const cases::Random random(seed_, target.name(), begin, cases::Use::variants);
    for (const fuzz::Variant& variant : fuzz::climb(random, *inside, *place))
      add(variant.query, begin, ++step);
  }

  static constexpr std::uint64_t kCases = 16;  // of one scene

  Outside& outside_;
  const std::uint64_t seed_;
  const fuzz::Scope scope_;
  const Claim claim_;
  const bool same_time_;
  const std::uint64_t stride_;  // from one scene to the next
  std::vector<TargetTrack> tracks_;
  std::deque<Question> questions_;
};

}  // namespace

// Copies of the source share the number at which it is.
Source in_turn(const std::vector<std::shared_ptr<Place>>& places, std::size_t count,
               const std::function<std::optional<Question>(std::size_t place, std::size_t index)>& ask) {
  constexpr std::size_t kBlock = 16;
  return [=, shared = std::make_shared<std::size_t>(0)]() -> std::optional<Question> {
    std::size_t& number = *shared;
    for (std::size_t beyond = 0; number < count && beyond < places.size();) {
      const std::size_t block = number / kBlock, place = block % places.size();
      if (places[place]->is_beyond_engine()) {
        number = (block + 1) * kBlock, ++beyond;
        continue;
      }
      beyond = 0;
      if (auto question = ask(place, block / places.size() * kBlock + number++ % kBlock)) return question;
    }
    return std::nullopt;
  };
}

std::optional<Question> question_in(const std::shared_ptr<Place>& place, const Query& start,
                                    std::string where, Outside& outside) {
  if (const auto query = place->brought_inside(start)) {
    Question question{
        .place = place, .query = *query, .exact = place->exact(*query), .where = std::move(where)};
    if (place->takes(question.query, question.exact)) return question;
  }
  ++outside;
  return std::nullopt;
}

std::shared_ptr<Place> place_for(const Scene& scene, const Claim& claim) {
  return std::make_shared<Place>(rounded(scene, claim.precision), claim);
}

Source drawn(const std::vector<NamedPlace>& places, starts::Kind kind, std::uint64_t seed, std::size_t count,
             Outside& outside) {
  const std::string what = kind == starts::Kind::uniform   ? "drawn"
                           : kind == starts::Kind::surface ? "free paths"
                                                           : name_of(kind);
  std::vector<Starts> starts;
  std::vector<std::shared_ptr<Place>> in;
  for (const NamedPlace& place : places)
    in.push_back(place.place), starts.push_back(starts_in(*place.place, kind, seed));
  return in_turn(in, count, [=, &places, &outside](std::size_t which, std::size_t index) {
    const auto& [name, place] = places[which];
    const starts::VariedStart start = starts[which](index);
    auto question = question_in(place, start.query, fmt::format("{}, {}", what, name), outside);
    if (question) question->max_time = start.max_time;
    return question;
  });
}

Source golden_set(const std::string& path, const Claim& claim, Outside& outside) {
  const auto reader = std::make_shared<golden::Reader>(path);
  return [reader, records = golden::questions_of(*reader, claim), &outside] {
    std::optional<Question> question;
    const auto is_passed_over = [&] {
      const Place& place = *question->place;
      if (place.is_beyond_engine() || !place.has_numbers_for(question->query)) return true;
      return is_in_domain(*question) ? false : (++outside, true);
    };
    do question = records();
    while (question && is_passed_over());
    if (question) question->where = fmt::format("golden {}, {}", reader->header().name, question->where);
    return question;
  };
}

Source campaign(std::uint64_t seed, const fuzz::Scope& scope, bool same_time, unsigned part, unsigned parts,
                const Claim& claim, Outside& outside) {
  const auto maker = std::make_shared<CampaignQuestions>(seed, scope, same_time, part, parts, claim, outside);
  return [maker] { return maker->next(); };
}

fuzz::Scope scope_of(const std::vector<NamedPlace>& places) {
  using Scenes = fuzz::Scope::Scenes;
  bool in_plane = false, in_space = false;
  std::vector<Scenes> fitting{Scenes::unit, Scenes::ball, Scenes::lattice, Scenes::any};
  for (const NamedPlace& place : places) {
    if (!place.place->was_answered()) continue;
    const Scene& scene = place.place->scene();
    (scene.dimension == 2 ? in_plane : in_space) = true;
    std::erase_if(fitting, [&](Scenes scenes) { return !fuzz::Scope{scenes, 0}.admits(scene); });
  }
  if (!in_plane && !in_space) return {};
  fuzz::Scope scope{fitting.front(), 0};
  // The places have no single disc, only a single ball.
  if (in_plane != in_space && scope.scenes != Scenes::ball) scope.dimension = in_plane ? 2 : 3;
  return scope;
}

}  // namespace lorentz::judge
