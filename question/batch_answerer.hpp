// The batch engines as answerers: they gather queries and fly them together.
#pragma once

#include <optional>
#include <vector>

#include "question/answerer.hpp"
#include "question/many_flights.hpp"

namespace lorentz::question {

class BatchAnswerer : public Answerer {
 public:
  /// `certified`: the engine `certified-batch`, else `batch`.
  BatchAnswerer(bool certified, const AnswererOptions& options);

  void ask(const Id& id, const Query& query) final;
  void ask_until(const Id& id, const Query& query, double max_time) final;
  bool takes_limits() const final { return true; }
  std::uint64_t batch_size() const final { return 100; }  // several full vectors, and some lanes of one more
  void drain() final;

 protected:
  /// Flies all gathered queries.
  virtual void fly();
  /// The reply to gathered query i, if it is certain.
  virtual Reply reply_to(std::size_t i) const;

  /// Null for a scene beyond the engine.
  const Batch* batch() const { return engine_ ? engine_->batch() : nullptr; }
  const QueryTable& queries() const { return queries_; }
  Flight flight(std::size_t i) const { return flights_[i]; }
  double limit(std::size_t i) const;

 private:
  void enter(const Scene& scene) final;
  Reply single(const Query& query, double max_time) const;

  const bool certified_;
  const oracle::Request request_;
  const int jobs_;
  std::optional<std::string> why_not_;  ///< the scene is beyond the engine
  std::optional<ManyFlights> engine_;   ///< nothing in that case
  QueryTable queries_;
  FlightTable flights_;
  std::vector<std::size_t> uncertain_;
};

}  // namespace lorentz::question
