#include "question/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

extern char** environ;

namespace lorentz::question {

LineBuffer::Read LineBuffer::read_from(int descriptor) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  buffer_.resize(std::max(buffer_.size(), end_ + kPiece + LineReader::kPadding));
  const ssize_t count = read(descriptor, buffer_.data() + end_, kPiece);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return Read::nothing;
  at_end_ = count <= 0;
  if (at_end_) return Read::end;
  end_ += static_cast<std::size_t>(count);
  return Read::some;
}

bool LineBuffer::next(LineReader::Line& line) {
  const char* start = buffer_.data() + begin_;
  const std::size_t unread = end_ - begin_;
  const void* newline =
      unread > searched_ ? std::memchr(start + searched_, '\n', unread - searched_) : nullptr;
  searched_ = newline ? 0 : unread;
  const std::size_t length = newline ? static_cast<const char*>(newline) - start : unread;
  is_too_long_ |= length > kMaxLine;
  if (is_too_long_ || (!newline && !(at_end_ && unread > 0))) return false;
  begin_ += length + (newline ? 1 : 0);
  line = {std::string_view(start, length), ++number_, false};
  searched_ = 0;
  return true;
}

std::string Ending::text() const {
  if (how == How::still_ran) return "still running";
  if (how == How::signalled) return fmt::format("signal {}, {}", code, strsignal(code));
  // The status by which the shell reports how its command ended.
  if (code == 127) return "exit 127, no such command";
  if (code > 128 && code <= 128 + SIGRTMAX)
    return fmt::format("exit {}, signal {}, {}", code, code - 128, strsignal(code - 128));
  return fmt::format("exit {}", code);
}

namespace {

// The groups that run now, for the signal handler.
std::array<std::atomic<pid_t>, 64> live_groups;

void replace_group(pid_t old_group, pid_t new_group) {
  for (auto& slot : live_groups) {
    pid_t expected = old_group;
    if (slot.compare_exchange_strong(expected, new_group)) return;
  }
}

// A program in a group of its own does not get the terminal's Ctrl-C. Therefore these signals first kill the
// groups, and then do here what they would have done. `former` is what they did before: their default, or a
// handler that ends the program, too.
constexpr std::array kEndings{SIGINT, SIGTERM, SIGHUP, SIGPIPE};
std::array<struct sigaction, kEndings.size()> former;

void kill_groups_and_die(int signal_number) {
  kill_programs();
  for (std::size_t i = 0; i < kEndings.size(); ++i)
    if (kEndings[i] == signal_number) sigaction(signal_number, &former[i], nullptr);
  raise(signal_number);  // blocked until the handler returns
}

// A one-shot handler (SA_RESETHAND) is taken to end the program; one that stays installed is not.
bool ends_the_program(const struct sigaction& action) {
  return action.sa_handler == SIG_DFL || (action.sa_handler != SIG_IGN && (action.sa_flags & SA_RESETHAND));
}

void handle_signals_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    for (std::size_t i = 0; i < kEndings.size(); ++i) {
      struct sigaction ours {};
      if (sigaction(kEndings[i], nullptr, &former[i]) != 0 || !ends_the_program(former[i])) continue;
      ours.sa_handler = kill_groups_and_die;
      sigaction(kEndings[i], &ours, nullptr);
    }
  });
}

