// The processes of one campaign, where mpirun started several. Rank 0 keeps the ledger (and the store); the
// others ask it for batches and send it what came of them. Nobody but ranks_mpi.cpp knows MPI; a program
// built without it has ranks_none.cpp in its place.
#pragma once

#include <memory>
#include <string>

#include "fuzz/campaign/campaign.hpp"

namespace lorentz::fuzz {

class Ledger;

/// Used by the one thread that made it.
class Ranks {
 public:
  /// Null if this process runs alone. Throws InputError if mpirun started it, but it was built without MPI.
  static std::unique_ptr<Ranks> join();
  ~Ranks();

  int rank() const;
  int size() const;

  /// Rank 0: answers the others that have asked since, without waiting.
  void serve(Ledger& ledger);

  /// Rank 0: takes in what the others finished, and sends them home; the ledger is stopped.
  void dismiss(Ledger& ledger);

  /// The other ranks: works until rank 0 says that it is done.
  void work(const Plan& plan, unsigned jobs, const MakeSubject& make_subject);

  /// Ends all processes with this exit status.
  [[noreturn]] void abort(int status);

 private:
  struct Impl;
  explicit Ranks(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What the program was built with, as for --version: "Open MPI 4.1.4", or nothing.
std::string mpi_library();

}  // namespace lorentz::fuzz
