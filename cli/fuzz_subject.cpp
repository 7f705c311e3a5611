// Engines as the subjects of campaigns.
#include <cmath>

#include "answerer.hpp"
#include "engine.hpp"
#include "fuzz.hpp"
#include "published.hpp"
#include "reduction.hpp"
#include "registry.hpp"
#include "walk.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Reply;

// Whoever answers. Another program gets many queries before its answers are waited for.
class AnswererSubject final : public fuzz::Subject {
 public:
  AnswererSubject(const std::string& engine, double timeout)
      : answerer_(make_answerer(engine, {{}, timeout})), is_command_(is_command(engine)) {
    answerer_->on_answer([this](Answer& answer) { replies_.push_back({answer, {}}); });
  }

  void ask(const Query& query) override { answerer_->ask("null", query); }
  std::vector<Reply> replies() override {
    answerer_->drain();
    return std::exchange(replies_, {});
  }
  std::uint64_t batch() const override { return is_command_ ? 256 : Subject::batch(); }
  bool failed() const override { return answerer_->failed(); }

 private:
  void change_scene(const Scene& scene) override { answerer_->set_scene(scene); }

  std::unique_ptr<Answerer> answerer_;
  bool is_command_;
  std::vector<Reply> replies_;
};

// The second oracle, cell by cell. What takes it more cells than this it leaves undecided: a flight of its
// usual 10^5 takes seconds, in which it could answer thousands of others.
class WalkSubject final : public fuzz::Subject {
 public:
  void ask(const Query& query) override { replies_.push_back({walk_->first_hit(query), {}}); }
  std::vector<Reply> replies() override { return std::exchange(replies_, {}); }

 private:
  static constexpr std::int64_t kCells = 200;
  void change_scene(const Scene& scene) override { walk_.emplace(scene, kCells); }

  std::optional<oracle::Walk> walk_;
  std::vector<Reply> replies_;
};

// Cell to cell, too: up to a time in which the flight passes about this many cells, for the same reason.
class ClassicalSubject final : public fuzz::Subject {
 public:
  void ask(const Query& query) override {
    const Vec &u = scene_->lattices[0].vectors[0], &v = query.v;
    const double cells = std::hypot(u[0], u[1], u[2]) / std::hypot(v[0], v[1], v[2]);
    replies_.push_back({engine_->first_hit(query, kCells * cells), {}});
  }
  std::vector<Reply> replies() override { return std::exchange(replies_, {}); }

 private:
  static constexpr double kCells = 10'000;
  void change_scene(const Scene& scene) override {
    scene_ = scene;
    engine_ = make_engine("classical", scene);
  }

  std::optional<Scene> scene_;
  std::unique_ptr<Engine> engine_;
  std::vector<Reply> replies_;
};

// Both ways that it flies: at once, and along a direction prepared for many starts. The two must not
// contradict each other.
class ReductionSubject final : public fuzz::Subject {
 public:
  void ask(const Query& query) override {
    Answer answer;
    engine_->first_hit(query, std::numeric_limits<double>::infinity(), answer);
    if (const auto* reduction = dynamic_cast<const Reduction*>(engine_.get())) {
      const ObstacleId* from = query.from ? &*query.from : nullptr;
      const Answer prepared = answer_of(reduction->fly(reduction->direction(query.v), query.x, from));
      if (answer.outcome == Outcome::undecided)
        answer = prepared;  // another basis may know
      else if (prepared.outcome != Outcome::undecided &&
               (prepared.outcome != answer.outcome || !(prepared.obstacle == answer.obstacle)))
        answer = Answer::error("a prepared direction gives another answer");
    }
    replies_.push_back({std::move(answer), {}});
  }
  std::vector<Reply> replies() override { return std::exchange(replies_, {}); }

 private:
  void change_scene(const Scene& scene) override { engine_ = make_engine("reduction", scene); }

  std::unique_ptr<Engine> engine_;
  std::vector<Reply> replies_;
};

// `published` counts its passes: how much work an answer was.
class PublishedSubject final : public fuzz::Subject {
 public:
  void ask(const Query& query) override {
    if (why_not_) {
      replies_.push_back({Answer::unsupported_because(*why_not_), {}});
      return;
    }
    Proposals proposals;
    Answer answer = engine_->first_hit_counted(query, std::numeric_limits<double>::infinity(), proposals);
    replies_.push_back({std::move(answer), static_cast<double>(proposals.passes)});
  }
  std::vector<Reply> replies() override { return std::exchange(replies_, {}); }

 private:
  void change_scene(const Scene& scene) override {
    why_not_ = Published::beyond(scene);
    if (!why_not_) engine_.emplace(scene);
  }

  std::optional<Published> engine_;
  std::optional<std::string> why_not_;
  std::vector<Reply> replies_;
};

}  // namespace

fuzz::MakeSubject subject_maker(const std::string& engine, double timeout) {
  check_name(engine);
  if (engine == "published") return [] { return std::make_unique<PublishedSubject>(); };
  if (engine == "classical") return [] { return std::make_unique<ClassicalSubject>(); };
  if (engine == "reduction") return [] { return std::make_unique<ReductionSubject>(); };
  if (engine == "walk") return [] { return std::make_unique<WalkSubject>(); };
  return [engine, timeout] { return std::make_unique<AnswererSubject>(engine, timeout); };
}

}  // namespace lorentz::cli
