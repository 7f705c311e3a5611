#include "question/library_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include <lorentz/engine.h>
#include <lorentz/exchange.hpp>
#include "question/external_answerer.hpp"
#include "question/library_process.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr std::size_t kFirstBlock = 1;     // a query that fails alone is at fault
constexpr double kMostBlockSeconds = 0.5;  // soon enough for users who wait, and for the timeout

bool has_narrow_cell(const ObstacleId& obstacle) {
  return std::ranges::all_of(obstacle.cell, &Integer::fits_int64);
}

// Queries are gathered and asked in blocks, small ones first. Every query gets one answer, in order. If the
// library gives none, the answer is an `error` that says what the library did instead.
//
// A library that dies or falls silent is loaded again. The query at fault is the one on which it fails
// alone, as the first after loading. The first row without an answer is tried this way, after the rows
// before it.
class LibraryEngine final : public ExternalAnswerer {
 public:
  LibraryEngine(std::string file, const AnswererOptions& options)
      : ExternalAnswerer("lib", file, options), file_(std::move(file)), block_(kFirstBlock) {
    own_time_.emplace();
  }

  void ask(const Id& id, const Query& query) override {
    if (query.from && !has_narrow_cell(*query.from)) {
      drain();
      deliver({Answer::unsupported_because("lib: the cell of `from` is beyond 64 bits")});
      return;
    }
    waiting_.push_back({id, query});
    if (waiting_.size() >= SharedQueries::kMost) drain();
  }

  void drain() override {
    while (!waiting_.empty()) {
      if (is_enough()) return abandon();
      if (given_up())
        while (!waiting_.empty()) deliver_first(not_asked());
      else
        answer_some();
    }
  }

  void finish() override {
    drain();
    if (process_) {
      const Ending ending = process_->end();
      if (ending.how == Ending::How::still_ran)
        tell("did not end when it was told to, and was killed");
      else if (!ending.is_good())
        tell(fmt::format("ended with {} after its last answer", ending.text()));
    }
    process_.reset();
    finish_complaints();
  }

 private:
  struct Waiting {
    Id id;
    Query query;
  };

  void enter(const Scene&) override {
    drain();
    is_prepared_ = false;
    why_not_.reset();
    allow_one_more_start();
  }

  HostPatience patience() const {
    const double seconds =
        ever_answered_ ? options_.timeout : std::max(options_.timeout, options_.start_timeout);
    return {seconds, options_.enough};
  }

  // A busy machine is not the library's fault.
  HostPatience loading_patience() const {
    return {std::max(patience().seconds, AnswererOptions::kDefaultTimeout), options_.enough};
  }

  // ---- one block

  void answer_some() {
    if (!get_ready()) return;
    if (why_not_) {
      const std::string why = why_not_->empty() ? "" : ": " + printable(*why_not_);
      while (!waiting_.empty())
        deliver_first({Answer::unsupported_because("lib does not support this scene" + why)});
      return;
    }
    const std::size_t rows = next_block();
    for (std::size_t row = 0; row < rows; ++row) write_row(row, waiting_[row].query);
    const auto start = std::chrono::steady_clock::now();
    const HostReply reply = process_->answer(rows, patience());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (reply.fate == HostReply::Fate::enough) return abandon();
    const bool is_answered = reply.is(HostReport::Kind::answered);
    own_time_->seconds += is_answered ? reply.report.seconds : took.count();
    own_time_->queries += static_cast<double>(rows);
    if (!is_answered) return failed_on(rows, reply.text);
    take_answers(rows);
    const double most = std::min(kMostBlockSeconds, options_.timeout / 8);
    if (took.count() > most) block_ = std::max<std::size_t>(1, rows / 2);
    if (took.count() < most / 2 && rows == block_) block_ = std::min(2 * block_, SharedQueries::kMost);
  }

  // Loads the library and prepares the scene. If that fails, the first query that waits is blamed.
  bool get_ready() {
    if (suspect_ == delivered_ && !is_fresh_) process_.reset();
    if (!process_) {
      process_.emplace(file_);
      is_prepared_ = false;
      is_fresh_ = true;
      if (!is_ready(process_->load(loading_patience()), HostReport::Kind::loaded, "while it was loaded"))
        return false;
    }
    if (is_prepared_) return true;
    const HostReply reply = process_->prepare(scene(), options_.jobs, patience());
    if (reply.is(HostReport::Kind::unsupported)) {
      why_not_ = reply.text;
      ever_answered_ = true;
    } else if (!is_ready(reply, HostReport::Kind::prepared, "while it prepared the scene")) {
      return false;
    }
    return is_prepared_ = true;
  }

  bool is_ready(const HostReply& reply, HostReport::Kind kind, const char* meanwhile) {
    if (reply.is(kind)) return true;
    if (reply.fate == HostReply::Fate::enough)
      abandon();
    else if (reply.fate == HostReply::Fate::failed)
      blame_first(fmt::format("{} {}", reply.text, meanwhile));
    else
      blame_first(printable(reply.text));
    return false;
  }

  std::size_t next_block() {
    std::size_t rows = std::min({block_, waiting_.size(), SharedQueries::kMost});
    if (suspect_) rows = std::min(rows, std::max<std::size_t>(1, *suspect_ - delivered_));
    return rows;
  }

