// Answers many queries at a time: by an engine of this program, or by an external program at the end of two
// pipes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <lorentz/answer.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/flight.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/introduction.hpp"
#include "question/listener.hpp"

namespace lorentz::question {

/// What every answer must contain, and how long an answerer waits for it.
struct AnswererOptions {
  static constexpr double kDefaultTimeout = 60;

  oracle::Request request = {};
  double timeout = kDefaultTimeout;  ///< seconds that an external engine may be silent while it owes answers
  Listener listener = {};            ///< gets messages about an external engine
  bool strict = false;               ///< an unknown key makes an answer invalid
  int jobs = 1;                      ///< threads, for the batch engines and libraries
  /// Seconds for the very first answer, if that is more than `timeout`. After a later start of the program
  /// its first answer may take `timeout` plus twice the time of the slowest start so far, but no more than
  /// this.
  double start_timeout = 0;
  bool applies_limits = false;  ///< limits are applied to the answers, so a hit with a limit needs its time
  /// An engine of this program is asked as campaigns do: `reduction` and `batch` in two ways at once, and
  /// `classical` and `walk` give up sooner.
  bool in_campaign = false;
  /// Called at least every 0.1 s during a wait for an external engine. Once it returns true, the engine's
  /// process group is killed, and its open queries, and those asked later, are `not_asked`.
  std::function<bool()> enough = {};
};

/// Where an answer comes from. If an external engine fails on a query, or is not asked it, this program
/// answers `error` and says what happened instead.
enum class Origin {
  engine,
  bad_line,  ///< a fault: it wrote an invalid line in place of the answer
  silent,    ///< a fault: it gave no answer within AnswererOptions::timeout
  fault,     ///< another fault: it died, or left the query out
  not_asked  ///< or asked, and not waited for
};

/// An answer, and what else an answerer reports about it.
struct Reply {
  Answer answer = {};
  Origin origin = Origin::engine;
  std::optional<Stage> stage = {};  ///< which stage of its ladder decided, if it has one

  bool was_asked() const { return origin != Origin::not_asked; }
  bool is_fault() const {
    return origin == Origin::bad_line || origin == Origin::silent || origin == Origin::fault;
  }
};

/// Answers queries in the order in which they are asked. A reply comes at once or while later queries are
/// asked; all have come when drain() returns. For one thread.
class Answerer {
 public:
  /// Called for each reply, in the order of the queries, from within ask(), idle(), drain() or finish(). The
  /// callback may move from the reply; it must not ask queries.
  using OnReply = std::function<void(Reply&)>;

  virtual ~Answerer() = default;
  void on_reply(OnReply callback) { on_reply_ = std::move(callback); }

  /// Sets the scene of the queries that follow. It must be valid.
  void set_scene(const Scene& scene) {
    enter(scene);
    scene_ = scene;
  }
  bool is_in(const Scene& scene) const { return scene_ == scene; }

  /// Asks a valid query. Messages name it by its id, which need not be unique.
  virtual void ask(const Id& id, const Query& query) = 0;

  /// The same with a limit: the answer is `later` if nothing is entered before max_time. An answerer that
  /// takes no limits ignores it.
  virtual void ask_until(const Id& id, const Query& query, double /*max_time*/) { ask(id, query); }

  /// True if it respects such limits, however near they are to the time of a hit.
  virtual bool takes_limits() const { return false; }

  /// The smallest number of queries that should be asked before a wait for replies.
  virtual std::uint64_t batch_size() const { return 1; }

  /// Asks an invalid query, given as a line without its braces and id. An external program gets it unchanged;
  /// for other engines the answer is `error`.
  virtual void ask_text(const Id&, const std::string&) {
    drain();
    deliver({Answer::error("no query")});
  }

  /// Waits for all replies. More queries may be asked afterwards.
  virtual void drain() {}

  /// Waits for all replies, and ends an external engine. No queries may be asked afterwards.
  virtual void finish() { drain(); }

  /// For a caller that would otherwise wait for input: waits until the descriptor can be read or some replies
  /// have come. Returns true if it should be called again before reading.
  virtual bool idle(int) {
    drain();
    return false;
  }

  /// True if an external engine failed: it died, fell silent, or wrote an invalid line. Messages on stderr
  /// say which.
  virtual bool failed() const { return false; }

  /// True if it failed so often that it is no longer asked about this scene.
  virtual bool given_up() const { return false; }

  /// The time of its own calls so far, without transport, if it reports that: a library does at any time,
  /// an external program at its end.
  virtual std::optional<OwnTime> own_time() const { return {}; }

  /// True if it was given up and never answered anything; it is then not asked about other scenes either.
  virtual bool is_hopeless() const { return false; }

  /// The last line that an external engine has written to its standard error since the last call, or an
  /// empty text.
  virtual std::string take_last_words() { return {}; }

  /// Processor seconds of an external engine, summed over its starts; nothing for an engine of this program.
  virtual std::optional<double> processor_seconds() const { return std::nullopt; }

  /// Lets it be asked again although it was given up, as if nothing had happened, unless it is hopeless.
  virtual void try_again() {}

 protected:
  /// Called before the scene changes: scene() is still that of the earlier queries.
  virtual void enter(const Scene& scene) = 0;
  const Scene& scene() const { return *scene_; }

  void deliver(Reply& reply) { on_reply_(reply); }
  void deliver(Reply&& reply) { on_reply_(reply); }

 private:
  std::optional<Scene> scene_;
  OnReply on_reply_ = [](Reply&) {};
};

/// Makes an answerer, for one thread. `enough`: as in AnswererOptions.
using MakeAnswerer = std::function<std::unique_ptr<Answerer>(const std::function<bool()>& enough)>;

}  // namespace lorentz::question
