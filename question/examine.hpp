// Asks an engine questions, judges the answers as they come, and passes both to a sink.
#pragma once

#include <span>

#include "question/answerer.hpp"
#include "question/question.hpp"

namespace lorentz::question {

/// Asks all questions of the source, waits for the replies, and passes each reply on with its question, in
/// the order of the questions.
void ask_all(const Source& source, Answerer& answerer,
             const std::function<void(const Question&, Reply&)>& take);

/// Judges an answer with the tolerance `ulps`. An invalid question must be answered with `error`. No answer
/// is ill-posed at the question's limit, because an engine that is asked with a limit knows its times.
oracle::Judgement judgement_of(const Question& question, const Answer& given, double ulps);

/// True if nothing is entered before the question's limit.
bool is_later(const Question& question);

/// True if the answer is wrong, ill-posed or wrong in time.
bool departs(const oracle::Judgement& judgement);

/// A question and the reply to it. `judgement` is `missing` if the question was not asked.
struct Judged {
  const Question& question;
  const Reply& reply;
  oracle::Judgement judgement;
};
using Sink = std::function<void(const Judged&)>;

/// Asks all questions of the source and judges the replies. The sink gets them in the order of the questions.
void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink);

/// The same with one thread per answerer; each is asked one stretch of the questions. The calling thread
/// calls the sink, in the order of the questions.
void examine(std::span<const Question> questions, std::span<const std::unique_ptr<Answerer>> answerers,
             double ulps, const Sink& sink);

/// Sets the exact answer of each question, on `jobs` threads.
void answer_exactly(std::span<Question> questions, Truth truth, const Listener& listener = {}, int jobs = 1);

}  // namespace lorentz::question
