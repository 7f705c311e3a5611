#include "report/files/signals.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <string_view>

namespace lorentz {
namespace {

// A handler may neither allocate nor wait, so names are in static storage.
struct Slot {
  std::atomic<bool> taken = false, named = false;
  char path[PATH_MAX];
};
std::array<Slot, 16> slots;
static_assert(std::atomic<bool>::is_always_lock_free);

void write_line(std::string_view text) {
  [[maybe_unused]] const ssize_t count = write(STDERR_FILENO, text.data(), text.size());
}

void take_leave(int number) {
  for (const Slot& slot : slots)
    if (slot.named) unlink(slot.path);
  if (number != SIGPIPE) {
    write_line(number == SIGINT    ? "lorentz: interrupted\n"
               : number == SIGTERM ? "lorentz: terminated\n"
                                   : "lorentz: hung up\n");
  }
  raise(number);  // blocked until the handler returns, then deadly: SA_RESETHAND
}

}  // namespace

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

void end_in_order() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction now {
    }, ours{};
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    ours.sa_handler = take_leave;
    ours.sa_flags = SA_RESETHAND;
    sigaction(number, &ours, nullptr);
  }
  signal(SIGXFSZ, SIG_IGN);
}

Unfinished::Unfinished(const std::string& path) : slot_(0) {
  if (path.size() >= sizeof Slot::path) slot_ = slots.size();  // no file can have this name
  while (slot_ < slots.size() && slots[slot_].taken.exchange(true)) ++slot_;
  if (slot_ == slots.size()) return;  // more files at once than expected: these stay
  path.copy(slots[slot_].path, path.size());
  slots[slot_].path[path.size()] = '\0';
  slots[slot_].named = true;
}

Unfinished::~Unfinished() {
  if (slot_ == slots.size()) return;
  slots[slot_].named = false;
  slots[slot_].taken = false;
}

}  // namespace lorentz
