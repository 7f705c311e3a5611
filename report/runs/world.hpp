// The processes of one run, if mpirun started several. Derived classes define their messages. Only
// world_mpi.cpp uses MPI; a program built without it has world_none.cpp in its place.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace lorentz::runs {

/// For the thread that made it; a process makes only one.
class World {
 public:
  int rank() const;
  int size() const;

  /// Ends all processes with this exit status.
  [[noreturn]] void abort(int status);

 protected:
  struct Message {
    int from, kind;  ///< a rank; a number that the derived class chooses
    std::string text;
  };

  World();
  ~World();

  /// Gives rank 0's text to all ranks; each must call it.
  void share(std::string& text);
  void send(int to, int kind, const std::string& text);
  /// A message that has arrived, if any. It does not wait, because a wait inside MPI keeps a processor busy.
  std::optional<Message> received();

 private:
  struct Mpi;
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
