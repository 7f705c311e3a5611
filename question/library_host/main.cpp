// Makes a program of a shared library: lorentz_library_host FILE THREADS ROWS reads a query stream of this
// project's and writes an answer stream (docs/command_engines.md). It asks the library about at most ROWS
// queries a call. What the library writes to standard output goes to standard error.
//
// Besides the answers it writes the time of each call, `{"library":{"does":"prepares"}}` and the like before calls that
// are about no query, and an `error` that is not "unsupported" for a fault of the library's.
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/engine.h>
#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include "question/library_host/scan.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr std::size_t kMostText = std::size_t{1} << 20;  // of a text of the library's
constexpr int kPrivate = 10;                             // descriptors from here on are out of its way

using Clock = std::chrono::steady_clock;

// The library may hang when the reader of the answers has died, and must not live on.
void* end_with_reader(void* output) {
  pollfd pipe{*static_cast<const int*>(output), 0, 0};
  while (::poll(&pipe, 1, -1) <= 0 || !(pipe.revents & POLLERR)) {
  }
  if (getpgrp() == getpid()) kill(0, SIGKILL);
  std::_Exit(EXIT_FAILURE);
}

class HostOutput {
 public:
  HostOutput() : descriptor_(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, kPrivate)) {
    dup2(STDERR_FILENO, STDOUT_FILENO);
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);  // signals are the library's
    pthread_t thread;
    if (pthread_create(&thread, nullptr, end_with_reader, &descriptor_) == 0) pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) std::_Exit(EXIT_FAILURE);
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

 private:
  int descriptor_;
};

// The file of standard input, out of the library's way.
std::string input_file() {
  const int moved = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, kPrivate);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  return "/proc/self/fd/" + std::to_string(moved);
}

struct Library {
  decltype(&lorentz_engine_interface) interface = nullptr;
  decltype(&lorentz_engine_prepare) prepare = nullptr;
  decltype(&lorentz_engine_answer) answer = nullptr;
  decltype(&lorentz_engine_release) release = nullptr;
  decltype(&lorentz_engine_claim) claim = nullptr;  // null if the library does not export it
};

template <class Function>
void find(void* handle, const char* name, Function& function, std::string& missing) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function) missing += (missing.empty() ? "" : ", ") + std::string(name);
}

// Returns why it cannot be loaded, or nothing.
std::string load(const std::string& file, Library& library) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    return "cannot be loaded as a shared library of this machine (" + std::string(dlerror()) +
           "); cc -shared -fPIC makes one";
  std::string missing, may_be_missing;
  find(handle, "lorentz_engine_interface", library.interface, missing);
  find(handle, "lorentz_engine_prepare", library.prepare, missing);
  find(handle, "lorentz_engine_answer", library.answer, missing);
  find(handle, "lorentz_engine_release", library.release, missing);
  find(handle, "lorentz_engine_claim", library.claim, may_be_missing);
  if (!missing.empty()) return "does not export " + missing + "; <lorentz/engine.h> declares what it has to";
  const std::int32_t version = library.interface();
  if (version == LORENTZ_ENGINE_INTERFACE) return {};
  return "is made for version " + std::to_string(version) + " of <lorentz/engine.h>, and this is version " +
         std::to_string(LORENTZ_ENGINE_INTERFACE) + "; compile it again with this program's header";
}

// A scene, and its arrays.
struct HostScene {
  explicit HostScene(const Scene& of) : scene(of) {
    const int d = scene.dimension;
    for (const Lattice& lattice : scene.lattices) {
      for (int k = 0; k < lattice.rank_in(d); ++k) append(vectors, lattice.vectors[k]);
      for (const Atom& atom : lattice.atoms) {
        lattice_of.push_back(static_cast<std::int32_t>(ranks.size()));
        append(positions, atom.position);
        radii.push_back(atom.is_ball() ? atom.radius : 0);
        const auto semiaxes = semiaxes_of(atom, d);
        for (int i = 0; i < d; ++i) append(shapes, semiaxes[i]);
      }
      ranks.push_back(lattice.rank_in(d));
    }
    arrays = {d,
              static_cast<std::int32_t>(ranks.size()),
              static_cast<std::int32_t>(radii.size()),
              ranks.data(),
              vectors.data(),
              lattice_of.data(),
              positions.data(),
              radii.data(),
              shapes.data()};
  }
  HostScene(const HostScene&) = delete;
  HostScene& operator=(const HostScene&) = delete;

  const Scene scene;
  const Components components{scene};
  lorentz_scene arrays{};

