#include "judge/questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <tuple>

#include "cases/families/target.hpp"
#include "flights/sample/free_starts.hpp"
#include "fuzz/examine/variants.hpp"
#include "golden/reader.hpp"

namespace lorentz::judge {
namespace {

constexpr std::size_t kBlock = 16;  // drawn queries of one place in a row

Question question_of(const Place& place, const Query& query, const std::string& where) {
  return {place.setting, query, place.setting->oracle().first_hit(query), where, ""};
}

// Blocks of all places in turn.
class Drawn {
 public:
  Drawn(const std::vector<Place>& places, compare::Difficulty difficulty, std::uint64_t seed,
        std::size_t count)
      : places_(places), difficulty_(difficulty), seed_(seed), left_(count) {}

  std::optional<Question> next() {
    if (left_ == 0 || (next_ == queries_.size() && !draw())) return std::nullopt;
    --left_;
    return question_of(*place_, queries_[next_++], fmt::format("{}, {}", name_of(difficulty_), place_->name));
  }

 private:
  // The next block, of the next place that the engine does. False if there is none.
  bool draw() {
    for (std::size_t tried = 0; tried < places_.size(); ++tried, ++block_) {
      const Place& place = places_[block_ % places_.size()];
      if (place.setting->is_beyond_engine()) continue;
      place_ = &place;
      next_ = 0;
      queries_ = compare::hard_queries(difficulty_, place.setting->scene(), place.setting->oracle(),
                                       seed_ + block_ / places_.size(), kBlock);
      ++block_;
      return true;
    }
    return false;
  }

  const std::vector<Place>& places_;
  const compare::Difficulty difficulty_;
  const std::uint64_t seed_;
  std::size_t left_, block_ = 0, next_ = 0;
  const Place* place_ = nullptr;
  std::vector<Query> queries_;
};

// The same of flights that begin on an obstacle.
class Flown {
 public:
  Flown(const std::vector<Place>& places, std::uint64_t seed, std::size_t count)
      : places_(places), count_(count) {
    for (const Place& place : places)
      starts_.emplace_back(place.setting->scene(), flights::Kind::surface, seed);
  }

  std::optional<Question> next() {
    for (std::size_t tried = 0; number_ < count_ && tried < places_.size(); ++tried) {
      const std::size_t block = number_ / kBlock, which = block % places_.size();
      if (const Place& place = places_[which]; !place.setting->is_beyond_engine()) {
        Query query;
        starts_[which].draw(block / places_.size() * kBlock + number_ % kBlock, query);
        ++number_;
        return question_of(place, query, "free paths, " + place.name);
      }
      number_ = (block + 1) * kBlock;
    }
    return std::nullopt;
  }

 private:
  const std::vector<Place>& places_;
  const std::size_t count_;
  std::size_t number_ = 0;
  std::vector<flights::FreeStarts> starts_;
};

class Golden {
 public:
  explicit Golden(const std::string& path) : reader_(path) {}

  std::optional<Question> next() {
    golden::ReadRecord read;
    do {
      if (!reader_.next(read)) return std::nullopt;
      if (setting_ && number_ == reader_.scene_number()) continue;
      number_ = reader_.scene_number();
      setting_ = std::make_shared<Setting>(reader_.scene());
    } while (setting_->is_beyond_engine());
    const std::string where = fmt::format("golden {}, {}", reader_.header().name, read.record.id);
    Question question{setting_, {}, std::move(read.record.expect), where, ""};
    if (read.query)
      question.query = *read.query;
    else
      question.text = read.record.question;
    return question;
  }

 private:
  golden::Reader reader_;
  std::size_t number_ = 0;
  std::shared_ptr<Setting> setting_;
};

// For an examiner that is to know what is exact, and asks nobody.
class NoSubject final : public fuzz::Subject {
 public:
  void ask(const Query&) override {}
  std::vector<fuzz::Reply> replies() override { return {}; }

