// Asks an engine questions, judges the answers as they come, and passes both to a sink.
#pragma once

#include <span>

#include "compare/answerer.hpp"
#include "compare/question.hpp"
#include "compare/truth.hpp"

namespace lorentz::compare {

/// Judges an answer with the tolerance `ulps`. The right answer to an invalid question is `error`.
oracle::Judgement judgement_of(const Question& question, const Answer& given, double ulps);

/// True if the answer is wrong, ill-posed or wrong in time.
bool departs(const oracle::Judgement& judgement);

/// A question and the answer to it. `judgement` is `missing` if the question was not asked.
struct Judged {
  const Question& question;
  const Answer& given;
  Answerer::Origin origin;
  oracle::Judgement judgement;
};
using Sink = std::function<void(const Judged&)>;

/// Asks all questions of the source and waits for the answers. The sink gets them in the order of the questions.
void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink);

/// The same with one thread per answerer, each of which is asked one stretch of the questions. This thread calls the
/// sink, in the order of the questions.
void examine(std::span<const Question> questions, std::span<const std::unique_ptr<Answerer>> answerers,
             double ulps, const Sink& sink);

/// Sets the exact answer of each question, on `jobs` threads.
void answer_exactly(std::span<Question> questions, Truth truth, const Listener& listener = {}, int jobs = 1);

}  // namespace lorentz::compare
