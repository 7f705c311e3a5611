#include "report/runs/world_mpi.hpp"

#include <cstdlib>

namespace lorentz::runs {

World::World() : mpi_(std::make_unique<Mpi>()) {}
World::~World() = default;

int World::rank() const {
  return mpi_->world.rank();
}
int World::size() const {
  return mpi_->world.size();
}
void World::abort(int status) {
  mpi_->world.abort(status);
  std::abort();
}

bool has_mpi() {
  return true;
}

}  // namespace lorentz::runs
