// Draws the starts of flights, flies them and counts the results, block by block.
#pragma once

#include <optional>
#include <vector>

#include "question/many_flights.hpp"
#include "statistics/flights/plan.hpp"
#include "statistics/flights/tally.hpp"

namespace lorentz::flights {

/// Each thread has its own Flyer.
class Flyer {
 public:
  Flyer(const FlightsPlan& plan, const question::ColumnFlyer& engine);

  /// Flies the starts [first, first + count) and adds the results to the tally. Throws InputError if a start
  /// cannot be found, or the engine cannot answer.
  void fly(std::uint64_t first, std::uint64_t count, FlightTally& tally);

 private:
  bool count(const Flight& flight, std::uint64_t index, FlightTally& tally);
  void draw_anew(FlightTally& tally);

  const question::ColumnFlyer& engine_;
  const starts::Candidates starts_;
  starts::StartColumns columns_;
  QueryTable again_;
  FlightTable flights_;
  std::uint64_t inside_in_a_row_ = 0;  ///< consecutive candidates inside
  std::vector<std::uint64_t> inside_;  ///< starts whose last candidate lay in an obstacle
};

}  // namespace lorentz::flights
