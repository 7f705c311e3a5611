// `cmd:COMMAND`: another program as an engine. It reads a query stream and writes an answer stream; what it
// is asked, and what is made of its faults, is in docs/command_engines.md.
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
#include "question/answerer.hpp"
#include "question/engine_complaints.hpp"
#include "question/process.hpp"

namespace lorentz::question {

/// Keeps many queries on their way to the program and takes its answers as they come, writing and reading by
/// turns, as the pipes allow. The program's ids are running numbers, whatever the user's are. Every query
/// gets one answer, in order: where the program gave none, an `error` that says what it did instead.
///
/// A program that dies or falls silent is started anew for the queries after the one at fault. Which one that
/// was is plain if it answers line by line: the first without an answer. If it keeps answers back, some of
/// them were lost with it: then the next start gets one query only, the one after that two, ..., each start
/// is told the end at once, and the one at fault is the query that it failed on alone.
class CommandEngine final : public Answerer {
 public:
  /// Queries on their way at most.
  static constexpr std::size_t kWindow = 4096;

  CommandEngine(std::string command, const AnswererOptions& options);

  void ask(const Id& id, const Query& query) override;
  void ask_text(const Id& id, const std::string& question) override;
  void drain() override;
  void finish() override;
  bool idle(int descriptor) override;
  bool failed() const override { return failed_; }
  bool given_up() const override { return given_up_in_ != nullptr; }
  bool is_hopeless() const override { return given_up() && !ever_answered_; }
  void try_again() override;
  std::optional<OwnTime> own_time() const override { return own_time_; }
  std::string take_last_words() override;
  std::optional<double> processor_seconds() const override;
  std::uint64_t batch_size() const override { return 256; }

 private:
  void enter(const Scene& scene) override;

  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

  struct OpenQuery {
    Id id;
    Query query;
    std::shared_ptr<const Scene> scene;
    std::string text = {};     // in place of the query, where it is none
    bool passed_over = false;  // it got no answer
  };
  void add(OpenQuery asked);
  static void append_line(std::string& out, const Id& id, const OpenQuery& asked);

  // When a program lets go of its answers, as far as we have seen.
  enum class Manner {
    unknown,
    line_by_line,  // once it answered all it had been asked, with more to come
    in_blocks,     // it needs to be told the end for the last answers,
    at_end         // or for any
  };

  struct Run;  // of the program

  // Everything happens in steps: write what it takes, read what it gives, look at the clock.
  enum class Wait {
    no,
    yes,
    for_all,  // nothing is asked before all answers are there,
    for_good  // nor afterwards
  };
  void step(Wait wait, int other_descriptor = -1);
  void start();
  bool is_enough() const { return options_.enough && options_.enough(); }
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
  void deliver_first(Answer& answer, Origin origin);

  Ending end_of(Run& run, std::chrono::milliseconds grace);
  void run_is_over();
  void learn_from_run();
  void run_failed(const std::string& what);
  void give_up();
  void tell(const std::string& what) const;
  void complain(const std::string& what, const OpenQuery* asked);

  std::string command_;
  AnswererOptions options_;
  EngineComplaints complaints_;
  ExchangeReader reader_;
  std::shared_ptr<const Scene> scene_;
  std::deque<OpenQuery> open_;      // without an answer, in order
  std::uint64_t first_number_ = 1;  // of open_.front(); the program knows the queries by these
  std::deque<OpenQuery> recent_;    // the last ones before: should it answer one again, or late

  std::shared_ptr<Run> run_;  // or null: it is started when there is something to ask
  Manner manner_ = Manner::unknown;
  const Seconds patience_;        // of silence, before a program of unknown manner is told the end
  Seconds first_patience_;        // the same before it answers anything: it may be slow to start
  Seconds slowest_start_{0};      // to a first answer
  double spent_ = 0;              // seconds of processors, of former runs
  std::string last_words_;        // of former runs
  int silent_runs_ = 0;           // that had to be told the end before the last answers came
  std::size_t limit_ = kNoLimit;  // queries for the next run, while the one at fault is sought
  int failures_in_row_ = 0;
  bool failed_ = false, ever_answered_ = false;
  std::optional<OwnTime> own_time_;           // of all runs that told it
  std::shared_ptr<const Scene> given_up_in_;  // or null: it is not given up

  std::set<std::string> unknown_keys_;  // that were told of
};

}  // namespace lorentz::question
