// The processes of one run of flights: each flies a share of the blocks, and rank 0 keeps the account.
#pragma once

#include <string>
#include <vector>

#include "report/runs/world.hpp"
#include "statistics/flights/account.hpp"

namespace lorentz::flights {

class Ranks : public runs::World {
 public:
  /// Begins a run, the first or a later one: rank 0 sends its account so far to all ranks.
  void share(Account& account);

  /// For the ranks other than 0: reports the account of their blocks so far; the last report covers all of
  /// them.
  void report(const Account& account, bool last);

  /// For rank 0: the sum of its account and the latest reports of all others. `wait`: waits until all of them
  /// have sent their last report.
  Account sum(const Account& own, bool wait);

 private:
  std::vector<std::string> latest_;  // rank 0: the latest account of each other rank
  int at_work_ = 0;                  // rank 0: how many have not sent their last report
};

}  // namespace lorentz::flights
