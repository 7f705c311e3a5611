// A shared library with the interface of <lorentz/engine.h>, loaded in a process of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include <lorentz/scene.hpp>
#include "question/library_host/host_messages.hpp"
#include "question/process.hpp"

namespace lorentz::question {

/// What came of an order to the process.
struct HostReply {
  enum class Fate {
    reported,  ///< as `report` and `text` say
    failed,    ///< it died, or was silent too long; `text` says how: "died (exit 3)"
    enough     ///< it was not waited for to the end
  };
  Fate fate = Fate::reported;
  HostReport report{};
  std::string text = {};

  bool is(HostReport::Kind kind) const { return fate == Fate::reported && report.kind == kind; }
};

/// How long one waits for a reply.
struct HostPatience {
  double seconds;                ///< of silence; a row that is answered breaks it
  std::function<bool()> enough;  ///< asked often; may be empty
};

/// For one thread. After a reply that failed, or was not waited for, nothing more is ordered.
class LibraryProcess {
 public:
  /// Throws FileError if no process can be started. load() comes first.
  explicit LibraryProcess(const std::string& file);
  ~LibraryProcess();
  LibraryProcess(const LibraryProcess&) = delete;
  LibraryProcess& operator=(const LibraryProcess&) = delete;

  HostReply load(const HostPatience& patience);
  HostReply prepare(const Scene& scene, int threads, const HostPatience& patience);
  /// The first rows of queries().
  HostReply answer(std::size_t rows, const HostPatience& patience);

  /// The memory of both; answers() is the library's to write, now and later.
  SharedQueries& queries() { return *queries_; }
  const SharedAnswers& answers() const { return *answers_; }
  /// How many of the first rows were answered before the first that was not.
  std::size_t answered_in_order(std::size_t rows) const;

  /// Lets it release what it has, and end.
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

/// Loads the library, and lets it go. Returns the line by which it says what it claims, or an empty text. Throws
/// FileError, with the remedy, if it cannot be loaded.
std::string claim_line_of_library(const std::string& file);

}  // namespace lorentz::question
