// The common interface of the binary64 engines, and what they share: the scaling of the velocity.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/problem.hpp>

namespace lorentz {

/// A flight as the engines take it: the velocity scaled by a power of two so that its largest component lies
/// in [1, 2), which avoids needless overflow and underflow.
struct Ray {
  const Vec& x;
  const Vec& v;
  const ObstacleId* from;  ///< or null
  bool tiny_component;     ///< of v, below kTinyComponent but not zero: it may have lost digits, even all
};

inline constexpr double kTinyComponent = 0x1p-450;

/// A velocity v other than zero, scaled to a Ray's; v = scaled * 2^exponent.
struct ScaledVelocity {
  Vec scaled;
  int exponent;
  bool tiny_component = false;  ///< as in Ray

  explicit ScaledVelocity(const Vec& v);
};

/// A time or a length times 2^exponent, fast where the factor is a normal number.
double scaled_time(double time, int exponent);

/// A first-hit engine for one scene. Const and without hidden state: safe to call from several threads.
class Engine {
 public:
  virtual ~Engine() = default;

  /// The engine's answer, `later` if nothing is entered before `max_time`. An invalid query yields `error`.
  Answer first_hit(const Query& query, double max_time = std::numeric_limits<double>::infinity()) const {
    Answer answer;
    first_hit(query, max_time, answer);
    return answer;
  }

  /// The same into an answer that is there already; whatever it held is replaced.
  void first_hit(const Query& query, double max_time, Answer& answer) const;

 protected:
  explicit Engine(Scene scene) : scene_(std::move(scene)) {}

  /// Called for a valid query and a fresh answer. Times are in the units of the scaled velocity.
  virtual void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const = 0;

  /// What first_hit does, with `fly(ray, max_time, answer)` in place of first_hit_scaled.
  template <class Fly>
  void first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const {
    answer.clear();
    if (auto flaw = flaw_of(query, scene_)) {
      answer = Answer::error(*flaw);
      return;
    }
    const ScaledVelocity velocity(query.v);
    fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, velocity.tiny_component},
        scaled_time(max_time, velocity.exponent), answer);
    if (answer.time) answer.time = scaled_time(*answer.time, -velocity.exponent);
    if (std::isfinite(max_time)) answer = limited(std::move(answer), max_time);
  }

  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

/// The names that make_engine knows.
std::vector<std::string> engine_names();

/// The engine of this name for a scene without flaws, or null for an unknown name. A scene that the engine
/// does not do gets an engine that answers every query with `unsupported`.
std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene);

/// Starts beyond this many cells from the origin are `unsupported`: there a binary64 has no digits left for
/// the place within a cell.
inline constexpr double kMaxStart = 0x1p51;

}  // namespace lorentz
