// An engine of this program, asked by columns: the batch engines fly rows together, the others one by one.
#pragma once

#include <optional>
#include <vector>

#include "question/engines.hpp"
#include "question/many_flights.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::question {

class ColumnEngine {
 public:
  /// `engine` must be one of this program. `max_time` is an upper bound for the limits of all rows. `jobs`:
  /// the number of threads, for the batch engines.
  ColumnEngine(const EngineInfo& engine, const Scene& scene, std::optional<double> max_time, int jobs);

  /// Gives the same answers as the engine's answerer; invalid rows are answered with errors.
  void answer(const QueryRows& queries, AnswerRows& answers);

  /// The same into the rows from `first` on, which must exist; for answers that are filled part by part.
  void answer_from(std::size_t first, const QueryRows& queries, AnswerRows& answers);

 private:
  void set_limits(const QueryRows& queries);
  double limit(std::size_t i) const;
  void fly(std::size_t first, const QueryRows& queries, AnswerRows& answers);
  void finish(std::size_t first, const QueryRows& queries, std::size_t i, AnswerRows& answers);
  void ask(std::size_t first, const QueryRows& queries, std::size_t i, std::uint8_t stage,
           AnswerRows& answers);

  const Scene scene_;
  const Traits traits_;
  const std::optional<double> max_time_;
  const int jobs_;
  std::optional<ManyFlights> together_;  // nothing: rows are asked one by one
  const FirstHit single_;

  std::vector<double> limits_;  // empty: no row has one
  std::vector<Stage> stages_;
  std::vector<std::size_t> uncertain_;
  Answer answer_;
};

}  // namespace lorentz::question
