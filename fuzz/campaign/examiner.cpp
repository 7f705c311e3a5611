#include "fuzz/campaign/examiner.hpp"

#include "question/examine.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::fuzz {

using namespace cases;

question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options) {
  return [engine, options](const std::function<bool()>& enough) {
    question::AnswererOptions its = options;
    its.enough = enough;
    its.in_campaign = true;
    return engine.answerer(its);
  };
}

std::vector<Reply> replies_to(const question::Source& source, Answerer& answerer) {
  std::vector<Reply> replies;
  std::vector<std::pair<std::size_t, question::Question>> not_asked;
  question::ask_all(source, answerer, [&](const question::Question& question, Reply& reply) {
    if (!reply.was_asked()) not_asked.emplace_back(replies.size(), question);
    replies.push_back(std::move(reply));
  });
  for (const auto& [i, question] : not_asked) {
    if (answerer.is_hopeless()) break;
    answerer.try_again();
    question::ask_all(question::all_of({&question, 1}), answerer,
                      [&, i = i](const question::Question&, Reply& reply) { replies[i] = std::move(reply); });
    if (!replies[i].was_asked()) break;  // the time is over
  }
  return replies;
}

bool is_tie(const oracle::Judge& judge, const Query& query, const Answer& exact, const Answer& other) {
  if (exact.outcome != other.outcome) return false;
  if (exact.outcome == Outcome::inside)
    return judge.contains(query, exact.obstacle) && judge.contains(query, other.obstacle) &&
           query.from != other.obstacle;
  if (exact.outcome != Outcome::hit || exact.time != other.time) return false;
  return exact.obstacle == other.obstacle || judge.judge(query, exact, other, 0).departs == 0;
}

bool Sought::is_finding(Kind kind) const {
  if (kind == Kind::wrong_time) return times;
  if (kind == Kind::undecided) return undecided;
  return kind == Kind::wrong || kind == Kind::error;
}

// The exact answer to the question in its own words. Nothing if it contradicts the answer that was carried
// over, that is, if it is neither the same nor differs only by a choice that the words make.
std::optional<Answer> Examiner::settled(const Question& question) const {
  Answer exact_here = place_->exact(question.query);
  if (same_answer(exact_here, question.exact) ||
      is_tie(place_->judge(), question.query, exact_here, question.exact))
    return exact_here;
  return std::nullopt;
}

Examined Examiner::examine(const Query& query, LimitAt limit) {
  Question question{.place = place_, .query = query, .exact = place_->exact(query)};
  if (!place_->takes(query, question.exact)) return {Kind::unsupported, {}, question.exact};
  question.max_time = limit_of(limit, question.exact);
  std::vector<Reply> replies = replies_to(question::all_of({&question, 1}), answerer_);
  return judge(question, replies.at(0));
}

Examined Examiner::judge(const Question& question, Reply& reply, bool is_carried) {
  const Outcome said = reply.answer.outcome;
  if (!is_carried || said == Outcome::undecided || said == Outcome::error ||
      same_answer(reply.answer, question.exact))
    return judge_exact(question, reply);
  Question own = question;
  if (auto exact_here = settled(question)) {
    own.exact = std::move(*exact_here);
    return judge_exact(own, reply);
  }
  return {.kind = Kind::error, .given = question.exact, .exact = place_->exact(question.query)};
}

Examined Examiner::judge_exact(const Question& question, Reply& reply) {
  // By Verdict. The times of right answers may still be wrong.
  constexpr Kind kKindOf[] = {Kind::agree,       Kind::agree, Kind::wrong, Kind::undecided,
                              Kind::unsupported, Kind::error, Kind::error};
  static_assert(std::size(kKindOf) == static_cast<std::size_t>(oracle::Verdict::missing) + 1);
  const oracle::Judgement judgement =
      question::judgement_of(question, reply.answer, ulps_, question::AtLimit::exact);
  const bool says = reply.answer.outcome != Outcome::undecided && reply.answer.outcome != Outcome::error;
  Examined one;
  one.departs = judgement.departs;
  one.stage = reply.stage;
  one.exact = says && question.has_limit() && is_later(question) ? Answer::later() : question.exact;
  one.given = std::move(reply.answer);
  one.kind = kKindOf[static_cast<int>(judgement.verdict)];
  if (one.kind == Kind::agree && judgement.wrong_time) one.kind = Kind::wrong_time;
  return one;
}

}  // namespace lorentz::fuzz
