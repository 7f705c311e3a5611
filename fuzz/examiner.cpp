#include "examiner.hpp"

#include <algorithm>

#include "escalate.hpp"
#include "oracle.hpp"
#include "parts.hpp"
#include "scene_check.hpp"

namespace lorentz::fuzz {

std::string_view name_of(Kind kind) {
  constexpr std::string_view kNames[] = {"fine",      "unsupported", "wrong", "wrong time",
                                         "undecided", "slow",        "error"};
  return kNames[static_cast<int>(kind)];
}

bool Counts::is_finding(Kind kind) const {
  switch (kind) {
    case Kind::wrong:
    case Kind::slow:
    case Kind::error:
      return true;
    case Kind::wrong_time:
      return times;
    case Kind::undecided:
      return undecided;
    default:
      return false;
  }
}

struct Examiner::Impl {
  Subject& subject;
  Scene scene;
  double ulps;
  std::optional<oracle::Oracle> oracle;
  std::optional<oracle::Certified> certified;
  std::optional<oracle::Judge> judge;
  std::optional<double> slow_from;

  Impl(Subject& subject, const Scene& scene, double ulps, Truth truth)
      : subject(subject), scene(scene), ulps(ulps) {
    truth == Truth::oracle ? void(oracle.emplace(scene)) : void(certified.emplace(scene));
  }

  // Answers that are the same need no judge, which most scenes therefore never get.
  oracle::Judgement judgement(const Question& question, const Answer& given) {
    const Answer& exact = question.exact;
    if (given.outcome == exact.outcome && given.outcome == Outcome::hit && given.time == exact.time &&
        given.obstacle == exact.obstacle)
      return {oracle::Verdict::agree};
    if (!judge) judge.emplace(scene);
    return judge->judge(question.query, exact, given, ulps);
  }
};

Examiner::Examiner(Subject& subject, const Scene& scene, double ulps, Truth truth)
    : impl_(std::make_unique<Impl>(subject, scene, ulps, truth)) {}
Examiner::~Examiner() = default;

const Scene& Examiner::scene() const {
  return impl_->scene;
}

Answer Examiner::exact(const Query& query) const {
  return impl_->oracle ? impl_->oracle->first_hit(query) : impl_->certified->first_hit(query);
}

void Examiner::ask(const Question& question) {
  impl_->subject.set_scene(impl_->scene);
  impl_->subject.ask(question.query);
}

Examined Examiner::examine(const Query& query) {
  const Question question{query, exact(query)};
  ask(question);
  std::vector<Reply> replies = impl_->subject.replies();
  return judge(question, replies.at(0));
}

Examined Examiner::judge(const Question& question, Reply& reply) {
  Examined one;
  const oracle::Judgement judgement = impl_->judgement(question, reply.answer);
  one.departs = judgement.departs;
  one.work = reply.work;
  one.stage = reply.stage;
  one.exact = question.exact;
  one.given = std::move(reply.answer);
  const auto too_slow = [&] { return one.work && is_slow(*one.work); };
  switch (judgement.verdict) {
    case oracle::Verdict::wrong:
      one.kind = !judgement.wrong_time ? Kind::wrong : too_slow() ? Kind::slow : Kind::wrong_time;
      break;
    case oracle::Verdict::undecided:
      one.kind = Kind::undecided;
      break;
    case oracle::Verdict::unsupported:
      one.kind = Kind::unsupported;
      break;
    case oracle::Verdict::error:
    case oracle::Verdict::missing:
      one.kind = Kind::error;
      break;
    case oracle::Verdict::ill_posed:
      if (impl_->ulps == 0) {  // a tie decided the wrong way needs no change of the inputs
        one.kind = Kind::wrong;
        break;
      }
      [[fallthrough]];
    case oracle::Verdict::agree:
      one.kind = too_slow() ? Kind::slow : Kind::fine;
  }
  return one;
}

// The median is of the scene alone, so that who else is examined does not matter. It is asked for only where
// there is much work.
bool Examiner::is_slow(double work) {
  if (work < kLeastWork) return false;
  if (!impl_->slow_from) {
    impl_->subject.set_scene(impl_->scene);
    for (int i = 0; i < kDrawnFlights; ++i) {
      Random random(0, "drawn flights", static_cast<std::uint64_t>(i));
      const Vec x = point_in_cell(random, impl_->scene), v = random.direction(impl_->scene.dimension);
      impl_->subject.ask({x, v, {}});
    }
    std::vector<double> works;
    for (const Reply& reply : impl_->subject.replies())
      if (reply.work) works.push_back(*reply.work);
    if (works.size() < kDrawnFlights) works.resize(kDrawnFlights, works.empty() ? work : works.back());
    std::nth_element(works.begin(), works.begin() + kDrawnFlights / 2, works.end());
    impl_->slow_from = kSlowFactor * works[kDrawnFlights / 2];
  }
  return work > *impl_->slow_from;
}

bool is_sound(const Scene& scene) {
  return !flaw_of(scene) && !oracle::dependence_in(scene);
}

}  // namespace lorentz::fuzz
