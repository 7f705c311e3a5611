// The processes of one run, if mpirun started several. Derived classes define their messages. Only files
// called *_mpi use MPI; a program built without it has *_none.cpp in place of *_mpi.cpp.
#pragma once

#include <memory>

namespace lorentz::runs {

/// For the thread that made it; a process makes only one.
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

/// True if mpirun started several processes for this run. Throws InputError if it did but this program was
/// built without MPI; `instead` names the options that share out work without it.
bool are_several(const char* instead);

/// Null if this process runs alone.
template <class Ranks>
std::unique_ptr<Ranks> join(const char* instead) {
  return are_several(instead) ? std::make_unique<Ranks>() : nullptr;
}

/// True if this program was built with MPI.
bool has_mpi();

}  // namespace lorentz::runs
