// Built without MPI: one process.
#include "fuzz/campaign/ranks.hpp"

namespace lorentz::fuzz {

void Ranks::serve(Ledger&) {}
void Ranks::dismiss(Ledger&) {}
void Ranks::work(const Plan&, unsigned, const MakeAnswerer&) {}

}  // namespace lorentz::fuzz