 private:
  void append(std::vector<double>& numbers, const Vec& vector) const {
    numbers.insert(numbers.end(), vector.begin(), vector.begin() + scene.dimension);
  }

  std::vector<std::int32_t> ranks, lattice_of;
  std::vector<double> vectors, positions, radii, shapes;
};

class Host {
 public:
  Host(const HostOutput& output, const Library& library, std::int32_t threads, std::size_t most_rows)
      : output_(output), library_(library), threads_(threads), most_rows_(most_rows) {}
  ~Host() { release(); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  void take(std::string_view text) {
    Scan line(text);
    if (line.skip_key("scene")) {
      answer();
      return prepare(scan_scene(line));
    }
    const ScannedQuery query = scan_query(line);
    if (!scene_) throw std::runtime_error("a query before the first scene");
    if (!refusal_ && query.fits) return add(query);
    answer();
    tell(Id(query.id), refusal_ ? *refusal_ : Answer::unsupported_because(kBeyond));
  }

  // Asks the library about the rows so far.
  void answer() {
    const std::size_t count = ids_.size();
    if (count > 0) {
      const double seconds = call(count);
      json::append(text_, [&](json::Members& line) {
        line.add("engine_time", [&](json::Members& time) { time.add("seconds", seconds, "queries", count); });
      });
      text_ += '\n';
      for (std::size_t row = 0; row < count; ++row) tell(ids_[row], answer_of(row));
      ids_.clear();
      // Soon enough for a reader who waits.
      constexpr double kSeconds = 0.01, kMostGrowth = 16;
      const double fitting = kSeconds / std::max(seconds, 1e-9) * static_cast<double>(count);
      const double most = std::min(kMostGrowth * static_cast<double>(rows_), static_cast<double>(most_rows_));
      rows_ = static_cast<std::size_t>(std::max(1.0, std::min(fitting, most)));
    }
    output_.write(text_);
    text_.clear();
  }

 private:
  static constexpr const char* kBeyond = "lib: the cell of `from` is beyond 64 bits";

  void tell(const Id& id, const Answer& answer) { append_answer_line(text_, id, answer, scene_->components); }
  void doing(const char* what) const {
    output_.write(json::line_of(
        [&](json::Members& line) { line.add("library", [&](json::Members& it) { it.add("does", what); }); }));
  }

  void release() {
    if (!engine_) return;
    doing("releases");
    library_.release(std::exchange(engine_, nullptr));
  }

  void prepare(const Scene& scene) {
    release();
    scene_.emplace(scene);
    refusal_.reset();
    rows_ = 1;
    doing("prepares");
    const char* why = nullptr;
    engine_ = library_.prepare(&scene_->arrays, threads_, &why);
    doing("answers");
    if (engine_) return;
    const std::string reason = why ? ": " + shortened({why, strnlen(why, kMostText)}, kMostText / 16) : "";
    refusal_ = Answer::unsupported_because("lib does not support this scene" + printable(reason));
  }

  void add(const ScannedQuery& query) {
    const std::size_t row = ids_.size();
    if (row == from_lattice_.size()) grow();
    from_lattice_[row] = query.from_lattice, from_atom_[row] = query.from_atom;
    for (int k = 0; k < scene_->scene.dimension; ++k)
      x_[k][row] = query.x[k], v_[k][row] = query.v[k], from_cell_[k][row] = query.from_cell[k];
    ids_.emplace_back(query.id);
    if (ids_.size() >= rows_) answer();
  }

  void grow() {
    const std::size_t rows = 2 * from_lattice_.size() + 1;
    for (auto* column : {&from_lattice_, &from_atom_, &outcome_, &lattice_, &atom_}) column->resize(rows);
    for (int k = 0; k < 3; ++k) x_[k].resize(rows), v_[k].resize(rows);
    for (int k = 0; k < 3; ++k) from_cell_[k].resize(rows), cell_[k].resize(rows);
    time_.resize(rows);
  }

  // Returns the seconds that the library took.
  double call(std::size_t count) {
    std::fill_n(outcome_.begin(), count, kNone);
    lorentz_queries queries{};
    lorentz_answers answers{};
    queries.count = static_cast<std::int64_t>(count);
    queries.from_lattice = from_lattice_.data(), queries.from_atom = from_atom_.data();
    answers.outcome = outcome_.data(), answers.lattice = lattice_.data(), answers.atom = atom_.data();
    answers.time = time_.data();
    for (int k = 0; k < scene_->scene.dimension; ++k) {
      queries.x[k] = x_[k].data(), queries.v[k] = v_[k].data(), queries.from_cell[k] = from_cell_[k].data();
      answers.cell[k] = cell_[k].data();
    }
    const auto start = Clock::now();
    library_.answer(engine_, &queries, &answers);
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  Answer answer_of(std::size_t row) const {
    switch (outcome_[row]) {
      case LORENTZ_NEVER:
        return Answer::never();
      case LORENTZ_UNDECIDED:
        return Answer::undecided();
      case LORENTZ_UNSUPPORTED:
        return Answer::unsupported_because("lib does not support this query");
      case LORENTZ_HIT:
      case LORENTZ_INSIDE:
        return answer_at(row);
      case kNone:
        return Answer::error("gave no answer to this query: it left its outcome at -1");
    }
    return Answer::error("gave the outcome " + std::to_string(outcome_[row]) +
                         ", which <lorentz/engine.h> does not have");
  }

  Answer answer_at(std::size_t row) const {
    const auto is_below = [](int index, std::size_t count) {
      return index >= 0 && static_cast<std::size_t>(index) < count;
    };
    const std::vector<Lattice>& lattices = scene_->scene.lattices;
    const int lattice = lattice_[row], atom = atom_[row];
    if (!is_below(lattice, lattices.size()))
      return Answer::error("named the lattice " + std::to_string(lattice) + "; the scene has " +
                           std::to_string(lattices.size()) + ", counted from 0");
    const std::size_t atoms = lattices[static_cast<std::size_t>(lattice)].atoms.size();
    if (!is_below(atom, atoms))
      return Answer::error("named the atom " + std::to_string(atom) + " of lattice " +
                           std::to_string(lattice) + ", which has " + std::to_string(atoms) +
                           ", counted from 0");
    ObstacleId obstacle{lattice, atom, {}};
    for (int k = 0; k < scene_->components.of_cells(lattice); ++k) obstacle.cell[k] = cell_[k][row];
    if (outcome_[row] == LORENTZ_INSIDE) return Answer::inside(obstacle);
    const double time = time_[row];
    if (std::isnan(time) || time == -std::numeric_limits<double>::infinity())
      return Answer::error("gave a hit whose time is not a number");
    return Answer::hit(obstacle, time);
  }

  static constexpr std::int32_t kNone = -1;  // as outcome

  const HostOutput& output_;
  const Library& library_;
  const std::int32_t threads_;
  const std::size_t most_rows_;

  std::optional<HostScene> scene_;
  lorentz_engine* engine_ = nullptr;
  std::optional<Answer> refusal_;  // of the scene
  std::string text_;               // answers that are not written yet

  std::size_t rows_ = 1;  // of the next call
  std::vector<Id> ids_;
  std::vector<double> x_[3], v_[3], time_;
  std::vector<std::int32_t> from_lattice_, from_atom_, outcome_, lattice_, atom_;
  std::vector<std::int64_t> from_cell_[3], cell_[3];
};

bool has_more(int descriptor) {
  pollfd input{descriptor, POLLIN, 0};
  return ::poll(&input, 1, 0) > 0;
}

int fail(const HostOutput& output, const std::string& why) {
  std::string line;
  append_answer_line(line, "null", Answer::error(why), 2);
  output.write(line);
  return EXIT_FAILURE;
}

// The line that the library claims to be judged by.
int introduce(const HostOutput& output, const Library& library) {
  const char* const claim = library.claim ? library.claim() : nullptr;
  const std::size_t size = claim ? strnlen(claim, kMostText) : 0;
  if (size == kMostText)
    return fail(output, "claims more than 1 MiB of text; lorentz_engine_claim returns one line of JSON");
  output.write(std::string(claim, size) + '\n');
  return EXIT_SUCCESS;
}

int run(const std::string& file, std::int32_t threads, std::size_t most_rows) {
  LineReader input(input_file());
  const HostOutput output;
  Library library;
  if (const std::string fault = load(file, library); !fault.empty()) return fail(output, fault);
  Host host(output, library, threads, most_rows);
  input.before_waiting([&] {
    if (!has_more(input.descriptor())) host.answer();
  });
  LineReader::Line line;
  if (!input.next(line)) return introduce(output, library);
  do host.take(line.text);
  while (input.next(line));
  host.answer();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace lorentz::question

int main(int, char** arguments) {
  return lorentz::question::run(arguments[1], std::atoi(arguments[2]),
                                static_cast<std::size_t>(std::atoi(arguments[3])));
}
