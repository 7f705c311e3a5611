#include "question/command_engine.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <set>

#include <lorentz/exchange.hpp>
#include "question/complaints.hpp"
#include "question/engines.hpp"
#include "question/scene_engine.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr std::size_t kWindow = 4096;                 // the largest number of queries in flight
constexpr std::size_t kWrittenAtOnce = 65536;         // queries are written out in pieces of this size
constexpr std::size_t kAskedBetweenSteps = 256;       // because a step costs a few microseconds
constexpr double kPatience = 0.5;                     // seconds
constexpr double kBetweenLooks = 0.1;                 // seconds between calls of AnswererOptions::enough
constexpr std::chrono::milliseconds kGrace{1000};     // to end, once its input or its output is closed
constexpr std::chrono::milliseconds kLastGrace{250};  // the same if it is enough
constexpr std::size_t kRecent = 64;
constexpr int kMostFailuresInRow = 5;  // queries without an answer, after which it is given up

std::string shown(std::string_view text) {
  // Quotes are not escaped here: that happens once, where the message becomes part of an answer.
  constexpr std::size_t kShown = 120;
  return printable(shortened(text, kShown));
}

// The id as a number; 0 for a text (with its quotes), a negative number, or one that is too large.
std::uint64_t number_of(const Id& id) {
  std::uint64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number);
  return number;
}

// Keeps many queries in flight and takes the program's answers as they come; it writes and reads by turns,
// as the pipes allow. The program sees running numbers as ids, whatever the user's ids are. Every query gets
// one answer, in order. If the program gives none, the answer is an `error` that says what the program did
// instead.
//
// A program that dies or falls silent is started again for the queries after the one at fault. If it answers
// line by line, the query at fault is the first without an answer. If it holds answers back, some of them
// were lost with it. Then the next start gets only one query, the one after that two, ...; the input of each
// is closed at once, and the query at fault is the one on which the program fails alone.
//
// A library is asked by a program of ours, whose manner is known: it answers all that it has been asked, many
// queries a call. The query at fault is one on which it fails as the first after a start. So after a failure
// the next start gets the same queries, one a call.
class CommandEngine final : public Answerer {
 public:
  /// Makes the program; `row_by_row`: of a library (library_program).
  using MakeProgram = std::function<Executable(bool row_by_row)>;

  CommandEngine(MakeProgram program, const std::string& kind, const std::string& name,
                const AnswererOptions& options)
      : options_(options),
        kind_(kind),
        complaints_(kind + ':' + name, options.listener),
        program_(std::move(program)),
        is_library_(kind == "lib"),
        manner_(is_library_ ? Manner::line_by_line : Manner::unknown),
        patience_(std::min(kPatience, options.timeout / 4)),
        first_patience_(patience_) {
    reader_.on_unknown_key([this](const std::string& key) { see_unknown_key(key); });
    if (is_library_) own_time_.emplace();
  }

  void ask(const Id& id, const Query& query) override { ask_until(id, query, kForEver); }

  void ask_until(const Id& id, const Query& query, double max_time) override {
    add({id, query, scene_, std::min(max_time, limit_of(options_.request))});
  }

  void ask_text(const Id& id, const std::string& question) override {
    if (is_library_) return Answerer::ask_text(id, question);
    add({id, {}, scene_, kForEver, question});
  }

  void drain() override {
    while (!open_.empty()) step(Wait::for_all);
  }

  void finish() override {
    while (run_ || !open_.empty()) step(Wait::for_good);
    complaints_.finish();
  }

  bool failed() const override { return failed_; }
  bool given_up() const override { return given_up_; }
  bool is_hopeless() const override { return given_up_ && !ever_answered_; }
  void try_again() override {
    if (!given_up_ || is_hopeless()) return;
    given_up_ = false;
    failures_in_row_ = 0;
  }
  std::optional<OwnTime> own_time() const override { return own_time_; }
  std::uint64_t batch_size() const override { return 256; }

