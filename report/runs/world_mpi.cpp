#include <boost/mpi.hpp>
#include <boost/serialization/string.hpp>
#include <cstdlib>

#include "report/runs/world.hpp"

namespace lorentz::runs {

struct World::Mpi {
  boost::mpi::environment environment{boost::mpi::threading::funneled, false};
  boost::mpi::communicator world;
};

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

void World::share(std::string& text) {
  boost::mpi::broadcast(mpi_->world, text, 0);
}
void World::send(int to, int kind, const std::string& text) {
  mpi_->world.send(to, kind, text);
}
std::optional<World::Message> World::received() {
  const auto status = mpi_->world.iprobe();
  if (!status) return std::nullopt;
  Message message{status->source(), status->tag(), {}};
  mpi_->world.recv(message.from, message.kind, message.text);
  return message;
}

bool has_mpi() {
  return true;
}

}  // namespace lorentz::runs
