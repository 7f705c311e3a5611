// The processes of one run, where mpirun started several: each flies a share of the blocks, and rank 0 keeps
// the account. Nobody but ranks_mpi.cpp knows MPI; a program built without it has ranks_none.cpp in its
// place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flights/account.hpp"

namespace lorentz::flights {

/// Used by the one thread that made it.
class Ranks {
 public:
  /// Null if this process runs alone. Throws InputError if mpirun started it, but it was built without MPI.
  static std::unique_ptr<Ranks> join();
  ~Ranks();

  int rank() const;
  int size() const;

  /// A run begins, the first or the next one: what rank 0 has of it already, told to all.
  void share(Account& account);

  /// The other ranks: this is what came of their blocks so far; the last time, of all of them.
  void report(const Account& account, bool last);

  /// Rank 0: the account with what all others have reported. Without waiting; or when all of them have
  /// reported for the last time.
  Account sum(const Account& own, bool wait);

  /// Ends all processes with this exit status.
  [[noreturn]] void abort(int status);

 private:
  struct Impl;
  explicit Ranks(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lorentz::flights
