// An engine of this program in one scene: asked one query at a time, or many at once as columns.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/oracle.hpp>
#include "question/answerer.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::question {

/// Properties of an engine that decide how its answers are treated.
struct Traits {
  bool is_exact = false;          ///< its answers rest on exact arithmetic
  bool knows_digits = false;      ///< gives digits of times beyond those of a binary64
  bool leaves_undecided = false;  ///< on purpose: `undecided` for a hard query is not a failure
  bool uses_reduction = false;    ///< `reduction` decides all that it can
  bool takes_limits = false;      ///< compares the exact time of a hit with a limit
  std::size_t together = 0;       ///< slow with one query at a time: how many are best asked together; else 0
  bool needs_card = false;        ///< flies on a graphics card
};

inline constexpr double kForEver = std::numeric_limits<double>::infinity();

/// The time limit, kForEver if there is none.
inline double limit_of(const oracle::Request& request) {
  return request.max_time.value_or(kForEver);
}

/// A view of the columns. It is valid until they change.
QueryColumns view_of(const QueryRows& rows);

/// Any number of threads may share one. All its functions give the same answers.
class SceneEngine {
 public:
  /// Answers one query, into an existing reply. Only the oracle gives `digits`. A detail that binary64 cannot
  /// compute is left out.
  using Ask = std::function<void(const Query&, const oracle::Request&, Reply&)>;
  /// Flies many queries. `rest` gets the numbers of those that must still be asked one by one, in order.
  using FlyTogether = std::function<void(const QueryColumns&, const FlightColumns&,
                                         std::vector<std::size_t>& rest, int jobs)>;

  /// Without `fly_together` all queries are asked one by one.
  SceneEngine(const Scene& scene, const Traits& traits, Ask ask, FlyTogether fly_together = {})
      : dimension_(scene.dimension),
        traits_(traits),
        ask_(std::move(ask)),
        fly_together_(std::move(fly_together)) {}

  /// All queries are `unsupported`, for this reason.
  static SceneEngine unsupported(const Scene& scene, const Traits& traits, const std::string& why);

  const Traits& traits() const { return traits_; }
  void ask(const Query& query, const oracle::Request& request, Reply& reply) const {
    ask_(query, request, reply);
  }
  bool flies_together() const { return static_cast<bool>(fly_together_); }
  void fly_together(const QueryColumns& queries, const FlightColumns& flights, std::vector<std::size_t>& rest,
                    int jobs) const {
    fly_together_(queries, flights, rest, jobs);
  }

  /// Gives the outcomes and times of all queries.
  void fly(const QueryColumns& queries, FlightTable& flights) const;

  /// Answers all rows, into those from `first` on, which must exist. Invalid rows are errors. `max_time` is an
  /// upper bound for the limits of all rows.
  void answer(const QueryRows& queries, AnswerRows& answers, std::size_t first = 0,
              double max_time = kForEver, int jobs = 1) const;

 private:
  int dimension_;
  Traits traits_;
  Ask ask_;
  FlyTogether fly_together_;
};

/// Makes the engine for a valid scene.
using MakeSceneEngine = std::function<SceneEngine(const Scene&)>;

/// An answerer of an engine of this program. One in bulk gathers queries and flies them together; others answer at
/// once.
std::unique_ptr<Answerer> own_answerer(const Traits& traits, MakeSceneEngine make,
                                       const AnswererOptions& options = {});

/// The engine `batch` asked in two ways at once, as campaigns do: together, and each query also alone (or by the
/// function given here). The two answers must be the same to the bit, or the reply is an error.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
SceneEngine batch_both_ways(const Scene& scene, const Traits& traits, FlyAlone alone = {});

}  // namespace lorentz::question
