// Engines as the subjects of campaigns.
#include "answerer.hpp"
#include "escalate.hpp"
#include "fuzz.hpp"
#include "published.hpp"
#include "reduction.hpp"
#include "registry.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Reply;

// Whoever answers. Another program gets many queries before its answers are waited for.
class AnswererSubject final : public fuzz::Subject {
 public:
  AnswererSubject(const std::string& engine, double timeout)
      : answerer_(make_answerer(engine, {{}, timeout})), is_command_(is_command(engine)) {
    answerer_->on_answer([this](Answer& answer) { replies_.push_back({answer}); });
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

// An engine that says more about an answer than the answer. Engines of this kind are made from a scene, and
// know why a scene is beyond them.
template <class E>
class TellingSubject : public fuzz::Subject {
 public:
  void ask(const Query& query) final {
    replies_.push_back(why_not_ ? Reply{Answer::unsupported_because(*why_not_)} : reply_to(query));
  }
  std::vector<Reply> replies() final { return std::exchange(replies_, {}); }

 protected:
  const E& engine() const { return *engine_; }

 private:
  virtual Reply reply_to(const Query& query) const = 0;

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
  Reply reply_to(const Query& query) const override {
    Proposals proposals;
    Answer answer = engine().first_hit_counted(query, std::numeric_limits<double>::infinity(), proposals);
    return {std::move(answer), static_cast<double>(proposals.passes)};
  }
};

class ReductionSubject final : public TellingSubject<Reduction> {
  Reply reply_to(const Query& query) const override {
    const Flight flight = engine().fly(query);
    return {answer_of(flight), {}, flight.stage};
  }
};

class CertifiedSubject final : public TellingSubject<oracle::Certified> {
  Reply reply_to(const Query& query) const override {
    StageTally tally;
    Answer answer = engine().first_hit(query, {}, &tally);
    const Stage stage = tally.binary64        ? Stage::binary64
                        : tally.double_double ? Stage::double_double
                                              : Stage::undecided;
    return {std::move(answer), {}, stage};
  }
};

template <class S>
fuzz::MakeSubject maker_of() {
  return [] { return std::make_unique<S>(); };
}

}  // namespace

fuzz::MakeSubject subject_maker(const std::string& engine, double timeout) {
  check_name(engine);
  if (engine == "published") return maker_of<PublishedSubject>();
  if (engine == "reduction") return maker_of<ReductionSubject>();
  if (engine == "certified") return maker_of<CertifiedSubject>();
  return [engine, timeout] { return std::make_unique<AnswererSubject>(engine, timeout); };
}

}  // namespace lorentz::cli
