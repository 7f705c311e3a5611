#include "question/examination.hpp"

#include <algorithm>
#include <chrono>

#include "question/engines.hpp"

namespace lorentz::question {
namespace {

using oracle::Judgement;

// Asks one answerer and waits for its replies.
std::vector<Reply> replies_of(std::span<const Question> questions, Answerer& answerer) {
  std::vector<Reply> replies;
  ask_all(all_of(questions), answerer,
          [&](const Question&, Reply& reply) { replies.push_back(std::move(reply)); });
  return replies;
}

}  // namespace

void ExaminedRow::count(const Judged& judged) {
  tally.count(judged.judgement);
  for (const std::string& tag : judged.question.tags) by_tag[tag].count(judged.judgement);
}

void ExaminedRow::add(const ExaminedRow& other) {
  tally.add(other.tally);
  for (const auto& [tag, its] : other.by_tag) by_tag[tag].add(its);
  if (other.max_radii) max_radii = std::max(max_radii.value_or(0), *other.max_radii);
  not_asked += other.not_asked;
  seconds += other.seconds;
  scenes_given_up += other.scenes_given_up;
  if (last_failure.empty()) last_failure = other.last_failure;
}

Examination::Examination(const EngineInfo& engine, const AnswererOptions& options, double ulps,
                         std::size_t jobs)
    : name_(engine.name), ulps_(ulps) {
  for (std::size_t job = 0; job < (engine.is_own() ? jobs : 1); ++job)
    answerers_.push_back(engine.answerer(options));
}

Examination::Examination(std::string name, std::unique_ptr<Answerer> answerer, double ulps)
    : name_(std::move(name)), ulps_(ulps) {
  answerers_.push_back(std::move(answerer));
}

ExaminedRow& Examination::add(ExaminedRow row) {
  row.tally.name = row.name;
  return rows_.emplace_back(std::move(row));
}

Tally Examination::total() const {
  Tally total;
  for (const ExaminedRow& row : rows_) total.add(row.tally);
  total.name = name_;
  return total;
}

double Examination::ask(std::span<const Question> questions, const Sink& sink) {
  const auto judged = [this](const Question& question, const Reply& reply) {
    return judgement_of(question, reply, ulps_);
  };
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  if (answerers_.size() == 1) {
    const std::vector<Reply> replies = replies_of(questions, answerer());
    const double took = seconds();
    for (std::size_t i = 0; i < replies.size(); ++i)
      sink({questions[i], replies[i], judged(questions[i], replies[i])});
    return took;
  }
  for (const Question& question : questions)
    question.place->judge();  // made here, because threads may only read it
  std::vector<Reply> replies(questions.size());
  std::vector<Judgement> judgements(questions.size());
  in_stretches(questions.size(), answerers_.size(), [&](std::size_t job, std::size_t begin, std::size_t end) {
    std::ranges::move(replies_of(questions.subspan(begin, end - begin), *answerers_[job]),
                      replies.begin() + static_cast<std::ptrdiff_t>(begin));
    for (std::size_t i = begin; i < end; ++i) judgements[i] = judged(questions[i], replies[i]);
  });
  for (std::size_t i = 0; i < questions.size(); ++i) sink({questions[i], replies[i], judgements[i]});
  return seconds();
}

void Examination::finish() {
  for (const auto& answerer : answerers_) answerer->finish();
}

}  // namespace lorentz::question
