// The processes of one campaign. Rank 0 keeps the ledger (and the store); the others ask it for stints and
// send it the results.
#pragma once

#include "fuzz/campaign/campaign.hpp"
#include "report/runs/world.hpp"

namespace lorentz::fuzz {

class Ledger;

class Ranks : public runs::World {
 public:
  /// Rank 0: answers the reports that have arrived from the others, without waiting.
  void serve(Ledger& ledger);

  /// Rank 0: takes in what the others finished, and dismisses them; the ledger is stopped.
  void dismiss(Ledger& ledger);

  /// The other ranks: works until rank 0 says that it is done.
  void work(const Plan& plan, unsigned jobs, const MakeAnswerer& make_answerer);

 private:
  int dismissed_ = 0;  ///< number of other ranks that rank 0 has dismissed
};

}  // namespace lorentz::fuzz
