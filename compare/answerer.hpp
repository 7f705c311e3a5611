// Who answers queries, many at a time: an engine of this program, or another program at the end of two pipes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <lorentz/answer.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "compare/listener.hpp"

namespace lorentz::compare {

/// What every answer of an answerer is to have, and how long one waits for it.
struct AnswererOptions {
  static constexpr double kDefaultTimeout = 60;

  oracle::Request request;
  double timeout = kDefaultTimeout;  ///< seconds without an answer while some are due, of another program
  Listener listener = {};            ///< is told what became of another program
  bool strict = false;               ///< an answer with a key that no answer has is none
  int jobs = 1;                      ///< threads, of the batch engines
  /// Seconds for the first answer of all, if that is more than `timeout`. Later starts of the program then
  /// get, besides `timeout`, twice what the slowest of them took.
  double start_timeout = 0;
  /// Asked often while another program is waited for. Once it says true nothing is waited for any more: what
  /// is owed gets no answer, and the program is ended.
  std::function<bool()> enough = {};
};

inline constexpr const char* kTimeoutHelp =
    "how long a cmd: engine may be silent while it owes answers (default: 60)";

/// Answers queries in the order in which they are asked. Answers come when they come: an engine's at once,
/// another program's while later queries are asked, and all of them before drain() returns.
class Answerer {
 public:
  /// Called for each answer, in the order of the queries, from within ask(), idle(), drain() or finish(). It
  /// may take the answer, and must ask nothing.
  using OnAnswer = std::function<void(Answer&)>;

  /// Whose an answer is. Another program's faults, and the queries that it was not asked, get an `error` from
  /// us, which tells what it did instead.
  enum class Origin { engine, fault, not_asked };

  virtual ~Answerer() = default;
  void on_answer(OnAnswer callback) { on_answer_ = std::move(callback); }

  /// Of the answer that is being delivered.
  Origin origin() const { return origin_; }

  /// The scene, without flaws, of the queries that follow.
  virtual void set_scene(const Scene& scene) = 0;

  /// A query without flaws. The id is what messages call it; it need not be unique.
  virtual void ask(const Id& id, const Query& query) = 0;

  /// An invalid query, as a line without its braces and id: another program gets it as it is; for an
  /// engine of ours the reader answers, `error`.
  virtual void ask_text(const Id&, const std::string&) {
    Answer answer = Answer::error("no query");
    deliver(answer);
  }

  /// Waits for all answers. More may be asked afterwards.
  virtual void drain() {}

  /// Waits for all answers, and ends what has to be ended. Nothing is asked afterwards.
  virtual void finish() {}

  /// For a caller who would wait for input: waits until the descriptor can be read or some answers came, and
  /// returns whether it is worth calling again before reading.
  virtual bool idle(int) { return false; }

  /// True if another program broke: it died, fell silent, or wrote what is no answer. What it was was said on
  /// stderr.
  virtual bool failed() const { return false; }

  /// True if it broke so often that it is no longer asked about this scene.
  virtual bool given_up() const { return false; }

  /// True if it was given up and never answered anything: it is not asked about other scenes either.
  virtual bool is_hopeless() const { return false; }

  /// Asks it again although it was given up, as if nothing had happened, unless it is hopeless.
  virtual void try_again() {}

 protected:
  void deliver(Answer& answer, Origin origin = Origin::engine) {
    origin_ = origin;
    on_answer_(answer);
  }

 private:
  Origin origin_ = Origin::engine;
  OnAnswer on_answer_ = [](Answer&) {};
};

}  // namespace lorentz::compare
