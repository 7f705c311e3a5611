// The flights of a plan on a graphics card: starts are drawn, flown and counted there.
#pragma once

#include <memory>
#include <vector>

#include "src/engines/gpu/driver.hpp"
#include "statistics/flights/account.hpp"
#include "statistics/gpu/drawn.hpp"

namespace lorentz::gpu {

/// Kernels that draw starts, fly them and count.
const KernelTexts& drawn_kernels();

}  // namespace lorentz::gpu

namespace lorentz::flights {

/// Blocks of a plan: `count` of them from `first` on, one in `every`.
struct BlockRange {
  std::uint64_t first, count, every;
};

/// Used by the thread that made it. What is counted is what FlightTally counts of the answers of
/// `certified-batch`, to the bit, but for the starts that are left, which the caller has to fly.
class CardFlights {
 public:
  /// On card `number`, modulo how many there are. Throws InputError if there is none, or the build has no
  /// kernels, or none for the scene. `hard`: directions are made hard (drawn.hpp).
  CardFlights(const FlightsPlan& plan, unsigned number, bool hard = false);

  const std::string& card_name() const { return card_.name(); }

  /// The most blocks to fly together.
  std::uint64_t most_blocks() const;

  /// Begins to fly blocks, and returns at once.
  void start(const BlockRange& blocks);
  /// Waits for them, adds the counts, and lists the starts that are left.
  void finish(FlightTally& tally, std::vector<gpu::LeftStart>& left);

 private:
  PreparedScene prepared_;
  gpu::DrawnFlights drawn_;
  std::uint64_t count_;  // of the plan
  gpu::Card card_;
  gpu::Kernel kernel_;
  gpu::Memory atoms_, flights_, tally_;
};

}  // namespace lorentz::flights
