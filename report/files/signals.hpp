// How the program ends at a signal: Ctrl-C, SIGTERM, a terminal that hangs up, a closed pipe.
#pragma once

#include <cstddef>
#include <string>

namespace lorentz {

/// From here on such a signal removes unfinished files, reports itself in a line (except a closed pipe, whose
/// reader has gone), and ends the program as it would have. A file that exceeds the size limit (ulimit -f) is
/// an error like a full disk. Signals that the caller ignores stay ignored.
void end_in_order();

/// From here on no file that is opened gets the number of a standard stream that the caller has closed, and what
/// is meant for that. To read from it, or to write to it, fails as before.
void reserve_standard_streams();

/// A file that would look whole but is not. It is removed if a signal ends the program while this object lives.
class Unfinished {
 public:
  explicit Unfinished(const std::string& path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::size_t slot_;
};

}  // namespace lorentz
