// Another program at the end of two pipes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lorentz/errors.hpp>
#include <lorentz/line_reader.hpp>

namespace lorentz::question {

/// Splits into lines what a descriptor gives piece by piece.
class LineBuffer {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{1} << 20;

  enum class Read { some, nothing, end };

  /// Reads what the descriptor, which must not block, has now; `end` is final.
  Read read_from(int descriptor);

  /// Gives the next complete line, as LineReader does; after the end also a last line without a line end.
  bool next(LineReader::Line& line);

  /// True if the next line is longer than kMaxLine. Nothing should be read any more, so that memory stays bounded.
  bool is_too_long() const { return is_too_long_; }

 private:
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0, searched_ = 0;  // unread: begin_ to end_; searched_: no line end in these
  std::size_t number_ = 0;
  bool at_end_ = false, is_too_long_ = false;
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
  std::vector<std::string> arguments;  ///< the first is the name that the program sees
};

/// The command, run by `/bin/sh -c`. (Whether it exists only the shell finds out.)
Executable shell_command(const std::string& command);

/// Why the program cannot be started, by errno, with the remedy.
FileError cannot_start(const std::string& name);

/// A program that runs in a process group of its own, with pipes to its standard input and from its standard
/// output and error. Its standard error is passed on to ours. The group is killed when this object is
/// destroyed, and when one of the common signals ends this program.
class Process {
 public:
  /// Throws FileError if it cannot be started.
  explicit Process(const Executable& program);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int input() const { return input_; }    ///< the descriptor to write to, never blocking; -1 when closed
  int output() const { return output_; }  ///< the descriptor to read from, never blocking
  int errors() const { return errors_; }  ///< the same for its standard error; -1 once that has ended

  /// From now on what it writes to its standard error is dropped, but for its last words.
  void hide_errors() { shows_errors_ = false; }
  /// Passes on what it wrote to its standard error, as much as a pipe holds at most, and keeps the last line
  /// that is not blank. The line with which the shell reports a signal does not count.
  void pass_on_errors();
  /// That line, without its end and at most kMostWords bytes of it; empty if there was none since the last
  /// call.
  std::string take_last_words();
  static constexpr std::size_t kMostWords = 300;

  /// Processor seconds of its group until now, those of its children to a hundredth; after end(), of the
  /// program and the children that it waited for.
  double processor_seconds() const;

  /// Writes as much as the pipe takes and returns how much; nothing if the program no longer reads. Raises no
  /// SIGPIPE.
  std::optional<std::size_t> write(std::string_view text);
  void close_input();

  /// Waits up to `grace` for its end, then kills what is left of its group.
  Ending end(std::chrono::milliseconds grace);

 private:
  void end_line();

  pid_t pid_ = -1;
  int input_ = -1, output_ = -1, errors_ = -1;
  bool shows_errors_ = true;
  std::string line_, last_words_, words_before_;  // the unfinished line; the last two that are not blank
  double spent_ = 0;                              // processor_seconds() at the end
};

/// Kills the groups of all running programs. A signal handler may call it.
void kill_programs();

}  // namespace lorentz::question
