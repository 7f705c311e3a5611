// Private to *_mpi.cpp.
#pragma once

#include <boost/mpi.hpp>

#include "ranks/world.hpp"

namespace lorentz::ranks {

struct World::Mpi {
  boost::mpi::environment environment{boost::mpi::threading::funneled, false};
  boost::mpi::communicator world;
};

}  // namespace lorentz::ranks