  bool idle(int descriptor) override {
    if (open_.empty()) return false;
    step(Wait::yes, descriptor);
    pollfd input{descriptor, POLLIN, 0};
    return ::poll(&input, 1, 0) == 0;
  }

  std::string take_last_words() override {
    if (run_) run_->process.pass_on_errors();
    std::string words = run_ ? run_->process.take_last_words() : std::string();
    std::string former = std::exchange(last_words_, {});
    return words.empty() ? former : words;
  }

  std::optional<double> processor_seconds() const override {
    return spent_ + (run_ && !run_->has_ended ? run_->process.processor_seconds() : 0);
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

  struct OpenQuery {
    Id id;
    Query query;
    std::shared_ptr<const Scene> scene;
    double max_time = kForEver;
    std::string text = {};     // in place of an invalid query
    bool passed_over = false;  // it got no answer
  };

  // When the program writes its answers, as far as observed.
  enum class Manner {
    unknown,
    line_by_line,  // it has once answered all it had been asked, with more to come
    in_blocks,     // it writes the last answers only after the end of its input
    at_end         // it writes all answers only after the end of its input
  };

  // One life of the program.
  struct Run {
    explicit Run(const Executable& program) : process(program) {}

    Process process;
    LineBuffer lines;
    std::string to_write;
    std::size_t given = 0;        // queries, in all
    std::size_t outstanding = 0;  // given and without an answer: the first `outstanding` of open_
    std::size_t answers_before_end = 0;
    std::shared_ptr<const Scene> scene;
    std::uint64_t first_of_scene = 0;  // number of the first query after the last scene line
    bool greeting = false;             // it has one query only, to see whether it answers with more to come
    bool ending = false;               // gets no more queries; its input is closed as soon as all is written
    std::string doing;                 // what a library does, if that is not to answer
    bool told_for_silence = false, stopped_reading = false, at_end = false;
    bool has_ended = false;          // and its processor time is counted
    std::size_t bad_bytes = 0;       // of lines that are not answers, since the last answer
    std::string instead;             // what it wrote where the first outstanding answer should have been
    std::optional<Answer> nameless;  // an error with id null, about the scene or its first query
    Clock::time_point started = Clock::now();
    std::optional<Clock::time_point> first_answer;
    Clock::time_point last_answer = started;  // or when something became outstanding
    Clock::time_point last_move = started;    // an answer, or something written
  };

  // Everything happens in steps: write what the program takes, read what it gives, look at the clock.
  enum class Wait {
    no,
    yes,
    for_all,  // nothing is asked before all answers have come
    for_good  // nor is anything asked afterwards
  };

  void enter(const Scene& scene) override { scene_ = std::make_shared<const Scene>(scene); }

  static void append_line(std::string& out, const Id& id, const OpenQuery& asked) {
    if (asked.text.empty())
      append_query_line(out, id, asked.query, *asked.scene, asked.max_time);
    else
      out +=
          json::line_of([&](json::Members& line) { line.add("id", json::Raw{id}).add_members(asked.text); });
  }

  void add(OpenQuery asked) {
    open_.push_back(std::move(asked));
    if (given_up()) give_up();
    if (open_.empty()) return;
    const std::size_t not_given = open_.size() - (run_ ? run_->outstanding : 0);
    if (not_given % kAskedBetweenSteps == 0) step(Wait::no);
    while (open_.size() >= kWindow) step(Wait::yes);
  }

  // ---- one step

  void step(Wait wait, int other_descriptor = -1) {
    // The program may have ended by itself meanwhile; then the next query is not at fault.
    if (run_ && run_->outstanding == 0 && run_->given > 0) read();
    if (!run_ && open_.empty()) return;
    if (options_.enough && options_.enough()) return abandon();
    if (!run_) start();
    const std::shared_ptr<Run> run = run_;  // keeps it alive if it ends below
    encode();
    if (wait == Wait::for_good && run->outstanding == open_.size()) run->ending = true;
    wait_for_pipes(wait, other_descriptor);
    write();
    read();
    if (run_ == run) look_at_clock(wait);
  }

  void start() {
    run_ = std::make_shared<Run>(program_(limit_ != kNoLimit));
    run_->greeting = (manner_ == Manner::unknown || is_library_) && limit_ == kNoLimit;
    if (is_library_) run_->doing = "loads";
  }

  // A program that owes nothing gets a little time to end by itself. Being too slow for the available time is
  // not a fault, unless it never gave any answer.
  void abandon() {
    const bool owes = run_ && run_->outstanding > 0;
    if (owes && !ever_answered_)
      complain_of(&open_.front(), fmt::format("gave no answer in {:.3g} s, which was all the time there is",
                                              Seconds(Clock::now() - run_->started).count()));
    if (run_) end_of(*run_, owes ? kGrace * 0 : kLastGrace);
    run_.reset();
    while (!open_.empty()) deliver_first({error("was not waited for: the time was over"), Origin::not_asked});
  }

  // Writes queries as text, up to the number that may be given and the size of a piece.
  void encode() {
    Run& run = *run_;
    const std::size_t most = run.greeting ? 1 : limit_;
    while (!run.ending && run.outstanding < open_.size() && run.given < most &&
           run.to_write.size() < kWrittenAtOnce) {
      const OpenQuery& asked = open_[run.outstanding];
      if (run.scene != asked.scene) {
        append_scene_line(run.to_write, *asked.scene);
        run.scene = asked.scene;
        run.first_of_scene = first_number_ + run.outstanding;
      }
      append_line(run.to_write, std::to_string(first_number_ + run.outstanding), asked);
      if (run.outstanding == 0) run.last_answer = Clock::now();
      ++run.outstanding;
      ++run.given;
    }
    if (run.given == limit_) run.ending = true;
  }

  void wait_for_pipes(Wait wait, int other_descriptor) {
    Run& run = *run_;
    if (run.ending && run.to_write.empty()) run.process.close_input();
    pollfd pipes[4] = {{run.process.output(), POLLIN, 0},
                       {run.to_write.empty() ? -1 : run.process.input(), POLLOUT, 0},
                       {run.process.errors(), POLLIN, 0},
                       {other_descriptor, POLLIN, 0}};
    double seconds = wait == Wait::no ? 0 : until_next_look(wait).count();
    if (options_.enough) seconds = std::min(seconds, kBetweenLooks);
    ::poll(pipes, 4, static_cast<int>(std::clamp(std::ceil(1000 * seconds), 0.0, 1e6)));
  }

  void write() {
    Run& run = *run_;
    if (run.to_write.empty()) return;
    const auto count = run.process.write(run.to_write);
    if (!count) {  // it closed its input, but may still answer what it has read
      run.stopped_reading = run.ending = true;
      run.to_write.clear();
    } else if (*count > 0) {
      run.to_write.erase(0, *count);
      run.last_move = Clock::now();
    }
  }

  void read() {
    const std::shared_ptr<Run> run = run_;
    const LineBuffer::Read result = run->lines.read_from(run->process.output());
    run->process.pass_on_errors();
    run->at_end = result == LineBuffer::Read::end;
    if (result == LineBuffer::Read::nothing) return;
    for (LineReader::Line line; run->lines.next(line);) take_line(line);
    if (run->bad_bytes > LineBuffer::kMaxLine || run->lines.is_too_long()) return stop_flood();
    if (run->at_end) run_is_over();
  }

  // ---- the clock

  // How long a program may be silent before its input is closed, in case it waits for that.
  Seconds patience(Wait wait) const {
    const bool at_once = manner_ == Manner::at_end || (manner_ == Manner::in_blocks && wait == Wait::for_all);
    if (at_once) return Seconds(0);
    return run_->greeting ? first_patience_ : patience_;
  }

  // How long it may be silent before it has failed.
  Seconds timeout() const {
    const Seconds ordinary(options_.timeout), first(options_.start_timeout);
    if (run_->first_answer || first <= ordinary) return ordinary;
    return ever_answered_ ? std::min(first, ordinary + 2 * slowest_start_) : first;
  }

  Seconds until_next_look(Wait wait) const {
    const Run& run = *run_;
    const auto left = [](Seconds all, Clock::time_point since) -> Seconds {
      return all - (Clock::now() - since);
    };
    if (run.outstanding == 0) return run.ending ? left(kGrace, run.last_move) : timeout();
    const Seconds until_timeout = left(timeout(), run.last_answer);
    const bool only_timeout = manner_ == Manner::line_by_line || run.ending || !run.to_write.empty();
    if (only_timeout && !run.nameless) return until_timeout;
    return std::min(until_timeout, left(run.nameless ? patience_ : patience(wait), run.last_move));
  }

  void look_at_clock(Wait wait) {
    Run& run = *run_;
    const auto now = Clock::now();
    const auto silent_for = [&](Seconds time) { return now - run.last_move >= time; };
    if (run.outstanding == 0) {
      if (run.ending && silent_for(kGrace)) run_is_over();
      return;
    }
    if (run.nameless && silent_for(patience_)) return settle_nameless();
    if (now - run.last_answer >= timeout())
      return run_failed(fmt::format("{}gave no answer within {:.4g} s",
                                    run.stopped_reading ? "closed its input and " : "", timeout().count()),
                        Origin::silent);
    if (manner_ == Manner::line_by_line || run.ending || wait == Wait::no || !run.to_write.empty()) return;
    // A trickle of new queries does not prevent this.
    const bool long_since = now - run.last_answer >= timeout() / 2;
    if (!silent_for(patience(wait)) && !long_since) return;
    const bool more_to_give = run.outstanding < open_.size();
    if (run.greeting) run.last_move = now;
    if (!run.greeting || !more_to_give) run.ending = run.told_for_silence = !more_to_give;
    run.greeting = false;
  }

  // ---- what it wrote

  // Reports each unknown key once; with --strict it makes the line invalid.
  void see_unknown_key(const std::string& key) {
    constexpr std::size_t kMostKeys = 20;
    if (options_.strict) throw InputError("the key " + json_quoted(key) + " is not known");
    if (unknown_keys_.size() < kMostKeys && unknown_keys_.insert(key).second)
      complaints_.tell("writes the key " + json_quoted(key) + ", which is not known, and is ignored");
  }

  void take_line(const LineReader::Line& line) {
    Id id;
    Answer answer;
    std::size_t components = 0;
    try {
      if (take_own_time(line) || take_doing(line)) return;
      if (reader_.read_answer_line(line, id, answer, components)) take_answer(id, answer, components);
    } catch (const InputError& error) {
      const std::string what =
          fmt::format("wrote a line that is not an answer, {} ({})", shown(line.text), error.what());
      run_->bad_bytes += line.text.size() + 1;
      if (run_->outstanding > 0 && number_of(id) == first_number_)
        answer_first_with_error(what);
      else
        take_no_answer(what);
    }
  }

  bool take_own_time(const LineReader::Line& line) {
    const auto time = own_time_in(line.text, [&](const std::string& key) { see_unknown_key(key); });
    if (!time) return false;
    if (!own_time_) own_time_.emplace();
    own_time_->seconds += time->seconds;
    own_time_->queries += time->queries;
    return true;
  }

  bool take_doing(const LineReader::Line& line) {
    const auto doing = is_library_ ? doing_in(line.text) : std::nullopt;
    if (doing) run_->doing = *doing;
    return doing.has_value();
  }

  // Takes a line that answers nothing. The next answer shows whether it stands in the place of an answer.
  void take_no_answer(const std::string& what) {
    run_->instead = what;
    complain_of(run_->outstanding > 0 ? &open_.front() : nullptr, what);
  }

  void take_answer(const Id& id, Answer& answer, std::size_t components) {
    Run& run = *run_;
    if (id == "null" && answer.outcome == Outcome::error && run.outstanding > 0)
      return is_library_ ? take_no_answer(answer.message) : take_nameless(answer);
    const std::uint64_t number = number_of(id);
    if (number == 0 || number >= first_number_ + run.outstanding)
      return take_no_answer("gave an answer with an id that no query has, " + shortened(id, 40));
    if (number < first_number_) return take_unasked(number);
    if (run.nameless && number > first_number_) settle_nameless();
    while (number > first_number_) {
      --run.outstanding;
      pass_over(run, "gave no answer to this query before that to a later one");
    }
    if (run.nameless)
      complaints_.tell(fmt::format("says of the scene: {}", printable(run.nameless->message)));
    run.nameless.reset();
    const bool is_fault = is_library_ && answer.outcome == Outcome::error && !answer.unsupported;
    const std::string flaw = is_fault ? answer.message : flaw_of_answer(answer, components);
    if (flaw.empty())
      answer_first(std::move(answer));
    else
      answer_first_with_error(flaw);
  }

  // An error without an id is for the first query that waits. Directly after a scene line it may be for the
  // scene.
  void take_nameless(Answer& answer) {
    if (run_->nameless) settle_nameless();
    if (first_number_ == run_->first_of_scene)
      run_->nameless = std::move(answer);
    else
      answer_first(std::move(answer));
  }

  void settle_nameless() { answer_first(*std::exchange(run_->nameless, std::nullopt)); }

  // Takes an answer to an earlier query, which is settled already.
  void take_unasked(std::uint64_t number) {
    const std::uint64_t back = first_number_ - number;
    const OpenQuery* asked = back <= recent_.size() ? &recent_[recent_.size() - back] : nullptr;
    const bool late = asked && asked->passed_over;
    run_->instead = late ? "answered an earlier query, too late" : "answered an earlier query again";
    complain_of(asked, late ? "answered this query after a later one" : "answered this query again");
  }

  // The first query gets no answer. `what` says why; what the program wrote instead is added.
  void pass_over(Run& run, std::string what, Origin origin = Origin::fault) {
    if (!run.instead.empty()) {
      origin = Origin::bad_line;
      what += "; before that it " + std::exchange(run.instead, {});
    }
    complain_of(&open_.front(), what);
    open_.front().passed_over = true;
    deliver_first({error(what), origin});
  }

  std::string flaw_of_answer(const Answer& answer, std::size_t components) const {
    if (answer.outcome != Outcome::hit && answer.outcome != Outcome::inside) return {};
    const Scene& scene = *open_.front().scene;
    const bool exists = answer.obstacle.lattice < static_cast<int>(scene.lattices.size());
    const int needed = Components(scene).of_cells(answer.obstacle.lattice);
    if (exists && components != static_cast<std::size_t>(needed))
      return fmt::format("gave a cell of {} components of a lattice of {} vectors", components, needed);
    if (answer.outcome == Outcome::hit && !answer.time && options_.applies_limits &&
        open_.front().max_time < kForEver)
      return "gave a hit without its time, which a limit needs";
    return {};
  }

  void answer_first(Answer answer, Origin origin = Origin::engine) {
    Run& run = *run_;
    --run.outstanding;
    if (!run.ending) ++run.answers_before_end;
    run.last_answer = run.last_move = Clock::now();
    if (!run.first_answer) {
      run.first_answer = run.last_answer;
      slowest_start_ = std::max(slowest_start_, Seconds(*run.first_answer - run.started));
    }
    run.instead.clear();
    run.bad_bytes = 0;
    failures_in_row_ = 0;
    ever_answered_ = true;
    if (run.outstanding == 0 && !run.ending) manner_ = Manner::line_by_line;
    if (manner_ == Manner::line_by_line) run.greeting = false;
    const OpenQuery& asked = open_.front();
    if (options_.request.detail) add_detail(asked.query, *asked.scene, answer);
    deliver_first({std::move(answer), origin});
  }

  void answer_first_with_error(const std::string& what) {
    complain_of(&open_.front(), what);
    answer_first(error(what), Origin::bad_line);
  }

  void deliver_first(Reply reply) {
    recent_.push_back(std::move(open_.front()));
    if (recent_.size() > kRecent) recent_.pop_front();
    open_.pop_front();
    ++first_number_;
    deliver(reply);
  }

  // ---- its end

  Ending end_of(Run& run, std::chrono::milliseconds grace) {
    const Ending ending = run.process.end(grace);
    if (!std::exchange(run.has_ended, true)) spent_ += run.process.processor_seconds();
    if (std::string words = run.process.take_last_words(); !words.empty()) last_words_ = std::move(words);
    return ending;
  }

  // Its output has ended, or its input was closed long ago.
  void run_is_over() {
    const std::shared_ptr<Run> run = run_;
    if (run->nameless) settle_nameless();
    const Ending ending = end_of(*run, run->at_end ? kGrace : kGrace * 0);
    if (run->outstanding > 0) {
      if (ending.how == Ending::How::still_ran)
        return run_failed("closed its output before this query's answer");
      if (ending.is_good()) return run_failed("ended (exit 0) without an answer to this query");
      return run_failed(fmt::format("died ({})", ending.text()));
    }
    if (!run->ending)
      complain(fmt::format("ended ({}) before it was told to", ending.text()));
    else if (ending.how == Ending::How::still_ran)
      complaints_.tell("did not end when its input did, and was killed");
    else if (!ending.is_good())
      complaints_.tell(fmt::format("ended with {} after its last answer", ending.text()));
    learn_from_run();
    run_.reset();
  }

  // It answered everything. What the run showed is used for the next one.
  void learn_from_run() {
    const Run& run = *run_;
    if (!suspicion_.empty())
      complain(std::exchange(suspicion_, {}) +
               " where it was asked more than one query, and answers each by itself");
    if (limit_ != kNoLimit) limit_ = limit_ < kWindow && !is_library_ ? 2 * limit_ : kNoLimit;
    if (!run.told_for_silence || manner_ != Manner::unknown) return;
    // It may only be slow to start. It gets that time once; after that silence counts.
    const double longest = std::max(options_.timeout, options_.start_timeout);
    first_patience_ = std::max(
        first_patience_, std::min(1.5 * Seconds(*run.first_answer - run.started), Seconds(longest / 2)));
    if (++silent_runs_ < 2) return;
    manner_ = run.answers_before_end > 0 ? Manner::in_blocks : Manner::at_end;
  }

  // It died or fell silent with queries outstanding.
  void run_failed(const std::string& fate, Origin origin = Origin::fault) {
    const std::shared_ptr<Run> run = std::move(run_);
    end_of(*run, kGrace * 0);
    if (run->doing == "releases") return complain(fate + " while it released the scene before");
    const std::string what = fate + place_of(*run, fate);
    const std::size_t unanswered = run->outstanding;
    if (is_library_ && run->first_answer) {
      suspicion_ = fate;
      limit_ = unanswered;
      return;
    }
    if (!is_library_ && manner_ != Manner::line_by_line && unanswered > 1) {
      limit_ = limit_ == kNoLimit ? 1 : unanswered / 2;
      return complain_of(
          &open_.front(),
          fmt::format("{}, or on one of the {} after it; they are asked again, fewer at a time", what,
                      unanswered - 1));
    }
    pass_over(*run, what, origin);
    suspicion_.clear();
    if (limit_ != kNoLimit) limit_ = is_library_ ? kNoLimit : 1;
    if (++failures_in_row_ < kMostFailuresInRow) return;
    complaints_.tell_once(
        fmt::format("is given up after {} failures in a row without an answer", kMostFailuresInRow));
    given_up_ = true;
    given_up_in_ = recent_.back().scene;
    give_up();
  }

  // Where a program failed.
  static std::string place_of(const Run& run, const std::string& fate) {
    if (run.doing == "loads") return " while it was loaded";
    if (run.doing == "prepares") return " while it prepared the scene";
    return fate.starts_with("died") ? " on this query" : "";
  }

  void stop_flood() {
    const std::string what = "wrote more than 1 MiB that is not an answer";
    if (run_->outstanding > 0) return run_failed(what);
    complain(what);
    end_of(*std::exchange(run_, nullptr), kGrace * 0);
  }

  // The rest is not asked, up to the next scene: the failures may have been due to this one. The next scene
  // gets one more start if the program ever answered.
  void give_up() {
    while (!open_.empty()) {
      if (open_.front().scene != given_up_in_ && ever_answered_) {
        given_up_ = false;
        failures_in_row_ = kMostFailuresInRow - 1;
        return;
      }
      deliver_first({error(fmt::format("was given up after {} failures in a row; this query was not asked",
                                       kMostFailuresInRow)),
                     Origin::not_asked});
    }
  }

  void complain(const std::string& what) {
    failed_ = true;
    complaints_.tell_once(what);
  }

  // Reports what went wrong, with a stream that reproduces it.
  void complain_of(const OpenQuery* asked, const std::string& what) {
    if (!asked) return complain(what);
    failed_ = true;
    std::string line;
    append_line(line, asked->id, *asked);
    complaints_.tell_once(what, *asked->scene, line);
  }

  // Given in place of an answer.
  Answer error(const std::string& what) const { return Answer::error(kind_ + ' ' + what); }

  const AnswererOptions options_;
  const std::string kind_;
  Complaints complaints_;
  bool failed_ = false, ever_answered_ = false, given_up_ = false;
  int failures_in_row_ = 0;
  std::optional<OwnTime> own_time_;
  const MakeProgram program_;
  const bool is_library_;
  ExchangeReader reader_;
  std::shared_ptr<const Scene> scene_;
  std::deque<OpenQuery> open_;      // queries without an answer, in order
  std::uint64_t first_number_ = 1;  // of open_.front(); the program knows the queries by these
  std::deque<OpenQuery> recent_;    // the last ones before, in case it answers one again or late

  std::shared_ptr<Run> run_;  // null while there is nothing to ask
  Manner manner_;
  const Seconds patience_;        // of silence, before the input of a program of unknown manner is closed
  Seconds first_patience_;        // the same before it answers anything: it may be slow to start
  Seconds slowest_start_{0};      // until a first answer
  double spent_ = 0;              // processor seconds of former runs
  std::string last_words_;        // of former runs
  int silent_runs_ = 0;           // whose last answers came only after the end of their input
  std::size_t limit_ = kNoLimit;  // queries for the next run, during the search for the one at fault
  std::string suspicion_;         // how a library failed, until it is known on which query
  std::shared_ptr<const Scene> given_up_in_;  // the scene in which it was last given up

  std::set<std::string> unknown_keys_;  // that were reported
};

}  // namespace

std::unique_ptr<Answerer> command_engine(const std::string& command, const AnswererOptions& options) {
  const auto program = [command](bool) { return shell_command(command); };
  return std::make_unique<CommandEngine>(program, "cmd", command, options);
}

std::unique_ptr<Answerer> library_engine(const std::string& file, const AnswererOptions& options) {
  const auto program = [file, threads = options.jobs](bool row_by_row) {
    return library_program(file, threads, row_by_row);
  };
  return std::make_unique<CommandEngine>(program, "lib", file, options);
}

}  // namespace lorentz::question