// The descriptors lie above those of standard input, output and error, even if this program was started
// without these. They are moved into the child's places one after the other, and none may lie in another's
// way.
struct Pipe {
  int to_read = -1, to_write = -1;

  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    to_read = fcntl(ends[0], F_DUPFD_CLOEXEC, 3);
    to_write = fcntl(ends[1], F_DUPFD_CLOEXEC, 3);
    close(ends[0]);
    close(ends[1]);
  }
  ~Pipe() {
    if (to_read >= 0) close(to_read);
    if (to_write >= 0) close(to_write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  bool is_open() const { return to_read >= 0 && to_write >= 0; }
};

// Blocks these signals in this thread while it lives, so that a program is started and its group is noted, or
// neither.
struct Undisturbed {
  sigset_t before;

  Undisturbed() {
    sigset_t endings;
    sigemptyset(&endings);
    for (const int ending : kEndings) sigaddset(&endings, ending);
    pthread_sigmask(SIG_BLOCK, &endings, &before);
  }
  ~Undisturbed() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
};

// The new program gets the signal mask `mask`.
int spawn(const Executable& program, const Pipe& in, const Pipe& out, const Pipe& errors,
          const sigset_t& mask, pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, in.to_read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.to_write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.to_write, STDERR_FILENO);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<std::string> words = program.arguments;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&pid, program.file.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

void kill_programs() {
  for (const auto& slot : live_groups)
    if (const pid_t group = slot.load()) kill(-group, SIGKILL);
}

Executable shell_command(const std::string& command) {
  return {"cmd:" + command, "/bin/sh", {"sh", "-c", command}};
}

FileError cannot_start(const std::string& name) {
  const int error = errno;
  const char* const remedy = error == EMFILE ? "; allow more open files (ulimit -n)"
                             : error == EAGAIN
                                 ? "; allow more processes (ulimit -u), or ask for fewer (--jobs 1)"
                                 : "";
  return FileError(name + ": cannot be started: " + std::strerror(error) + remedy);
}

Process::Process(const Executable& program) {
  handle_signals_once();
  Pipe in, out, errors;
  const Undisturbed undisturbed;
  const int error = in.is_open() && out.is_open() && errors.is_open()
                        ? spawn(program, in, out, errors, undisturbed.before, pid_)
                        : errno;
  if ((errno = error) != 0) throw cannot_start(program.name);
  replace_group(0, pid_);
  std::swap(input_, in.to_write);
  std::swap(output_, out.to_read);
  std::swap(errors_, errors.to_read);
  for (const int end : {input_, output_, errors_}) fcntl(end, F_SETFL, fcntl(end, F_GETFL) | O_NONBLOCK);
}

Process::~Process() {
  end(std::chrono::milliseconds(0));
  close(output_);
  if (errors_ >= 0) close(errors_);
}

constexpr int kMostErrorPieces = 16;  // of 4096 bytes: what a pipe holds

void Process::pass_on_errors() {
  std::array<char, 4096> piece;
  ssize_t count = 0;
  for (int pieces = 0; errors_ >= 0; ++pieces) {
    if (pieces == kMostErrorPieces) return;  // a program that never stops must not keep us
    if ((count = read(errors_, piece.data(), piece.size())) <= 0) break;
    for (ssize_t sent = 0, n = 0; shows_errors_ && sent < count; sent += n)
      if ((n = ::write(STDERR_FILENO, piece.data() + sent, static_cast<std::size_t>(count - sent))) <= 0)
        break;
    for (const char c : std::string_view(piece.data(), static_cast<std::size_t>(count))) {
      if (c == '\n')
        end_line();
      else if (line_.size() < kMostWords)
        line_ += c;
    }
  }
  if (errors_ < 0 || (count < 0 && (errno == EAGAIN || errno == EINTR))) return;
  close(errors_);
  errors_ = -1;
}

void Process::end_line() {
  if (line_.find_first_not_of(" \t\r") != std::string::npos)
    words_before_ = std::exchange(last_words_, std::exchange(line_, {}));
  line_.clear();
}

std::string Process::take_last_words() {
  end_line();
  words_before_.clear();
  return std::exchange(last_words_, {});
}

void Process::close_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

std::optional<std::size_t> Process::write(std::string_view text) {
  // SIGPIPE must only report that our own output is closed. Here it is blocked, and removed if this write
  // raised it.
  sigset_t pipe_only, before, pending;
  sigemptyset(&pipe_only);
  sigaddset(&pipe_only, SIGPIPE);
  sigpending(&pending);
  pthread_sigmask(SIG_BLOCK, &pipe_only, &before);
  const ssize_t count = ::write(input_, text.data(), text.size());
  const int error = count < 0 ? errno : 0;
  const timespec at_once{0, 0};
  if (error == EPIPE && !sigismember(&pending, SIGPIPE)) sigtimedwait(&pipe_only, nullptr, &at_once);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (error == EAGAIN || error == EINTR) return 0;
  return std::nullopt;
}

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Processor seconds of a process, by its clock if it has one, and of the children that it waited for, by its
// line in /proc/PID/stat, in hundredths of a second. 0 if it is not of this group.
double seconds_of(pid_t pid, const std::string& stat, pid_t group) {
  const std::size_t name_end = stat.rfind(')');
  long of_group = 0, own[2] = {}, children[2] = {};
  if (name_end == std::string::npos ||
      std::sscanf(stat.c_str() + name_end + 1, " %*c %*d %ld %*d %*d %*d %*u %*u %*u %*u %*u %ld %ld %ld %ld",
                  &of_group, &own[0], &own[1], &children[0], &children[1]) != 5 ||
      of_group != group)
    return 0;
  const auto tick = static_cast<double>(sysconf(_SC_CLK_TCK));
  double seconds = static_cast<double>(own[0] + own[1]) / tick;
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(pid, &clock) == 0 && clock_gettime(clock, &time) == 0)
    seconds = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  return seconds + static_cast<double>(children[0] + children[1]) / tick;
}

// "Aborted (core dumped)"; some shells name themselves and the command.
bool is_of_shell(const std::string& words, int status) {
  if (!WIFEXITED(status) || WEXITSTATUS(status) <= 128) return false;
  const std::string signal = strsignal(WEXITSTATUS(status) - 128);
  return words.starts_with(signal) || (words.starts_with("sh: ") && words.find(signal) != std::string::npos);
}

}  // namespace

double Process::processor_seconds() const {
  if (pid_ < 0) return spent_;
  double seconds = 0;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", none)) {
    const int pid = std::atoi(entry.path().filename().c_str());  // 0: not a process
    std::string stat;
    if (pid > 0 && std::getline(std::ifstream(entry.path() / "stat"), stat))
      seconds += seconds_of(pid, stat, pid_);
  }
  return seconds;
}

Ending Process::end(std::chrono::milliseconds grace) {
  if (pid_ < 0) return {};
  close_input();
  const auto until = std::chrono::steady_clock::now() + grace;
  siginfo_t info{};
  // The program stays a zombie until the group is killed, so that the group's number cannot belong to another
  // by then.
  for (auto pause = std::chrono::microseconds(100);;
       pause = std::min(2 * pause, std::chrono::microseconds(10000))) {
    info.si_pid = 0;
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | WNOHANG) != 0 || info.si_pid != 0)
      break;
    if (std::chrono::steady_clock::now() >= until) break;
    std::this_thread::sleep_for(pause);
  }
  spent_ = processor_seconds();
  kill(-pid_, SIGKILL);
  int status = 0;
  rusage used{};
  while (wait4(pid_, &status, 0, &used) == -1 && errno == EINTR) {
  }
  spent_ = std::max(spent_, seconds_of(used.ru_utime) + seconds_of(used.ru_stime));
  pass_on_errors();
  end_line();
  if (is_of_shell(last_words_, status)) last_words_ = std::exchange(words_before_, {});
  replace_group(pid_, 0);
  pid_ = -1;
  if (info.si_pid == 0) return {Ending::How::still_ran, 0};
  if (WIFEXITED(status)) return {Ending::How::exited, WEXITSTATUS(status)};
  return {Ending::How::signalled, WTERMSIG(status)};
}

}  // namespace lorentz::question
