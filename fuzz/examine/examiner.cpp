#include "fuzz/examine/examiner.hpp"

#include <algorithm>

#include <lorentz/certified.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/scene_check.hpp>
#include "cases/free_start.hpp"
#include "fuzz/examine/tie.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::fuzz {

using namespace cases;

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
  Truth truth;
  std::optional<oracle::Oracle> oracle;
  std::optional<oracle::Certified> certified;
  std::optional<oracle::Judge> judge;
  std::optional<double> slow_from;

  Impl(Subject& subject, const Scene& scene, double ulps, Truth truth)
      : subject(subject), scene(scene), ulps(ulps), truth(truth) {}

  // Made when it is first asked: where the answers are known from elsewhere it never is.
  Answer exact(const Query& query, const oracle::Request& request = {}) {
    if (truth == Truth::oracle) {
      if (!oracle) oracle.emplace(scene);
      return oracle->first_hit(query, request);
    }
    if (!certified) certified.emplace(scene);
    return certified->first_hit(query, request);
  }

  const oracle::Judge& the_judge() {
    if (!judge) judge.emplace(scene);
    return *judge;
  }

  // What the question's answer is in its own words. Nothing if that contradicts what was carried over:
  // neither the same, nor the same but for a choice that the words make.
  std::optional<Answer> settled(const Question& question) {
    Answer exact_here = exact(question.query);
    if (same_answer(exact_here, question.exact) ||
        is_tie(scene, the_judge(), question.query, exact_here, question.exact))
      return exact_here;
    return std::nullopt;
  }

  // Whether there is nothing before the limit.
  bool is_later(const Question& question, double limit) {
    const Answer& exact_answer = question.exact;
    if (exact_answer.outcome != Outcome::hit) return exact_answer.outcome == Outcome::never;
    // The exact time lies between the neighbours of the rounded one.
    if (*exact_answer.time != limit) return limit < *exact_answer.time;
    oracle::Request request;
    request.max_time = limit;
    return exact(question.query, request).outcome == Outcome::later;
  }

  // Answers that are the same need no judge, which most scenes therefore never get.
  oracle::Judgement judgement(const Question& question, const Answer& given) {
    const Answer& exact = question.exact;
    if (given.outcome == exact.outcome && given.outcome == Outcome::hit && same_answer(given, exact))
      return {oracle::Verdict::agree};
    return the_judge().judge(question.query, exact, given, ulps);
  }
};

Examiner::Examiner(Subject& subject, const Scene& scene, double ulps, Truth truth)
    : impl_(std::make_unique<Impl>(subject, scene, ulps, truth)) {}
Examiner::~Examiner() = default;

const Scene& Examiner::scene() const {
  return impl_->scene;
}

Answer Examiner::exact(const Query& query) const {
  return impl_->exact(query);
}

void Examiner::ask(const Question& question) {
  impl_->subject.set_scene(impl_->scene);
  if (question.limit == LimitAt::none)
    impl_->subject.ask(question.query);
  else
    impl_->subject.ask_until(question.query, limit_of(question.limit, question.exact));
}

Examined Examiner::examine(const Query& query, LimitAt limit) {
  const Question question{query, exact(query), false, limit};
  ask(question);
  std::vector<Reply> replies = impl_->subject.replies();
  return judge(question, replies.at(0));
}

// Where the reply is not what was carried over, the truth is asked for in the question's own words.
Examined Examiner::judge(const Question& question, Reply& reply) {
  const auto judged = [&](const Question& asked) {
    return asked.limit == LimitAt::none ? judge_unlimited(asked, reply) : judge_limited(asked, reply);
  };
  const bool in_doubt = question.is_carried && reply.answer.outcome != Outcome::undecided &&
                        reply.answer.outcome != Outcome::error && !same_answer(reply.answer, question.exact);
  if (!in_doubt) return judged(question);
  if (auto exact_here = impl_->settled(question))
    return judged({question.query, std::move(*exact_here), false, question.limit});
  Examined contradiction;
  contradiction.kind = Kind::error;
  contradiction.given = question.exact;
  contradiction.exact = exact(question.query);
  return contradiction;
}

// At a limit nothing is ill-posed: an engine that is asked with one knows its times.
Examined Examiner::judge_limited(const Question& question, Reply& reply) {
  const Answer& given = reply.answer;
  const bool says_later = given.outcome == Outcome::later || given.outcome == Outcome::never;
  const bool says_something = given.outcome == Outcome::hit || given.outcome == Outcome::inside;
  const bool is_later = impl_->is_later(question, limit_of(question.limit, question.exact));
  if (!says_later && !(says_something && is_later)) return judge_unlimited(question, reply);
  Examined one;
  one.kind = says_later == is_later ? Kind::fine : Kind::wrong;
  one.work = reply.work;
  one.stage = reply.stage;
  one.exact = is_later ? Answer::later() : question.exact;
  one.given = std::move(reply.answer);
  return one;
}

Examined Examiner::judge_unlimited(const Question& question, Reply& reply) {
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
      one.kind = Kind::wrong;
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
    case oracle::Verdict::agree:
      one.kind = too_slow() ? Kind::slow : judgement.wrong_time ? Kind::wrong_time : Kind::fine;
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
