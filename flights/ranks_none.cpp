// Built without MPI: one process.
#include <cstdlib>

#include <lorentz/errors.hpp>
#include "flights/ranks.hpp"

namespace lorentz::flights {

struct Ranks::Impl {};

std::unique_ptr<Ranks> Ranks::join() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name); size && std::atoi(size) > 1)
      throw InputError(
          "several processes were started for one run, but this program was built without MPI; build it with "
          "-DLORENTZ_MPI=ON (`./run build` does), or use --jobs, or --shard and --add");
  return nullptr;
}

Ranks::~Ranks() = default;
int Ranks::rank() const {
  return 0;
}
int Ranks::size() const {
  return 1;
}
void Ranks::share(Account&) {}
void Ranks::report(const Account&, bool) {}
Account Ranks::sum(const Account& own, bool) {
  return own;
}
void Ranks::abort(int status) {
  std::exit(status);
}

}  // namespace lorentz::flights
