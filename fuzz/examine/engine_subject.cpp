// Engines as the subjects of campaigns.
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <lorentz/certified.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/walk.hpp>
#include "compare/answerer.hpp"
#include "compare/engines.hpp"
#include "fuzz/examine/batch_subject.hpp"
#include "fuzz/examine/engine_subject.hpp"
#include "src/engines/published/published.hpp"

namespace lorentz::fuzz {

using namespace compare;

namespace {

// Any answerer. Another program gets many queries before its answers are waited for. Those that it was not
// asked, for it had been given up, it is asked again one at a time: it is no error of a query that it was not
// asked.
class AnswererSubject final : public Subject {
 public:
  AnswererSubject(const EngineInfo& engine, const AnswererOptions& options)
      : answerer_(engine.answerer(options)), is_command_(engine.is_command()) {
    answerer_->on_answer([this](Answer& answer) {
      if (answerer_->origin() == Answerer::Origin::not_asked) not_asked_.push_back(replies_.size());
      replies_.push_back({answer});
    });
  }

  void ask(const Query& query) override {
    asked_.emplace_back(scene_, query);
    answerer_->ask("null", query);
  }
  std::vector<Reply> replies() override {
    answerer_->drain();
    const Asked asked = std::exchange(asked_, {});
    for (const std::size_t i : std::exchange(not_asked_, {})) ask_again(asked[i], i);
    return std::exchange(replies_, {});
  }
  std::uint64_t batch_size() const override { return is_command_ ? 256 : Subject::batch_size(); }
  bool failed() const override { return answerer_->failed(); }

 private:
  void change_scene(const Scene& scene) override {
    scene_ = std::make_shared<const Scene>(scene);
    answerer_->set_scene(scene);
  }

  using Asked = std::vector<std::pair<std::shared_ptr<const Scene>, Query>>;

  void ask_again(const Asked::value_type& question, std::size_t i) {
    if (answerer_->is_hopeless()) return;
    answerer_->try_again();
    answerer_->set_scene(*question.first);
    answerer_->ask("null", question.second);
    answerer_->drain();
    replies_[i] = std::move(replies_.back());
    replies_.pop_back();
    answerer_->set_scene(*scene_);
  }

  std::unique_ptr<Answerer> answerer_;
  bool is_command_;
  std::shared_ptr<const Scene> scene_;
  Asked asked_;                         // a reply to each is due
  std::vector<std::size_t> not_asked_;  // of these, by number
  std::vector<Reply> replies_;
};

// The second oracle, cell by cell. What takes it more cells than this it leaves undecided: a flight of its
// usual 10^5 takes seconds, in which it could answer thousands of others.
class WalkSubject final : public Subject {
 public:
  void ask(const Query& query) override { replies_.push_back({walk_->first_hit(query), {}}); }
  bool takes_limits() const override { return true; }
  void ask_until(const Query& query, double max_time) override {
    replies_.push_back({walk_->first_hit(query, max_time), {}});
  }
  std::vector<Reply> replies() override { return std::exchange(replies_, {}); }

 private:
  static constexpr std::int64_t kCells = 200;
  void change_scene(const Scene& scene) override { walk_.emplace(scene, kCells); }

  std::optional<oracle::Walk> walk_;
  std::vector<Reply> replies_;
};

// Cell to cell, too: up to a time in which the flight passes about this many cells, for the same reason.
class ClassicalSubject final : public Subject {
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

// An engine that says more about an answer than the answer. Engines of this kind are made from a scene, and
// know why a scene is beyond them.
template <class E>
class TellingSubject : public Subject {
 public:
  void ask(const Query& query) final { ask_until(query, std::numeric_limits<double>::infinity()); }
  void ask_until(const Query& query, double max_time) final {
    replies_.push_back(why_not_ ? Reply{Answer::unsupported_because(*why_not_)} : reply_to(query, max_time));
  }
  std::vector<Reply> replies() final { return std::exchange(replies_, {}); }

 protected:
  const E& engine() const { return *engine_; }

 private:
  virtual Reply reply_to(const Query& query, double max_time) const = 0;

  void change_scene(const Scene& scene) final {
    if constexpr (requires { E::beyond(scene); }) why_not_ = E::beyond(scene);
    if (!why_not_) engine_.emplace(scene);
  }

  std::optional<E> engine_;
  std::optional<std::string> why_not_;
  std::vector<Reply> replies_;
};

// Counts its passes: how much work an answer was.
class PublishedSubject final : public TellingSubject<Published> {
  Reply reply_to(const Query& query, double max_time) const override {
    Proposals proposals;
    Answer answer = engine().first_hit_counted(query, max_time, proposals);
    return {std::move(answer), static_cast<double>(proposals.passes)};
  }
};

Flight fly_prepared(const Reduction& engine, const Query& query, double max_time) {
  return engine.fly(engine.direction(query.v), query.x, query.from ? &*query.from : nullptr, max_time);
}

class ReductionSubject final : public TellingSubject<Reduction> {
 public:
  explicit ReductionSubject(FlyPrepared prepared) : prepared_(std::move(prepared)) {}
  bool takes_limits() const override { return true; }

 private:
  Reply reply_to(const Query& query, double max_time) const override {
    const Flight flight = engine().fly(query, max_time);
    const Answer answer = answer_of(flight);
    const Answer prepared = answer_of(prepared_(engine(), query, max_time));
    if (prepared.outcome != answer.outcome || !(prepared.obstacle == answer.obstacle) ||
        prepared.time != answer.time)
      return {Answer::error("a prepared direction gives another answer"), {}, flight.stage};
    return {answer, {}, flight.stage};
  }

  FlyPrepared prepared_;
};

class CertifiedSubject final : public TellingSubject<oracle::Certified> {
 public:
  bool takes_limits() const override { return true; }

 private:
  Reply reply_to(const Query& query, double max_time) const override {
    StageTally tally;
    oracle::Request request;
    if (std::isfinite(max_time)) request.max_time = max_time;
    Answer answer = engine().first_hit(query, request, &tally);
    const Stage stage = tally.binary64        ? Stage::binary64
                        : tally.double_double ? Stage::double_double
                                              : Stage::undecided;
    return {std::move(answer), {}, stage};
  }
};

std::unique_ptr<Subject> make_reduction() {
  return make_reduction_subject();
}
std::unique_ptr<Subject> make_batch() {
  return make_batch_subject();
}

template <class S>
std::unique_ptr<Subject> make() {
  return std::make_unique<S>();
}

// The engines that are asked in a way of their own.
constexpr struct {
  std::string_view engine;
  std::unique_ptr<Subject> (*make)();
} kSubjects[] = {
    {"classical", make<ClassicalSubject>},
    {"published", make<PublishedSubject>},
    {"reduction", make_reduction},
    {"certified", make<CertifiedSubject>},
    {"batch", make_batch},
    {"certified-batch", make_certified_batch_subject},
    {"walk", make<WalkSubject>},
};

}  // namespace

std::unique_ptr<Subject> make_reduction_subject(FlyPrepared prepared) {
  return std::make_unique<ReductionSubject>(prepared ? std::move(prepared) : fly_prepared);
}

MakeSubject subject_maker(const EngineInfo& engine, const AnswererOptions& options) {
  for (const auto& subject : kSubjects)
    if (subject.engine == engine.name) return subject.make;
  return [engine, options] { return std::make_unique<AnswererSubject>(engine, options); };
}

}  // namespace lorentz::fuzz
