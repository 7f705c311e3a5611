// The common interface of the binary64 engines, how to make one by its name, and what they share: the scaling
// of the velocity.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// Components of a velocity that are smaller, scaled as a Ray's, may have lost digits.
inline constexpr double kTinyComponent = 0x1p-450;

/// A flight as the engines take it: the velocity scaled by a power of two so that its largest component lies
/// in [1, 2), which avoids needless overflow and underflow.
struct Ray {
  const Vec& x;
  const Vec& v;
  const ObstacleId* from;  ///< or null
  const Vec& given_v;      ///< the velocity before it was scaled

  /// Is a component of v below kTinyComponent, but not zero as given? It may have lost digits, even all.
  bool has_tiny_component() const {
    bool tiny = false;
    for (int i = 0; i < 3; ++i) tiny |= given_v[i] != 0 && std::fabs(v[i]) < kTinyComponent;
    return tiny;
  }
};

/// Of an exponent of normal numbers.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// A velocity v other than zero, scaled to a Ray's; v = scaled * 2^exponent.
struct ScaledVelocity {
  Vec scaled;
  int exponent;

  explicit ScaledVelocity(const Vec& v) {
    const double a = std::fabs(v[0]), b = std::fabs(v[1]), c = std::fabs(v[2]), ab = a > b ? a : b;
    const double largest = ab > c ? ab : c;
    exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - 1023;
    if (!(exponent > -1000 && exponent < 1000)) {
      set_extreme(v, largest);
      return;
    }
    const double factor = power_of_two(-exponent);
    scaled = {v[0] * factor, v[1] * factor, v[2] * factor};
  }

 private:
  void set_extreme(const Vec& v, double largest);
};

/// A time or a length times 2^exponent, fast where the factor is a normal number.
inline double scaled_time(double time, int exponent) {
  return exponent > -500 && exponent < 500 ? time * power_of_two(exponent) : std::scalbn(time, exponent);
}

/// A limit in such units: above zero, or finite, if it was.
inline double scaled_limit(double limit, int exponent) {
  using Range = std::numeric_limits<double>;
  if (!(limit > 0 && limit < Range::infinity())) return limit;
  return std::clamp(scaled_time(limit, exponent), Range::min(), Range::max());
}

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
  explicit Engine(Scene scene) : scene_(std::move(scene)) {}

  /// Called for a valid query and a fresh answer. Times are in the units of the scaled velocity.
  virtual void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const = 0;

  /// True if first_hit_scaled decides the limit. Otherwise its rounded time is compared with it.
  virtual bool decides_limit() const { return false; }

  /// What first_hit does, with `fly(ray, max_time, answer)` in place of first_hit_scaled.
  template <class Fly>
  void first_hit_by(const Query& query, double max_time, Answer& answer, const Fly& fly) const {
    answer.clear();
    if (auto flaw = flaw_of(query, scene_)) {
      answer = Answer::error(*flaw);
      return;
    }
    const ScaledVelocity velocity(query.v);
    fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, query.v},
        scaled_limit(max_time, velocity.exponent), answer);
    if (answer.time) answer.time = scaled_time(*answer.time, -velocity.exponent);
    if (std::isfinite(max_time) && !decides_limit()) answer = limited(std::move(answer), max_time);
  }

  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

/// The names that make_engine knows: "classical", "published", "reduction".
std::vector<std::string> engine_names();

/// The engine of this name for a scene without flaws, or null for an unknown name. A scene that the engine
/// does not do gets an engine that answers every query with `unsupported`.
std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene);

/// Starts beyond this many cells from the origin are `unsupported`: there a binary64 has no digits left for
/// the place within a cell.
inline constexpr double kMaxStart = 0x1p51;

}  // namespace lorentz
