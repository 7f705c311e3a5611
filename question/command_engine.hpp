// `cmd:COMMAND`: an external program as an engine, which reads a query stream and writes an answer stream.
// docs/command_engines.md says what it is asked and how its faults are treated.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include <lorentz/exchange.hpp>
#include "question/external_answerer.hpp"
#include "question/process.hpp"

namespace lorentz::question {

/// Keeps many queries in flight and takes the program's answers as they come; it writes and reads by turns,
/// as the pipes allow. The program sees running numbers as ids, whatever the user's ids are. Every query gets
/// one answer, in order. If the program gives none, the answer is an `error` that says what the program did
/// instead.
///
/// A program that dies or falls silent is started again for the queries after the one at fault. If it answers
/// line by line, the query at fault is the first without an answer. If it holds answers back, some of them
/// were lost with it. Then the next start gets only one query, the one after that two, ...; the input of each
/// is closed at once, and the query at fault is the one on which the program fails alone.
class CommandEngine final : public ExternalAnswerer {
 public:
  /// The largest number of queries in flight.
  static constexpr std::size_t kWindow = 4096;

  CommandEngine(std::string command, const AnswererOptions& options);

  void ask(const Id& id, const Query& query) override;
  void ask_text(const Id& id, const std::string& question) override;
  void drain() override;
  void finish() override;
  bool idle(int descriptor) override;
  std::string take_last_words() override;
  std::optional<double> processor_seconds() const override;

 private:
  void enter(const Scene& scene) override;

  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

  struct OpenQuery {
    Id id;
    Query query;
    std::shared_ptr<const Scene> scene;
    std::string text = {};     // in place of an invalid query
    bool passed_over = false;  // it got no answer
  };
  void add(OpenQuery asked);
  static void append_line(std::string& out, const Id& id, const OpenQuery& asked);

  // When the program writes its answers, as far as observed.
  enum class Manner {
    unknown,
    line_by_line,  // it has once answered all it had been asked, with more to come
    in_blocks,     // it writes the last answers only after the end of its input
    at_end         // it writes all answers only after the end of its input
  };

  struct Run;  // one life of the program

  // Everything happens in steps: write what the program takes, read what it gives, look at the clock.
  enum class Wait {
    no,
    yes,
    for_all,  // nothing is asked before all answers have come
    for_good  // nor is anything asked afterwards
  };
  void step(Wait wait, int other_descriptor = -1);
  void start();
  void abandon();
  void encode();
  void wait_for_pipes(Wait wait, int other_descriptor);
  void write();
  void read();
  void look_at_clock(Wait wait);
  Seconds until_next_look(Wait wait) const;
  Seconds patience(Wait wait) const;
  Seconds timeout() const;

  void take_line(const LineReader::Line& line);
  void see_unknown_key(const std::string& key);
  bool take_own_time(const LineReader::Line& line);
  void take_no_answer(const std::string& what);
  void take_answer(const Id& id, Answer& answer, std::size_t components);
  void take_nameless(Answer& answer);
  void settle_nameless();
  void take_unasked(std::uint64_t number);
  void pass_over();
  std::string flaw_of_answer(const Answer& answer, std::size_t components) const;
  void answer_first(Answer& answer, Origin origin = Origin::engine);
  void answer_first_with_error(const std::string& what);
  void deliver_first(Reply reply);

  Ending end_of(Run& run, std::chrono::milliseconds grace);
  void run_is_over();
  void learn_from_run();
  void run_failed(const std::string& what);
  void give_up();
  void complain_of(const OpenQuery* asked, const std::string& what);

  std::string command_;
  ExchangeReader reader_;
  std::shared_ptr<const Scene> scene_;
  std::deque<OpenQuery> open_;      // queries without an answer, in order
  std::uint64_t first_number_ = 1;  // of open_.front(); the program knows the queries by these
  std::deque<OpenQuery> recent_;    // the last ones before, in case it answers one again or late

  std::shared_ptr<Run> run_;  // null while there is nothing to ask
  Manner manner_ = Manner::unknown;
  const Seconds patience_;        // of silence, before the input of a program of unknown manner is closed
  Seconds first_patience_;        // the same before it answers anything: it may be slow to start
  Seconds slowest_start_{0};      // until a first answer
  double spent_ = 0;              // processor seconds of former runs
  std::string last_words_;        // of former runs
  int silent_runs_ = 0;           // whose last answers came only after the end of their input
  std::size_t limit_ = kNoLimit;  // queries for the next run, during the search for the one at fault
  std::shared_ptr<const Scene> given_up_in_;  // the scene in which it was last given up

  std::set<std::string> unknown_keys_;  // that were reported
};

}  // namespace lorentz::question
