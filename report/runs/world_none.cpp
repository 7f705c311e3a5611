// Built without MPI: one process.
#include <cstdlib>

#include "report/runs/world.hpp"

namespace lorentz::runs {

struct World::Mpi {};

World::World() = default;
World::~World() = default;

int World::rank() const {
  return 0;
}
int World::size() const {
  return 1;
}
void World::abort(int status) {
  std::exit(status);
}
void World::share(std::string&) {}
void World::send(int, int, const std::string&) {}
std::optional<World::Message> World::received() {
  return std::nullopt;
}

bool has_mpi() {
  return false;
}

}  // namespace lorentz::runs