  void write_row(std::size_t row, const Query& query) {
    SharedQueries& rows = process_->queries();
    rows.from_lattice[row] = query.from ? query.from->lattice : -1;
    rows.from_atom[row] = query.from ? query.from->atom : -1;
    for (int k = 0; k < scene().dimension; ++k) {
      rows.x[k][row] = query.x[k], rows.v[k][row] = query.v[k];
      rows.from_cell[k][row] = query.from ? query.from->cell[k].int64() : 0;
    }
  }

  void take_answers(std::size_t rows) {
    is_fresh_ = false;
    note_answer();
    if (suspect_ == delivered_) {
      complain_of_first(suspicion_ + " where it was asked more than this query, and answers it alone");
      suspect_.reset();
    }
    for (std::size_t row = 0; row < rows; ++row) {
      Answer answer;
      const std::string flaw = read_row(row, answer);
      if (!flaw.empty()) {
        complain_of_first(flaw);
        deliver_first({error(flaw), Origin::fault});
        continue;
      }
      complete(answer, waiting_.front().query, scene());
      deliver_first({std::move(answer)});
    }
  }

  // Returns what is wrong with a row, or nothing. Each value is read once: the library may still write.
  std::string read_row(std::size_t row, Answer& answer) const {
    const SharedAnswers& rows = process_->answers();
    const std::int32_t outcome = rows.outcome[row];
    switch (outcome) {
      case LORENTZ_NEVER:
        answer = Answer::never();
        return {};
      case LORENTZ_UNDECIDED:
        answer = Answer::undecided();
        return {};
      case LORENTZ_UNSUPPORTED:
        answer = Answer::unsupported_because("lib does not support this query");
        return {};
      case LORENTZ_HIT:
      case LORENTZ_INSIDE:
        break;
      case SharedAnswers::kNone:
        return "gave no answer to this query: it left its outcome at -1";
      default:
        return fmt::format("gave the outcome {}, which <lorentz/engine.h> does not have", outcome);
    }
    ObstacleId obstacle;
    const std::string flaw = read_obstacle(row, obstacle);
    if (!flaw.empty()) return flaw;
    const double time = rows.time[row];
    if (outcome == LORENTZ_HIT && (std::isnan(time) || time == -std::numeric_limits<double>::infinity()))
      return "gave a hit whose time is not a number";
    answer = outcome == LORENTZ_HIT ? Answer::hit(obstacle, time) : Answer::inside(obstacle);
    return {};
  }

  std::string read_obstacle(std::size_t row, ObstacleId& obstacle) const {
    const SharedAnswers& rows = process_->answers();
    obstacle.lattice = rows.lattice[row], obstacle.atom = rows.atom[row];
    const auto there = [](int index, std::size_t count) {
      return index >= 0 && static_cast<std::size_t>(index) < count;
    };
    const std::size_t lattices = scene().lattices.size();
    if (!there(obstacle.lattice, lattices))
      return fmt::format("named the lattice {}; the scene has {}, counted from 0", obstacle.lattice,
                         lattices);
    const std::size_t atoms = scene().lattices[static_cast<std::size_t>(obstacle.lattice)].atoms.size();
    if (!there(obstacle.atom, atoms))
      return fmt::format("named the atom {} of lattice {}, which has {}, counted from 0", obstacle.atom,
                         obstacle.lattice, atoms);
    for (int k = 0; k < Components(scene()).of_cells(obstacle.lattice); ++k)
      obstacle.cell[k] = rows.cell[k][row];
    return {};
  }

  // ---- failures

  // The library died or fell silent with `rows` rows to answer.
  void failed_on(std::size_t rows, const std::string& what) {
    const bool alone = rows == 1 && is_fresh_;
    const std::size_t answered = process_->answered_in_order(rows);
    process_.reset();
    if (alone) return blame_first(what + " on this query");
    failed_ = true;
    suspicion_ = what;
    if (answered < rows)
      suspect_ = delivered_ + answered;
    else if (rows == 1)
      suspect_ = delivered_;
    else
      ask_again_in_halves(rows);
  }

  // All rows were answered before it failed, so it is not clear which one is at fault.
  void ask_again_in_halves(std::size_t rows) {
    complain_of_first(
        fmt::format("{} on this query, or on one of the {} after it; they are asked again, fewer at a time",
                    suspicion_, rows - 1));
    block_ = rows / 2;
  }

  void blame_first(const std::string& what) {
    process_.reset();
    suspect_.reset();
    block_ = kFirstBlock;
    complain_of_first(what);
    deliver_first({error(what), Origin::fault});
    note_failure();
  }

  // Open queries get no answer. Being too slow for the available time is not a fault, unless the library
  // never gave any answer.
  void abandon() {
    if (process_ && !ever_answered_) complain_of_first("gave no answer in all the time there was");
    process_.reset();
    suspect_.reset();
    delivered_ += waiting_.size();
    waiting_.clear();
  }

  void complain_of_first(const std::string& what) {
    std::string line;
    append_query_line(line, waiting_.front().id, waiting_.front().query, scene());
    complain(what, scene(), line);
  }

  void deliver_first(Reply reply) {
    waiting_.pop_front();
    ++delivered_;
    deliver(reply);
  }

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

}  // namespace

std::unique_ptr<Answerer> library_engine(std::string file, const AnswererOptions& options) {
  return std::make_unique<LibraryEngine>(std::move(file), options);
}

}  // namespace lorentz::question