 private:
  void change_scene(const Scene&) override {}
};

class Campaign {
 public:
  Campaign(std::uint64_t seed, const fuzz::Scope& scope, unsigned part, unsigned parts)
      : seed_(seed), scope_(scope), stride_(parts * cases::kCasesPerScene) {
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
  static constexpr std::size_t kTries = 10'000;  // scenes in a row that the scope leaves out

  // A target, how far it is, and what it took: all get equal times, for some take a hundred times as long.
  struct Track {
    const cases::Target* target;
    std::uint64_t next = 0;
    double seconds = 0;
  };

  void make() {
    if (tracks_.empty()) return;
    Track& track = *std::min_element(tracks_.begin(), tracks_.end(), [](const Track& a, const Track& b) {
      return std::tie(a.seconds, a.next) < std::tie(b.seconds, b.next);
    });
    const auto start = std::chrono::steady_clock::now();
    make(*track.target, track.next);
    track.next += stride_;
    track.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // Some cases of a scene of the target's, and the variants of one of them.
  void make(const cases::Target& target, std::uint64_t begin) {
    const cases::Case base = target.make(seed_, begin);
    if (!scope_.admits(base.scene)) return;
    auto setting = std::make_shared<Setting>(base.scene);
    const auto add = [&](const Query& query, const Answer& exact, std::uint64_t index, int step) {
      questions_.push_back(
          {setting, query, exact,
           fmt::format("campaign, {}/{}{}", target.name(), index, step > 0 ? fmt::format(".{}", step) : ""),
           ""});
    };
    for (std::uint64_t index = begin; index < begin + kCases; ++index) {
      const cases::Case one = target.make(seed_, index);
      if (one.scene == base.scene) add(one.query, setting->oracle().first_hit(one.query), index, 0);
    }
    NoSubject nobody;
    const fuzz::Examiner examiner(nobody, base.scene, oracle::kDefaultUlps);
    int step = 0;
    for (const fuzz::Variant& variant :
         fuzz::climb(cases::Random(seed_, target.name(), begin, cases::Use::variants), base, examiner,
                     setting->margins()))
      add(variant.question.query, variant.question.exact, begin, ++step);
  }

  static constexpr std::uint64_t kCases = 16;  // of a scene's

  const std::uint64_t seed_;
  const fuzz::Scope scope_;
  const std::uint64_t stride_;  // from one scene to the next
  std::vector<Track> tracks_;
  std::deque<Question> questions_;
};

// What std::function holds must be copied.
template <class Maker, class... Arguments>
Source source_of(Arguments&&... arguments) {
  auto maker = std::make_shared<Maker>(std::forward<Arguments>(arguments)...);
  return [maker] { return maker->next(); };
}

}  // namespace

Source drawn(const std::vector<Place>& places, compare::Difficulty difficulty, std::uint64_t seed,
             std::size_t count) {
  return source_of<Drawn>(places, difficulty, seed, count);
}

Source flown(const std::vector<Place>& places, std::uint64_t seed, std::size_t count) {
  return source_of<Flown>(places, seed, count);
}

Source golden_set(const std::string& path) {
  return source_of<Golden>(path);
}

Source campaign(std::uint64_t seed, const fuzz::Scope& scope, unsigned part, unsigned parts) {
  return source_of<Campaign>(seed, scope, part, parts);
}

fuzz::Scope scope_of(const std::vector<Place>& places) {
  using Scenes = fuzz::Scope::Scenes;
  bool in_plane = false, in_space = false, mixed = false, skewed = false;
  for (const Place& place : places) {
    if (!place.setting->was_answered()) continue;
    const Scene& scene = place.setting->scene();
    (scene.dimension == 2 ? in_plane : in_space) = true;
    skewed |= !is_unit_scene(scene);
    mixed |= !fuzz::Scope{Scenes::lattice, 0}.admits(scene);
  }
  fuzz::Scope scope;
  if (!in_plane && !in_space) return scope;
  scope.scenes = mixed ? Scenes::any : skewed ? Scenes::lattice : Scenes::unit;
  if (in_plane != in_space) scope.dimension = in_plane ? 2 : 3;
  return scope;
}

}  // namespace lorentz::judge
