// The processes of one run of flights: each flies a share of the blocks, and rank 0 keeps the account.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runs/world.hpp"
#include "statistics/flights/account.hpp"

namespace lorentz::flights {

class Ranks : public runs::World {
 public:
  /// See runs::join.
  Ranks();
  ~Ranks();

  /// A run begins, the first or the next one: what rank 0 has of it already, told to all.
  void share(Account& account);

  /// The other ranks: this is what came of their blocks so far; the last time, of all of them.
  void report(const Account& account, bool last);

  /// Rank 0: the account with what all others have reported. Without waiting; or when all of them have
  /// reported for the last time.
  Account sum(const Account& own, bool wait);

 private:
  struct Inbox;
  std::unique_ptr<Inbox> inbox_;
};

}  // namespace lorentz::flights
