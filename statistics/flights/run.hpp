// Flies a plan on threads, block by block, and reports progress.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "statistics/flights/account.hpp"

namespace lorentz::flights {

/// The engine of plans that a graphics card flies: the results are the same, so they can be added up.
inline constexpr const char* kAsOnCard = "certified-batch";

struct FlightBounds {
  unsigned jobs = 1;
  double seconds = 0;                       ///< stop after this time; 0: when all is flown
  std::uint64_t shard = 0, shards = 1;      ///< only the blocks `shard` modulo `shards`
  std::optional<unsigned> card = {};        ///< fly on this graphics card, modulo how many there are
  Blocks done = {};                         ///< blocks to skip, besides those of the account
  const std::atomic<bool>* stop = nullptr;  ///< stop when this becomes true
};

/// Called from one thread at a time, several times a second, and at the end.
using OnProgress = std::function<void(const Account&)>;

/// Adds the missing blocks of this share to the account, until all are done or the bounds are reached. The
/// account contains a block as a whole or not at all, so that at every call of `on_progress` the run can be
/// resumed from the account. Throws InputError if the plan cannot be flown; InputError without a graphics
/// card, and std::runtime_error if some flights on it are not those of the processor.
void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress = {});

}  // namespace lorentz::flights
