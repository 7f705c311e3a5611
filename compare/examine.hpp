// Asks an engine questions, judges its answers as they come, and hands both to who counts, keeps or prints them.
#pragma once

#include <span>

#include "compare/answerer.hpp"
#include "compare/question.hpp"
#include "compare/truth.hpp"

namespace lorentz::compare {

/// What an answer is worth. To an invalid question the right answer is `error`.
oracle::Judgement judgement_of(const Question& question, const Answer& given, double ulps);

/// Is it an answer to be told of: wrong, ill-posed or wrong in time?
bool departs(const oracle::Judgement& judgement);

/// A question that was answered; what `judgement` says is of no meaning if it was not asked.
struct Judged {
  const Question& question;
  const Answer& given;
  Answerer::Origin origin;
  oracle::Judgement judgement;
};
using Sink = std::function<void(const Judged&)>;

/// Asks all questions of the source; returns when all answers have come. Answers are judged in the order of the
/// questions, with the tolerance `ulps`.
void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink);

/// The same in a thread for each of the answerers, which get a stretch of the questions each. The sink is called in
/// the order of the questions, by this thread.
void examine(std::span<const Question> questions, std::span<const std::unique_ptr<Answerer>> answerers,
             double ulps, const Sink& sink);

/// Gives the questions their exact answers, with so many threads.
void answer_exactly(std::span<Question> questions, Truth truth, const Listener& listener = {}, int jobs = 1);

}  // namespace lorentz::compare
