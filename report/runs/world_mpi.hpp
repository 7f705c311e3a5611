// Private to *_mpi.cpp.
#pragma once

#include <boost/mpi.hpp>

#include "report/runs/world.hpp"

namespace lorentz::runs {

struct World::Mpi {
  boost::mpi::environment environment{boost::mpi::threading::funneled, false};
  boost::mpi::communicator world;
};

}  // namespace lorentz::runs
