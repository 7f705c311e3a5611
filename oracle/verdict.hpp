// Judging an answer by the exact one.
#pragma once

#include <optional>

#include "../src/problem.hpp"

namespace lorentz::oracle {

enum class Verdict {
  agree,        ///< the same outcome and the same obstacle
  wrong,        ///< another outcome, or another obstacle
  undecided,    ///< it said that it does not know
  unsupported,  ///< it said that it does not do this kind of query
  error,        ///< it said that the query is none, or broke
  missing       ///< there is no answer
};

struct Judgement {
  Verdict verdict = Verdict::missing;
  std::optional<double>
      ulps;  ///< where it agrees on a hit and gives a finite time: |t - t_exact| / ulp(t_exact)
};

/// `exact` is an answer of the oracle without a time limit. Times are measured from the correctly rounded
/// time.
Judgement judge(const Answer& exact, const Answer& given);

}  // namespace lorentz::oracle
