#include <cstdlib>
#include <string>

#include <lorentz/errors.hpp>
#include "report/runs/world.hpp"

namespace lorentz::runs {
namespace {

// The number that Open MPI, or another MPI, gives to the processes that it starts.
int processes_started() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size);
  return 1;
}

}  // namespace

bool are_several(const char* instead) {
  if (processes_started() < 2) return false;
  if (has_mpi()) return true;
  throw InputError(
      std::string("several processes were started for one run, but this program was built without MPI; build "
                  "it with -DLORENTZ_MPI=ON (`./run build` does), or use ") +
      instead);
}

}  // namespace lorentz::runs
