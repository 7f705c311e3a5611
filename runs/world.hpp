// The processes of one run, where mpirun started several. What they say to each other is the business of who
// derives from this. Nobody but files called *_mpi knows MPI; a program built without it has *_none.cpp in
// the place of *_mpi.cpp.
#pragma once

#include <memory>

namespace lorentz::runs {

/// Used by the one thread that made it; a process makes one.
class World {
 public:
  int rank() const;
  int size() const;

  /// Ends all processes with this exit status.
  [[noreturn]] void abort(int status);

 protected:
  struct Mpi;

  World();
  ~World();
  Mpi& mpi() { return *mpi_; }

 private:
  std::unique_ptr<Mpi> mpi_;
};

/// Did mpirun start several processes for this run? Throws InputError if it did, but this program was built
/// without MPI; `instead` says which options share out work without it.
bool are_several(const char* instead);

/// Null if this process runs alone.
template <class Ranks>
std::unique_ptr<Ranks> join(const char* instead) {
  return are_several(instead) ? std::make_unique<Ranks>() : nullptr;
}

/// Was this program built with MPI?
bool has_mpi();

}  // namespace lorentz::runs
