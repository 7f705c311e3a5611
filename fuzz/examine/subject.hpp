// Who is examined by a campaign: anything that answers queries.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/flight.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::fuzz {

struct Reply {
  Answer answer;
  std::optional<double> work = {};  ///< what it took, in the engine's own count of steps, if it counts
  std::optional<Stage> stage = {};  ///< which stage of its ladder decided, if it has one
};

/// Used by one thread. Answers may be waited for many at a time.
class Subject {
 public:
  virtual ~Subject() = default;

  /// The scene, without flaws, of the queries that follow. That it is the same again costs nothing to speak
  /// of.
  void set_scene(const Scene& scene);

  /// A query without flaws.
  virtual void ask(const Query& query) = 0;

  /// Can it be asked with time limits, however near they are to the time of a hit?
  virtual bool takes_limits() const { return false; }

  /// The same, to be answered `later` if nothing is entered before max_time.
  virtual void ask_until(const Query& query, double /*max_time*/) { ask(query); }

  /// How many cases it likes to be asked at least before the replies are waited for.
  virtual std::uint64_t batch_size() const { return 1; }

  /// The replies to all that was asked since the last call, in order.
  virtual std::vector<Reply> replies() = 0;

  /// True if it broke (another program that died, say), for good: it is not asked again.
  virtual bool failed() const { return false; }

 protected:
  virtual void change_scene(const Scene& scene) = 0;

 private:
  std::optional<Scene> scene_;
};

using MakeSubject = std::function<std::unique_ptr<Subject>()>;

}  // namespace lorentz::fuzz
