// All answers other than the exact one that errors of the inputs excuse. Private to oracle/.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/verdict.hpp>
#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {

/// As Judge::excused says.
template <std::size_t D>
std::optional<std::vector<ExcusedAnswer>> excused_answers(const PerturbedQuery<D>& perturbed,
                                                          const Answer& exact, double ulps, std::size_t most);

}  // namespace lorentz::oracle
