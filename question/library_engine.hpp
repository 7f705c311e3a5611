// `lib:FILE.so`: a shared library as an engine, asked by columns in a process of its own
// (docs/command_engines.md).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "question/external_answerer.hpp"
#include "question/library_process.hpp"

namespace lorentz::question {

/// Queries are gathered and asked in blocks, small ones first. Every query gets one answer, in order. If the
/// library gives none, the answer is an `error` that says what the library did instead.
///
/// A library that dies or falls silent is loaded again. The query at fault is the one on which it fails
/// alone, as the first after loading. The first row without an answer is tried this way, after the rows
/// before it.
class LibraryEngine final : public ExternalAnswerer {
 public:
  LibraryEngine(std::string file, const AnswererOptions& options);

  void ask(const Id& id, const Query& query) override;
  void drain() override;
  void finish() override;

 private:
  struct Waiting {
    Id id;
    Query query;
  };

  void enter(const Scene& scene) override;
  HostPatience patience() const;
  HostPatience loading_patience() const;

  void answer_some();
  bool get_ready();
  bool is_ready(const HostReply& reply, HostReport::Kind kind, const char* meanwhile);
  std::size_t next_block();
  void write_row(std::size_t row, const Query& query);
  void take_answers(std::size_t rows);
  std::string read_row(std::size_t row, Answer& answer) const;
  std::string read_obstacle(std::size_t row, ObstacleId& obstacle) const;

  void failed_on(std::size_t rows, const std::string& what);
  void ask_again_in_halves(std::size_t rows);
  void blame_first(const std::string& what);
  void abandon();
  void complain_of_first(const std::string& what);
  void deliver_first(Reply reply);

  const std::string file_;
  std::deque<Waiting> waiting_;  // queries without an answer, in order
  std::uint64_t delivered_ = 0;

  std::optional<LibraryProcess> process_;
  bool is_prepared_ = false;            // the process is prepared for the scene
  bool is_fresh_ = false;               // it has not been asked anything yet
  std::optional<std::string> why_not_;  // the scene is not supported

  std::size_t block_;                     // rows of the next block
  std::optional<std::uint64_t> suspect_;  // the query with this number is asked alone
  std::string suspicion_;                 // what happened when it was not alone
};

}  // namespace lorentz::question
