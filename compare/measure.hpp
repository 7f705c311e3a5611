// Several answerers over the same queries: what they got wrong, how exact their times are, how long they
// took.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/exchange.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/verdict.hpp>
#include "compare/engines.hpp"
#include "compare/truth.hpp"

namespace lorentz::compare {

struct Case {
  Id id = "null";
  std::size_t scene = 0;  ///< index into CaseSet::scenes
  Query query;
};

struct CaseSet {
  std::vector<Scene> scenes;
  std::vector<Case> cases;
};

/// The value that this share of the values does not exceed; 0 of none.
double quantile(std::vector<double> values, double share);

/// What one answerer did over a set of cases.
struct Tally {
  std::string name;
  std::size_t queries = 0, agree = 0, ill_posed = 0, wrong = 0, undecided = 0, unsupported = 0, error = 0,
              missing = 0;
  std::size_t wrong_time = 0;  ///< of those that agree: their time is beyond its tolerance
  bool failed = false;         ///< another program that broke on the way
  std::size_t timed_hits = 0;  ///< hits of the right obstacle with a time that could be measured
  double max_ulp = 0, sum_ulp = 0;
  double ns_per_query = 0;  ///< mean over the queries, in the median round; 0: not timed
  double ns_median = 0;     ///< median over blocks of 16 queries of a block's mean; of another program,
                            ///< whose answers come when they come, the mean
  double ns_low = 0, ns_high = 0;                    ///< the quartiles of the same
  std::optional<double> instructions;                ///< a query, where InstructionCounter counts; not of
                                                     ///< another program
  std::vector<double> ulps;                          ///< errors of these times
  std::vector<double> wrong_ulps, wrong_conditions;  ///< of wrong times: in ulps, in units of the condition

  void count(const oracle::Judgement& judgement);
  void add(const Tally& other);       ///< its counts and errors; not its name and times
  double ulp_at(double share) const;  ///< the error that this share of the hits does not exceed
  double mean_ulp() const { return timed_hits ? sum_ulp / static_cast<double>(timed_hits) : 0; }
};

/// What an answer to an invalid query is worth: the right one is `error`.
oracle::Judgement judgement_of_invalid(const Answer& given);

/// Is it an answer to be told of: wrong, ill-posed or wrong in time?
bool departs(const oracle::Judgement& judgement);

/// Called for each answer that is wrong, ill-posed or wrong in time: the case, the exact answer, who gave
/// which, the judgement.
using OnWrong = std::function<void(const Case&, const Answer& exact, const std::string& name,
                                   const Answer& given, const oracle::Judgement&)>;

/// Called for each answer that is judged: whose it is, by its place among the names, and to which case.
using OnJudged = std::function<void(std::size_t name, std::size_t index, const oracle::Judgement&)>;

struct MeasureOptions {
  double ulps = oracle::kDefaultUlps;  ///< the tolerance of the verdicts
  int rounds = 5;
  double timeout = AnswererOptions::kDefaultTimeout;  ///< of another program
  Listener listener = {};
  bool strict = false;  ///< of another program: AnswererOptions::strict
  OnJudged on_judged = {};
  double start_timeout = 0;           ///< AnswererOptions::start_timeout
  std::function<bool()> enough = {};  ///< AnswererOptions::enough; what has no answer by then is not counted
  std::vector<std::size_t> counts = {};  ///< of each name, how many of the cases, from the first; none: all
};

/// The exact answers to all cases.
std::vector<Answer> exact_answers(const CaseSet& set, const Listener& listener = {},
                                  Truth truth = Truth::oracle);

/// Runs the engines over the cases, in alternating rounds, timing them alone on one thread. `exact`
/// is empty (nothing is judged) or as many answers as there are cases. Another program is timed by the wall,
/// pipes and all, from the first query to the last answer; where it broke it is not run again.
std::vector<Tally> measure(const CaseSet& set, const std::vector<Answer>& exact,
                           const std::vector<EngineInfo>& engines, const OnWrong& on_wrong,
                           const MeasureOptions& options = {});

}  // namespace lorentz::compare
