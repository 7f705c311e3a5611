// Another program at the end of two pipes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lorentz/line_reader.hpp>

namespace lorentz::question {

/// Lines out of what a descriptor gives bit by bit. Memory stays bounded: of a line beyond kMaxLine the rest
/// is passed over.
class LineBuffer {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{1} << 20;

  enum class Read { some, nothing, end };

  /// What the descriptor, which does not block, has now; `end` for good.
  Read read_from(int descriptor);

  /// The next line that is complete, as LineReader has them. After the end, also a last one without a line
  /// end.
  bool next(LineReader::Line& line);

 private:
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0, searched_ = 0;  // unread; of those, known to hold no line end
  std::size_t number_ = 0;
  bool at_end_ = false, skipping_ = false;
};

/// How a program ended.
struct Ending {
  enum class How { exited, signalled, still_ran };
  How how = How::exited;
  int code = 0;  ///< exit status, or the signal

  bool is_good() const { return how == How::exited && code == 0; }
  std::string text() const;  ///< "exit 3", "exit 139, signal 11, Segmentation fault", "still running"
};

/// A program to be run.
struct Executable {
  std::string name;  ///< in messages
  std::string file;
  std::vector<std::string> arguments;  ///< the first is the name that it sees
  int inherited = -1;                  ///< a descriptor that is its number 3; -1: it has none
};

/// A program that runs in a process group of its own, with pipes to its standard input and from its standard
/// output and error; what it writes to the latter is passed on to ours. The group is killed when this object goes,
/// and when one of the common signals ends this program.
class Process {
 public:
  /// By `/bin/sh -c`. Throws FileError if there can be no process. (That the command exists is for the shell to
  /// find out.)
  explicit Process(const std::string& command);
  /// Throws FileError if it cannot be started.
  explicit Process(const Executable& program);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int input() const { return input_; }    ///< the descriptor to write to, never blocking; -1 when closed
  int output() const { return output_; }  ///< the descriptor to read from, never blocking
  int errors() const { return errors_; }  ///< that of its standard error, likewise; -1 once it has ended

  /// Passes on what it wrote to its standard error, and keeps the last line of it that is not blank.
  void pass_on_errors();
  /// That line, without its end, and at most kMostWords bytes of it; empty if there is none since the last call.
  std::string take_last_words() { return std::exchange(last_words_, {}); }
  static constexpr std::size_t kMostWords = 300;

  /// Seconds that the processors spent on its group until now, those of its children to a hundredth; once it was ended, on the program and
  /// the children that it waited for.
  double processor_seconds() const;

  /// Writes as much as the pipe takes and says how much; nothing if the program no longer reads. Raises no
  /// SIGPIPE.
  std::optional<std::size_t> write(std::string_view text);
  void close_input();

  /// Waits up to `grace` for its end, then kills what is left of its group.
  Ending end(std::chrono::milliseconds grace);

 private:
  pid_t pid_ = -1;
  int input_ = -1, output_ = -1, errors_ = -1;
  std::string last_words_, line_;  // line_: begun, and not ended
  double spent_ = 0;               // processor_seconds() in the end
};

/// Kills the groups of all that run. A signal handler may call it.
void kill_programs();

}  // namespace lorentz::question
