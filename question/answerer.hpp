// Who answers queries, many at a time: an engine of this program, or another program at the end of two pipes.
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

/// What every answer of an answerer is to have, and how long one waits for it.
struct AnswererOptions {
  static constexpr double kDefaultTimeout = 60;
  /// Failures without an answer in between after which an engine that runs apart is given up.
  static constexpr int kMostFailuresInRow = 5;

  oracle::Request request;
  double timeout = kDefaultTimeout;  ///< seconds without an answer while some are due, of another program
  Listener listener = {};            ///< is told what became of another program
  bool strict = false;               ///< an answer with a key that no answer has is none
  int jobs = 1;                      ///< threads, of the batch engines and of a library
  /// Seconds for the first answer of all, if that is more than `timeout`. Later starts of the program then
  /// get, besides `timeout`, twice what the slowest of them took.
  double start_timeout = 0;
  /// Asked often while another program is waited for. Once it says true nothing is waited for any more: what
  /// is owed gets no answer, and the program is ended.
  std::function<bool()> enough = {};
};

inline constexpr const char* kTimeoutHelp =
    "how long a cmd: or lib: engine may be silent while it owes answers (default: 60)";

/// Whose an answer is. Another program's faults, and the queries that it was not asked, get an `error` from us,
/// which tells what it did instead.
enum class Origin {
  engine,
  bad_line,  ///< a fault: it wrote something in the place of the answer that is no answer
  fault,     ///< another one: it died, fell silent, or left the query out
  not_asked
};

/// An answer, and what else an answerer tells of it.
struct Reply {
  Answer answer = {};
  Origin origin = Origin::engine;
  std::optional<double> work = {};  ///< what it took, in the engine's own count of steps, if it counts
  std::optional<Stage> stage = {};  ///< which stage of its ladder decided, if it has one

  bool was_asked() const { return origin != Origin::not_asked; }
  bool is_fault() const { return origin == Origin::bad_line || origin == Origin::fault; }
};

/// Answers queries in the order in which they are asked. Replies come when they come: an engine's at once,
/// another program's while later queries are asked, and all of them before drain() returns. For one thread.
class Answerer {
 public:
  /// Called for each reply, in the order of the queries, from within ask(), idle(), drain() or finish(). It
  /// may take the reply, and must ask nothing.
  using OnReply = std::function<void(Reply&)>;

  virtual ~Answerer() = default;
  void on_reply(OnReply callback) { on_reply_ = std::move(callback); }

  /// The scene, without flaws, of the queries that follow.
  void set_scene(const Scene& scene) {
    enter(scene);
    scene_ = scene;
  }
  bool is_in(const Scene& scene) const { return scene_ == scene; }

  /// A query without flaws. The id is what messages call it; it need not be unique.
  virtual void ask(const Id& id, const Query& query) = 0;

  /// The same, to be answered `later` if nothing is entered before max_time; without that limit where it takes
  /// none.
  virtual void ask_until(const Id& id, const Query& query, double /*max_time*/) { ask(id, query); }

  /// True if it takes such limits, however near they are to the time of a hit.
  virtual bool takes_limits() const { return false; }

  /// How many queries it likes to be asked at least before the replies are waited for.
  virtual std::uint64_t batch_size() const { return 1; }

  /// An invalid query, as a line without its braces and id: another program gets it as it is; for an
  /// engine of ours the reader answers, `error`.
  virtual void ask_text(const Id&, const std::string&) { deliver({Answer::error("no query")}); }

  /// Waits for all replies. More may be asked afterwards.
  virtual void drain() {}

  /// Waits for all replies, and ends what has to be ended. Nothing is asked afterwards.
  virtual void finish() {}

  /// For a caller who would wait for input: waits until the descriptor can be read or some replies came, and
  /// returns whether it is worth calling again before reading.
  virtual bool idle(int) { return false; }

  /// True if another program broke: it died, fell silent, or wrote what is no answer. What it was was said on
  /// stderr.
  virtual bool failed() const { return false; }

  /// True if it broke so often that it is no longer asked about this scene.
  virtual bool given_up() const { return false; }

  /// The time of its own calls so far, without the ways there and back, if it tells: a library at any time, another
  /// program at its end.
  virtual std::optional<OwnTime> own_time() const { return {}; }

  /// True if it was given up and never answered anything: it is not asked about other scenes either.
  virtual bool is_hopeless() const { return false; }

  /// The last line that another program wrote to its standard error since the last call; empty if there is none.
  virtual std::string take_last_words() { return {}; }

  /// Seconds that the processors spent on another program, all its starts together; nothing of an engine here.
  virtual std::optional<double> processor_seconds() const { return std::nullopt; }

  /// Asks it again although it was given up, as if nothing had happened, unless it is hopeless.
  virtual void try_again() {}

 protected:
  /// The scene that the queries before this call were asked in is still scene().
  virtual void enter(const Scene& scene) = 0;
  const Scene& scene() const { return *scene_; }

  void deliver(Reply& reply) { on_reply_(reply); }
  void deliver(Reply&& reply) { on_reply_(reply); }

 private:
  std::optional<Scene> scene_;
  OnReply on_reply_ = [](Reply&) {};
};

/// Makes an answerer, for one thread.
using MakeAnswerer = std::function<std::unique_ptr<Answerer>()>;

}  // namespace lorentz::question
