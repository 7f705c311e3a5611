// The process that loads a library (question/library_process.hpp): lorentz_library_host FILE. What the
// library writes to standard output goes to standard error. The parent sees how the process ends.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <lorentz/engine.h>
#include "question/library_host/host_messages.hpp"

namespace lorentz::question {
namespace {

using Clock = std::chrono::steady_clock;

// The two pipes, moved out of the library's way.
class ParentPipes {
 public:
  ParentPipes()
      : in_(fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10)), out_(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10)) {
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }

  // False at the end of the input.
  bool read(void* data, std::size_t size) const {
    for (auto* at = static_cast<char*>(data); size > 0;) {
      const ssize_t count = ::read(in_, at, size);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      at += count, size -= static_cast<std::size_t>(count);
    }
    return true;
  }

  void report(HostReport::Kind kind, const std::string& text = {}, double seconds = 0) const {
    const HostReport report{kind, static_cast<std::int64_t>(text.size()), seconds};
    std::string all(reinterpret_cast<const char*>(&report), sizeof report);
    all += text;
    for (std::size_t done = 0; done < all.size();) {
      const ssize_t count = ::write(out_, all.data() + done, all.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) std::_Exit(EXIT_FAILURE);  // the parent no longer reads
      done += static_cast<std::size_t>(count);
    }
  }

 private:
  int in_, out_;
};

struct Library {
  decltype(&lorentz_engine_interface) interface = nullptr;
  decltype(&lorentz_engine_prepare) prepare = nullptr;
  decltype(&lorentz_engine_answer) answer = nullptr;
  decltype(&lorentz_engine_release) release = nullptr;
  decltype(&lorentz_engine_claim) claim = nullptr;  // null if the library does not export it
};

template <class Function>
bool find(void* handle, const char* name, Function& function, std::string& missing) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return function;
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

// A scene's arrays. The library may read them until it has released the engine that it prepared.
class HostScene {
 public:
  bool read(const ParentPipes& parent, std::int64_t size) {
    bytes_.resize(static_cast<std::size_t>(size));
    if (!parent.read(bytes_.data(), bytes_.size())) return false;
    next_ = 0;
    std::int32_t head[4];
    take(head, 4);
    const auto d = static_cast<std::size_t>(head[0]), lattices = static_cast<std::size_t>(head[1]),
               atoms = static_cast<std::size_t>(head[2]);
    threads = head[3];
    std::size_t vectors = 0;
    for (const std::int32_t rank : take(ranks_, lattices)) vectors += static_cast<std::size_t>(rank);
    take(vectors_, vectors * d);
    take(lattice_of_, atoms);
    take(positions_, atoms * d), take(radii_, atoms), take(shapes_, atoms * d * d);
    scene = {head[0],           head[1],         head[2],
             ranks_.data(),     vectors_.data(), lattice_of_.data(),
             positions_.data(), radii_.data(),   shapes_.data()};
    return true;
  }

  lorentz_scene scene{};
  std::int32_t threads = 1;

 private:
  template <class Number>
  void take(Number* numbers, std::size_t count) {
    if (count > 0) std::memcpy(numbers, bytes_.data() + next_, count * sizeof(Number));
    next_ += count * sizeof(Number);
  }
  template <class Number>
  const std::vector<Number>& take(std::vector<Number>& numbers, std::size_t count) {
    numbers.resize(count);
    take(numbers.data(), count);
    return numbers;
  }

  std::vector<char> bytes_;
  std::size_t next_ = 0;
  std::vector<std::int32_t> ranks_, lattice_of_;
  std::vector<double> vectors_, positions_, radii_, shapes_;
};

class Host {
 public:
  Host(const ParentPipes& parent, const Library& library, const SharedQueries& queries,
       SharedAnswers& answers)
      : parent_(parent), library_(library), asked_(queries), told_(answers) {}
  ~Host() { release(); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bool prepare(std::int64_t size) {
    release();
    if (!scene_.read(parent_, size)) return false;
    const char* why = nullptr;
    engine_ = library_.prepare(&scene_.scene, scene_.threads, &why);
    const bool done = engine_ != nullptr;
    parent_.report(done ? HostReport::Kind::prepared : HostReport::Kind::unsupported,
                   !done && why ? why : "");
    return true;
  }

  void answer(std::int64_t count) {
    lorentz_queries queries{};
    lorentz_answers answers{};
    queries.count = count;
    queries.from_lattice = asked_.from_lattice, queries.from_atom = asked_.from_atom;
    answers.outcome = told_.outcome, answers.lattice = told_.lattice, answers.atom = told_.atom;
    answers.time = told_.time;
    for (int k = 0; k < scene_.scene.dimension; ++k) {
      queries.x[k] = asked_.x[k], queries.v[k] = asked_.v[k], queries.from_cell[k] = asked_.from_cell[k];
      answers.cell[k] = told_.cell[k];
    }
    const auto start = Clock::now();
    library_.answer(engine_, &queries, &answers);
    parent_.report(HostReport::Kind::answered, {},
                   std::chrono::duration<double>(Clock::now() - start).count());
  }

 private:
  void release() {
    if (engine_) library_.release(engine_);
    engine_ = nullptr;
  }

  const ParentPipes& parent_;
  const Library& library_;
  const SharedQueries& asked_;
  SharedAnswers& told_;
  HostScene scene_;
  lorentz_engine* engine_ = nullptr;
};

int run(const std::string& file) {
  const ParentPipes parent;
  void* const queries = mmap(nullptr, sizeof(SharedQueries), PROT_READ, MAP_SHARED, kSharedMemory, 0);
  void* const answers = mmap(nullptr, sizeof(SharedAnswers), PROT_READ | PROT_WRITE, MAP_SHARED,
                             kSharedMemory, sizeof(SharedQueries));
  close(kSharedMemory);
  if (queries == MAP_FAILED || answers == MAP_FAILED) {
    parent.report(HostReport::Kind::not_loaded, "found no memory for its answers");
    return EXIT_FAILURE;
  }
  Library library;
  const std::string obstacle = load(file, library);
  if (!obstacle.empty()) {
    parent.report(HostReport::Kind::not_loaded, obstacle);
    return EXIT_FAILURE;
  }
  const char* const claim = library.claim ? library.claim() : nullptr;
  parent.report(HostReport::Kind::loaded, claim ? claim : "");
  Host host(parent, library, *static_cast<const SharedQueries*>(queries),
            *static_cast<SharedAnswers*>(answers));
  for (HostOrder order{}; parent.read(&order, sizeof order);)
    if (order.kind == HostOrder::Kind::queries)
      host.answer(order.size);
    else if (!host.prepare(order.size))
      break;
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace lorentz::question

int main(int, char** arguments) {
  return lorentz::question::run(arguments[1]);
}
