// One block of flights after the other: draws the starts, flies them, counts.
#pragma once

#include <optional>
#include <vector>

#include "question/engines.hpp"
#include "question/many_flights.hpp"
#include "statistics/flights/plan.hpp"
#include "statistics/flights/tally.hpp"

namespace lorentz::flights {

/// An engine that flies columns. Any number of threads may share one if its engine may be shared.
class ColumnFlyer {
 public:
  ColumnFlyer(const question::EngineInfo& engine, const Scene& scene);
  void fly(const QueryColumns& queries, FlightTable& flights) const;

 private:
  int dimension_;
  std::optional<question::ManyFlights> together_;  // nothing: one by one
  question::FirstHit single_;
};

/// A thread's own.
class Flyer {
 public:
  Flyer(const FlightsPlan& plan, const ColumnFlyer& engine);

  /// Flies the starts [first, first + count), and adds what came of them. Throws InputError if a start cannot
  /// be found, or the engine cannot answer.
  void fly(std::uint64_t first, std::uint64_t count, FlightTally& tally);

 private:
  bool count(const Flight& flight, std::uint64_t index, FlightTally& tally);
  void draw_anew(FlightTally& tally);

  const ColumnFlyer& engine_;
  const starts::Candidates starts_;
  starts::StartColumns columns_;
  QueryTable again_;
  FlightTable flights_;
  std::uint64_t inside_in_a_row_ = 0;  ///< candidates
  std::vector<std::uint64_t> inside_;  ///< starts whose last candidate lay in an obstacle
};

}  // namespace lorentz::flights
