// Asks an engine questions, judges the answers as they come, and passes both to a sink.
#pragma once

#include <span>

#include "question/answerer.hpp"
#include "question/question.hpp"

namespace lorentz::question {

/// Asks an answerer, in the scene that was set, with the question's limit if it has one.
void ask(Answerer& answerer, const Question& question);

/// Asks all questions of the source, waits for the replies, and passes each reply on with its question, in
/// the order of the questions.
void ask_all(const Source& source, Answerer& answerer,
             const std::function<void(const Question&, Reply&)>& take);

/// How a hit at the question's limit is judged.
enum class AtLimit {
  excused,  ///< a hit beyond the limit is as right as it is without a limit, and `later` is ill-posed if the limit is
            ///< within the tolerance of the hit's time
  exact  ///< `later` is right if and only if nothing is entered before the limit, and nothing else is right then
};

/// Judges an answer with the tolerance `ulps`. An invalid question must be answered with `error`.
oracle::Judgement judgement_of(const Question& question, const Answer& given, double ulps,
                               AtLimit at_limit = AtLimit::excused);

/// The same of a reply: `missing` without an answer, because the question was not asked or an external engine
/// failed on it.
oracle::Judgement judgement_of(const Question& question, const Reply& reply, double ulps);

/// True if nothing is entered before the question's limit.
bool is_later(const Question& question);

/// True if the answer is wrong, ill-posed or wrong in time.
bool departs(const oracle::Judgement& judgement);

/// A question and the reply to it, judged.
struct Judged {
  const Question& question;
  const Reply& reply;
  oracle::Judgement judgement;
};
using Sink = std::function<void(const Judged&)>;

/// Asks all questions of the source and judges the replies. The sink gets them in the order of the questions.
void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink);

/// Cuts [0, count) into one stretch per job and calls act(job, begin, end) for each in a thread of its own.
void in_stretches(std::size_t count, std::size_t jobs,
                  const std::function<void(std::size_t job, std::size_t begin, std::size_t end)>& act);

/// Sets the exact answer of each question, on `jobs` threads.
void answer_exactly(std::span<Question> questions, const Listener& listener = {}, int jobs = 1);

}  // namespace lorentz::question
