#include "question/library_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "question/answerer.hpp"
#include "question/library_host/program_bytes.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr double kLookSeconds = 0.1;  // between checks of the clock and the answers
constexpr std::chrono::milliseconds kTimeToEnd{1000};
constexpr std::size_t kBothSizes = sizeof(SharedQueries) + sizeof(SharedAnswers);

FileError no_memory() {
  return FileError(std::string("no memory for a library: ") + std::strerror(errno));
}

// A file without a name. Its descriptor lies above those that a child has.
int nameless_file(const char* name) {
  const int descriptor = memfd_create(name, MFD_CLOEXEC);
  const int above = fcntl(descriptor, F_DUPFD_CLOEXEC, 10);
  if (above < 0) throw no_memory();
  close(descriptor);
  return above;
}

// The program that loads libraries, as a file. It exists until this program ends.
const std::string& host_file() {
  static const std::string path = [] {
    const int file = nameless_file("lorentz_library_host");
    for (std::string_view bytes = library_host_program(); !bytes.empty();) {
      const ssize_t count = ::write(file, bytes.data(), bytes.size());
      if (count <= 0) throw no_memory();
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return fmt::format("/proc/self/fd/{}", file);
  }();
  return path;
}

// The system would look for a name without a slash among its own libraries.
std::string path_of(const std::string& file) {
  return file.find('/') == std::string::npos ? "./" + file : file;
}

template <class Numbers>
void append_all(std::string& bytes, const Numbers& numbers) {
  bytes.append(reinterpret_cast<const char*>(std::data(numbers)),
               std::size(numbers) * sizeof *std::data(numbers));
}

void append(std::vector<double>& numbers, const Vec& vector, int dimension) {
  numbers.insert(numbers.end(), vector.begin(), vector.begin() + dimension);
}

std::string bytes_of(const Scene& scene, int threads) {
  const int d = scene.dimension;
  std::vector<std::int32_t> ranks, lattice_of;
  std::vector<double> vectors, positions, radii, shapes;
  for (const Lattice& lattice : scene.lattices) {
    const auto number = static_cast<std::int32_t>(ranks.size());
    ranks.push_back(lattice.rank(d));
    for (int k = 0; k < lattice.rank(d); ++k) append(vectors, lattice.vectors[k], d);
    for (const Atom& atom : lattice.atoms) {
      lattice_of.push_back(number);
      append(positions, atom.position, d);
      radii.push_back(atom.is_ball() ? atom.radius : 0);
      const std::array<Vec, 3> semiaxes = semiaxes_of(atom, d);
      for (int i = 0; i < d; ++i) append(shapes, semiaxes[i], d);
    }
  }
  const std::int32_t head[] = {d, static_cast<std::int32_t>(ranks.size()),
                               static_cast<std::int32_t>(radii.size()), threads};
  std::string bytes;
  append_all(bytes, head);
  append_all(bytes, ranks), append_all(bytes, vectors), append_all(bytes, lattice_of);
  append_all(bytes, positions), append_all(bytes, radii), append_all(bytes, shapes);
  return bytes;
}

std::string bytes_of(HostOrder::Kind kind, std::size_t size) {
  const HostOrder order{kind, static_cast<std::int64_t>(size)};
  return {reinterpret_cast<const char*>(&order), sizeof order};
}

std::string died(const Ending& ending) {
  if (ending.how == Ending::How::still_ran) return "closed what it shares with this program";
  return fmt::format("died ({})", ending.text());
}

}  // namespace

