// A shared library with the interface of <lorentz/engine.h>, loaded in a process of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <lorentz/scene.hpp>
#include "question/library_host/host_messages.hpp"
#include "question/process.hpp"

namespace lorentz::question {

/// The process's reply to an order.
struct HostReply {
  enum class Fate {
    reported,  ///< see `report` and `text`
    failed,    ///< it died, or was silent too long; `text` says how: "died (exit 3)"
    enough     ///< the wait was broken off
  };
  Fate fate = Fate::reported;
  HostReport report{};
  std::string text = {};

  bool is(HostReport::Kind kind) const { return fate == Fate::reported && report.kind == kind; }
};

/// How long to wait for a reply.
struct HostPatience {
  double seconds;                ///< of silence; an answered row ends it
  std::function<bool()> enough;  ///< called often, true breaks the wait off; may be empty
};

/// For one thread. After a reply that failed, or a wait that was broken off, no more orders may be given.
class LibraryProcess {
 public:
  /// Throws FileError if no process can be started. load() must be called first.
  explicit LibraryProcess(const std::string& file);
  ~LibraryProcess();
  LibraryProcess(const LibraryProcess&) = delete;
  LibraryProcess& operator=(const LibraryProcess&) = delete;

  HostReply load(const HostPatience& patience);
  HostReply prepare(const Scene& scene, int threads, const HostPatience& patience);
  /// Has the first `rows` rows of queries() answered.
  HostReply answer(std::size_t rows, const HostPatience& patience);

  /// The memory that both processes share. The library may write to answers() at any time.
  SharedQueries& queries() { return *queries_; }
  const SharedAnswers& answers() const { return *answers_; }
  /// The number of rows before the first that is not answered.
  std::size_t answered_in_order(std::size_t rows) const;

  /// Lets the library release its resources, and the process end.
  Ending end();

 private:
  struct Memory;
  LibraryProcess(const std::string& file, const Memory& memory);
  HostReply exchange(const std::string& order, std::size_t rows, const HostPatience& patience);
  bool take_report(HostReply& reply);
  bool take_whole_report(HostReply& reply);

  SharedQueries* queries_;
  SharedAnswers* answers_;
  Process process_;
  std::string received_;
};

/// Loads the library and unloads it again. Returns the line with its claim, or an empty text. Throws
/// FileError, with the remedy, if it cannot be loaded.
std::string claim_line_of_library(const std::string& file);

}  // namespace lorentz::question
