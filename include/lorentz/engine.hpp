// The common interface of the binary64 engines, and how to make one by its name.
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

struct Ray;  // a flight as the engines take it (engine_base.hpp)

/// A first-hit engine for one scene.
///
///  1. Const and without hidden state: any number of threads may ask one engine.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///  2. The velocity's length goes into the time only: v and 2 v have the same answer, at half the time.
///     held by "The velocity's length goes into the time only"
///  3. Throws nothing.
///
/// Units: lengths are the scene's, times are such that x + t v is the particle's place.
///
/// Which answers are to be trusted depends on the engine: `classical` and `published` are the known
/// algorithms, errors included; what `reduction` promises is in reduction.hpp. What each costs is in
/// docs/speed.md.
class Engine {
 public:
  virtual ~Engine() = default;

  /// The engine's answer, `later` if nothing is entered before `max_time`. An invalid query (flaw_of) yields
  /// `error`.
  Answer first_hit(const Query& query, double max_time = std::numeric_limits<double>::infinity()) const {
    Answer answer;
    first_hit(query, max_time, answer);
    return answer;
  }

  /// The same into an answer that is there already; whatever it held is replaced.
  void first_hit(const Query& query, double max_time, Answer& answer) const;

 protected:
  Engine(const Engine&) = default;
  Engine(Engine&&) noexcept = default;
  Engine& operator=(const Engine&) = default;
  Engine& operator=(Engine&&) noexcept = default;

  /// Throws InputError for a scene with a flaw.
  explicit Engine(Scene scene) : scene_(std::move(scene)) { checked(scene_); }

  /// Called for a valid query and a fresh answer. Times are in the units of the scaled velocity. Nothing is
  /// entered before max_time: `never`, of which first_hit makes `later`.
  virtual void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const = 0;

  /// True if first_hit_scaled decides the limit. Otherwise its rounded time is compared with it.
  virtual bool decides_limit() const { return false; }

  /// What first_hit does, with `fly(ray, max_time, answer)` in place of first_hit_scaled (engine_base.hpp).
  template <class Fly>
  void first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const;

  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

/// The names that make_engine knows.
std::vector<std::string> engine_names();

/// The engine of this name for a scene, or null for an unknown name. A scene that the engine does not do gets an engine
/// that answers every query with `unsupported`. Throws InputError for a scene with a flaw.
std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene);

/// Starts beyond this many cells from the origin are `unsupported` by `classical` and `published`, and
/// `undecided` by `reduction`: there a binary64 has no digits left for the place within a cell.
inline constexpr double kMaxStart = 0x1p51;

}  // namespace lorentz
