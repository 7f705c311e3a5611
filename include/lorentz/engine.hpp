// The common interface of the binary64 engines, and how to make one by name.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

struct Ray;  // a flight in the form that engines take (engine_base.hpp)

/// A first-hit engine for one scene.
///
///  1. It is const and has no hidden state, so any number of threads may use one engine.
///  2. The velocity's length affects only the time: v and 2 v get the same answer, at half the time.
///  3. It throws nothing.
///
/// Units: lengths are in the scene's unit; times are such that x + t v is the particle's position.
///
/// Which answers can be trusted depends on the engine: `classical`, `published` and `golse` are known
/// algorithms, errors included; reduction.hpp says what `reduction` promises. The cost of each engine is in
/// docs/speed.md.
class Engine {
 public:
  virtual ~Engine() = default;

  /// The engine's answer; `later` if nothing is entered before `max_time`. An invalid query (flaw_of) yields
  /// `error`.
  Answer first_hit(const Query& query, double max_time = std::numeric_limits<double>::infinity()) const {
    Answer answer;
    first_hit(query, max_time, answer);
    return answer;
  }

  /// Writes the answer into an existing object and replaces whatever it held.
  void first_hit(const Query& query, double max_time, Answer& answer) const;

 protected:
  Engine(const Engine&) = default;
  Engine(Engine&&) noexcept = default;
  Engine& operator=(const Engine&) = default;
  Engine& operator=(Engine&&) noexcept = default;

  /// Throws InputError if the scene is invalid (flaw_of).
  explicit Engine(Scene scene) : scene_(std::move(scene)) { checked(scene_); }

  /// Called with a valid query and a fresh answer. Times are in the units of the scaled velocity. If nothing
  /// is entered before `max_time`, the engine answers `never`, which first_hit turns into `later`.
  virtual void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const = 0;

  /// True if first_hit_scaled decides the limit. Otherwise its rounded time is compared with the limit.
  virtual bool decides_limit() const { return false; }

  /// Does what first_hit does, but calls `fly(ray, max_time, answer)` instead of first_hit_scaled
  /// (engine_base.hpp).
  template <class Fly>
  void first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const;

  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

/// Makes the engine of this name for a scene; null if the name is unknown. If the engine does not support the
/// scene, the result is an engine that answers every valid query with `unsupported`. Throws InputError if the
/// scene is invalid (flaw_of).
std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene);

/// Starts beyond this many cells from the origin are `unsupported` by the known algorithms, and `undecided`
/// by `reduction`, because there a binary64 has no digits left for the position within a cell.
inline constexpr double kMaxStart = 0x1p51;

}  // namespace lorentz
