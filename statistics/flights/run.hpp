// Flies a plan on threads, block by block, and tells on the way how far it is.
#pragma once

#include <atomic>
#include <functional>

#include "statistics/flights/account.hpp"
#include "statistics/flights/plan.hpp"

namespace lorentz::flights {

struct FlightBounds {
  unsigned jobs = 1;
  double seconds = 0;                       ///< stop after so long; 0: when all is flown
  std::uint64_t shard = 0, shards = 1;      ///< only the blocks `shard` modulo `shards`
  Ranges done = {};                         ///< blocks that are not to be flown, besides those of the account
  const std::atomic<bool>* stop = nullptr;  ///< stop when this becomes true
};

/// Called from one thread at a time, several times a second, and when all has ended.
using OnProgress = std::function<void(const Account&)>;

/// Adds to the account the blocks that it has not and that are this shard's, until all are done or the bounds
/// say that it is enough. A block is in it whole, or not at all: at every call of `on_progress` the account
/// is one that can be gone on from. Throws InputError where the plan cannot be flown.
void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress = {});

}  // namespace lorentz::flights
