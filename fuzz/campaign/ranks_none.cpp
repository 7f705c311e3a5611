// Built without MPI: one process.
#include <cstdlib>

#include <lorentz/errors.hpp>
#include "fuzz/campaign/ranks.hpp"

namespace lorentz::fuzz {

struct Ranks::Impl {};

std::unique_ptr<Ranks> Ranks::join() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name); size && std::atoi(size) > 1)
      throw InputError(
          "several processes were started for one campaign, but this program was built without MPI; build it "
          "with -DLORENTZ_MPI=ON (`./run build` does), or use --jobs, or --shard and `lorentz fuzz merge`");
  return nullptr;
}

Ranks::~Ranks() = default;
int Ranks::rank() const {
  return 0;
}
int Ranks::size() const {
  return 1;
}
void Ranks::serve(Ledger&) {}
void Ranks::dismiss(Ledger&) {}
void Ranks::work(const Plan&, unsigned, const MakeSubject&) {}
void Ranks::abort(int status) {
  std::exit(status);
}

std::string mpi_library() {
  return {};
}

}  // namespace lorentz::fuzz
