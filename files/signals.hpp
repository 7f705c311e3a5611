// How the program ends when a signal says so: Ctrl-C, SIGTERM, a terminal that hangs up, a closed pipe.
#pragma once

#include <cstddef>
#include <string>

namespace lorentz {

/// From here on such a signal takes away the files that are not whole, says in a line that it came (a closed
/// pipe says nothing: who read it has gone), and ends the program as it would have. A file that outgrows the
/// limit of its size (ulimit -f) is an error like a full disk. What the caller ignores stays ignored.
void end_in_order();

/// The line of an interrupted program says that the same command goes on.
void goes_on_when_repeated();

/// A file that would look whole and is not, or the folder of such: taken away if a signal ends the program
/// while this lives.
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
