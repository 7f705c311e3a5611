// A question with its exact answer, and its place: a scene with its oracle, judge and margins.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/verdict.hpp>
#include "question/engines.hpp"

namespace lorentz::question {

/// A valid scene. Oracle, judge and margins are made when
/// they are first needed, because many scenes never need one. One thread must make each; after that any
/// number of threads may use it.
class Place {
 public:
  /// Judge and margins count in ulps of the claim's precision.
  explicit Place(Scene scene, const Claim& claim = {})
      : scene_(std::move(scene)),
        claim_(claim),
        is_in_its_numbers_(consists_of(scene_, claim.precision)),
        is_in_its_domain_(claim.domain.has(scene_)) {}

  const Scene& scene() const { return scene_; }
  const Claim& claim() const { return claim_; }
  /// True if the scene and this query consist of numbers of the claim's precision.
  bool has_numbers_for(const Query& query) const {
    return is_in_its_numbers_ && consists_of(query, claim_.precision);
  }
  /// True if they are also in the claim's domain.
  bool takes(const Query& query) const {
    return is_in_its_domain_ && claim_.domain.has(query) && has_numbers_for(query);
  }
  /// The query if it is in the domain, or the same flight at another speed that is; nothing if there is none.
  std::optional<Query> brought_inside(const Query& query) const {
    std::optional<Query> inside = claim_.domain.bring_inside(query);
    return inside && takes(*inside) ? inside : std::nullopt;
  }
  /// True if the exact answer is one that the engine is asked for, too.
  bool takes(const Query& query, const Answer& exact) const {
    const bool is_start_inside =
        exact.outcome == Outcome::inside && claim_.inside == StartInside::unsupported;
    return !is_start_inside && !exact.unsupported && claim_.domain.has(query, exact);
  }
  const oracle::Oracle& oracle() const { return made(oracle_); }
  const oracle::Judge& judge() const { return made(judge_, claim_); }
  const oracle::Margins& margins() const { return made(margins_, claim_.precision); }

  /// The true answer to a valid query, by the claim's rule for starts inside.
  Answer exact(const Query& query, oracle::Request request = {}) const {
    request.start = claim_.inside;
    return oracle().first_hit(query, request);
  }

  /// Records the result of a question in this scene.
  void note(bool is_unsupported) { ++asked_, unsupported_ += is_unsupported; }
  void note_time(double seconds) { seconds_ += seconds; }

  /// Records that the engine is an external one, which failed here again and again.
  void give_up() { given_up_ = true; }
  /// Records that it was silent here for longer than one may take.
  void note_silence() { was_silent_ = true; }
  bool is_given_up() const { return given_up_; }

  /// True if the engine should be asked no more questions here: it supported none of the first kEnough, took
  /// more than kSlowSeconds each on average, was silent, or was given up.
  bool is_beyond_engine() const {
    return given_up_ || was_silent_ ||
           (asked_ >= kEnough &&
            (unsupported_ == asked_ || seconds_ > kSlowSeconds * static_cast<double>(asked_)));
  }
  bool was_answered() const { return !given_up_ && unsupported_ < asked_; }

 private:
  static constexpr std::size_t kEnough = 4;
  static constexpr double kSlowSeconds = 0.1;

  template <class T, class... Rest>
  const T& made(std::unique_ptr<T>& one, const Rest&... rest) const {
    if (!one) one = std::make_unique<T>(scene_, rest...);
    return *one;
  }

  const Scene scene_;
  const Claim claim_;
  const bool is_in_its_numbers_, is_in_its_domain_;
  mutable std::unique_ptr<oracle::Oracle> oracle_;
  mutable std::unique_ptr<oracle::Judge> judge_;
  mutable std::unique_ptr<oracle::Margins> margins_;
  std::size_t asked_ = 0, unsupported_ = 0;
  bool given_up_ = false, was_silent_ = false;
  double seconds_ = 0;
};

struct Question {
  std::shared_ptr<Place> place;
  Query query = {};
  Answer exact = {};       ///< without the limit
  std::string where = {};  ///< where it comes from, in words: "drawn, square, r = 0.1"
  /// For an invalid question, in place of the query: its line without braces and id.
  std::string text = {};
  Id id = "null";
  std::vector<std::string> tags = {};  ///< of a golden record
  std::optional<double> margin = {};   ///< of a golden record
  /// The limit: the answer is `later` if nothing is entered before it.
  double max_time = std::numeric_limits<double>::infinity();
  double condition = 0;  ///< Margins::condition of the exact answer; 0 if not computed
  bool is_query() const { return text.empty(); }
  bool has_limit() const { return std::isfinite(max_time); }
};

/// True if the question is in the domain of the claim: the query and its exact answer, or an invalid question's scene.
inline bool is_in_domain(const Question& question) {
  const Place& place = *question.place;
  return question.is_query() ? place.takes(question.query) && place.takes(question.query, question.exact)
                             : place.claim().domain.has(place.scene());
}

/// Questions of one place, numbered from 0 by their ids, without answers.
inline std::vector<Question> questions_of(const std::shared_ptr<Place>& place,
                                          const std::vector<Query>& queries) {
  std::vector<Question> questions;
  for (const Query& query : queries)
    questions.push_back({.place = place, .query = query, .id = std::to_string(questions.size())});
  return questions;
}

/// A ball's radius, or the smallest of an ellipsoid's principal semiaxes.
double smallest_semiaxis(const Atom& atom, int dimension);

/// When the line leaves the obstacle that is hit, to 17 digits.
double exit_time(const Question& question);

/// |t' - t| |v| / r: the error of the time as a distance along the ray, in radii of the right obstacle (for
/// an ellipsoid its smallest semiaxis); for times near 0 this says more than ulps. The larger of entry and exit, if
/// both are given. Nothing unless both answers have finite times.
std::optional<double> radii_off(const Question& question, const Answer& given);

/// Returns the next question, or nothing at the end.
using Source = std::function<std::optional<Question>()>;

/// A source of questions in memory, which must outlast it.
inline Source all_of(std::span<const Question> questions) {
  return [questions, next = std::size_t{0}]() mutable -> std::optional<Question> {
    return next < questions.size() ? std::optional(questions[next++]) : std::nullopt;
  };
}

}  // namespace lorentz::question