// The memory that both processes share.
struct LibraryProcess::Memory {
  Memory() {
    if (ftruncate(file, kBothSizes) == 0)
      at = mmap(nullptr, kBothSizes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (at == MAP_FAILED) throw no_memory();
  }
  ~Memory() { close(file); }

  const int file = nameless_file("lorentz_library_rows");
  void* at = MAP_FAILED;
};

LibraryProcess::LibraryProcess(const std::string& file) : LibraryProcess(file, Memory()) {}

LibraryProcess::LibraryProcess(const std::string& file, const Memory& memory)
    : queries_(static_cast<SharedQueries*>(memory.at)),
      answers_(reinterpret_cast<SharedAnswers*>(static_cast<char*>(memory.at) + sizeof(SharedQueries))),
      process_(Executable{"lib:" + file, host_file(), {"lorentz_library_host", path_of(file)}, memory.file}) {
}

LibraryProcess::~LibraryProcess() {
  munmap(queries_, kBothSizes);
}

HostReply LibraryProcess::load(const HostPatience& patience) {
  return exchange({}, 0, patience);
}

HostReply LibraryProcess::prepare(const Scene& scene, int threads, const HostPatience& patience) {
  const std::string bytes = bytes_of(scene, threads);
  return exchange(bytes_of(HostOrder::Kind::scene, bytes.size()) + bytes, 0, patience);
}

HostReply LibraryProcess::answer(std::size_t rows, const HostPatience& patience) {
  std::fill_n(answers_->outcome, rows, SharedAnswers::kNone);
  return exchange(bytes_of(HostOrder::Kind::queries, rows), rows, patience);
}

std::size_t LibraryProcess::answered_in_order(std::size_t rows) const {
  std::size_t row = 0;
  while (row < rows && std::atomic_ref(answers_->outcome[row]).load() != SharedAnswers::kNone) ++row;
  return row;
}

HostReply LibraryProcess::exchange(const std::string& order, std::size_t rows, const HostPatience& patience) {
  using Clock = std::chrono::steady_clock;
  std::string_view to_write = order;
  std::size_t answered = 0;
  HostReply reply;
  for (auto last_move = Clock::now();;) {
    pollfd pipes[2] = {{process_.output(), POLLIN, 0},
                       {to_write.empty() ? -1 : process_.input(), POLLOUT, 0}};
    ::poll(pipes, 2, static_cast<int>(std::ceil(1000 * std::min(kLookSeconds, patience.seconds))));
    if (!to_write.empty()) {
      const std::optional<std::size_t> count = process_.write(to_write);
      to_write.remove_prefix(count.value_or(to_write.size()));  // the process no longer reads: it is ending
      if (count && *count > 0) last_move = Clock::now();
    }
    if (take_report(reply)) return reply;
    if (patience.enough && patience.enough()) return {HostReply::Fate::enough};
    const std::size_t by_now = answered_in_order(rows);
    if (by_now > answered) last_move = Clock::now();
    answered = by_now;
    if (std::chrono::duration<double>(Clock::now() - last_move).count() < patience.seconds) continue;
    return {HostReply::Fate::failed, {}, fmt::format("gave no answer within {:.4g} s", patience.seconds)};
  }
}

// True if there is nothing more to wait for.
bool LibraryProcess::take_report(HostReply& reply) {
  char piece[4096];
  ssize_t count = 0;
  while ((count = ::read(process_.output(), piece, sizeof piece)) > 0)
    received_.append(piece, static_cast<std::size_t>(count));
  const bool at_end = count == 0;
  if (take_whole_report(reply)) return true;
  if (at_end) reply = {HostReply::Fate::failed, {}, died(process_.end(kTimeToEnd))};
  return at_end;
}

bool LibraryProcess::take_whole_report(HostReply& reply) {
  HostReport report{};
  if (received_.size() < sizeof report) return false;
  std::memcpy(&report, received_.data(), sizeof report);
  const auto size = static_cast<std::size_t>(report.text_size);
  if (received_.size() - sizeof report < size) return false;
  reply = {HostReply::Fate::reported, report, received_.substr(sizeof report, size)};
  received_.clear();
  return true;
}

Ending LibraryProcess::end() {
  return process_.end(kTimeToEnd);
}

std::string claim_line_of_library(const std::string& file) {
  const std::string name = "lib:" + file;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw FileError(name + ": there is no such file; lib: is followed by the path of a shared library");
  LibraryProcess process(file);
  HostReply reply = process.load({AnswererOptions::kDefaultTimeout, {}});
  if (reply.fate == HostReply::Fate::failed)
    throw FileError(
        fmt::format("{}: {} while it was loaded; mend what it does before its first call", name, reply.text));
  if (!reply.is(HostReport::Kind::loaded))
    throw FileError(fmt::format("{}: {}", name, printable(reply.text)));
  return reply.text;
}

}  // namespace lorentz::question
