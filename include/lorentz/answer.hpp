// The answer to a query: an outcome and, for a hit, the obstacle and the time.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <lorentz/obstacle.hpp>
#include <lorentz/vec.hpp>

namespace lorentz {

enum class Outcome {
  hit,        ///< the ray enters `obstacle` first, at `time`
  never,      ///< the ray enters no obstacle
  inside,     ///< x lies in the open obstacle `obstacle`
  later,      ///< nothing is entered before the requested limit (--max-time)
  undecided,  ///< the implementation does not know the answer
  error       ///< the query is invalid, or (if `unsupported`) this engine does not support it
};

/// The most decimal digits that can be asked for.
inline constexpr int kMostDigits = 100'000;

/// Details of an obstacle that is hit or contains x, computed on request: where the line of flight enters it (for
/// `hit`; zero for `inside`) and where it leaves it, with the outward unit normals there. `impact_parameter` is the
/// distance of the line from the obstacle's centre.
struct Detail {
  Vec point{};
  Vec normal{};
  double impact_parameter = 0;
  Vec exit_point{};
  Vec exit_normal{};
};

struct Answer;

/// Makes an answer when it is called: `Answer::hit(obstacle, time)`. It is not a property of an answer: neither
/// `if (answer.hit)` nor `std::cout << answer.error` compiles.
template <class... Parts>
struct AnswerMaker {
  Answer (*make)(Parts...);

  Answer operator()(Parts... parts) const;
  template <class T>
  operator T() const = delete;  // ask answer.outcome == Outcome::.., and answer.message for the error
  template <class Stream>
  friend Stream& operator<<(Stream&, const AnswerMaker&) = delete;  // ask answer.outcome, answer.message
};

struct Answer {
  Outcome outcome = Outcome::undecided;
  ObstacleId obstacle;         ///< set for `hit` and `inside`
  std::optional<double> time;  ///< set for `hit`; may be infinite, and absent in answers logged by others
  std::string time_decimal;    ///< set for `hit` if digits were requested
  std::optional<double> exit_time;  ///< for `hit` and `inside`, if requested: when the line leaves `obstacle`
  std::optional<Detail> detail;     ///< set for `hit` and `inside` if requested
  std::string message;              ///< set for `error`
  bool unsupported = false;  ///< set for `error`: the query is valid, but this engine does not support it

  /// Resets the answer to a newly made one but keeps allocated memory.
  void clear();

  static const AnswerMaker<ObstacleId, double> hit;
  static const AnswerMaker<ObstacleId> inside;
  static const AnswerMaker<> never, later, undecided;
  static const AnswerMaker<std::string> error, unsupported_because;  ///< given the message
};

template <class... Parts>
Answer AnswerMaker<Parts...>::operator()(Parts... parts) const {
  return make(std::move(parts)...);
}

/// Returns `answer`, or `later` if it says that nothing is entered before `max_time` (infinity: no limit).
Answer limited(Answer answer, double max_time);

}  // namespace lorentz
