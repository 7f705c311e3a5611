#include "question/tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lorentz::question {

void Tally::count(const oracle::Judgement& judgement) {
  ++queries;
  counts.add(judgement);
  if (judgement.wrong_time) {
    wrong_ulps.push_back(judgement.ulps.value_or(std::numeric_limits<double>::infinity()));
    wrong_conditions.push_back(judgement.departs);
  }
  if (judgement.ulps) ulps.push_back(*judgement.ulps);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void Tally::add(const Tally& other) {
  counts += other.counts;
  queries += other.queries;
  for (const auto errors : {&Tally::ulps, &Tally::wrong_ulps, &Tally::wrong_conditions})
    (this->*errors).insert((this->*errors).end(), (other.*errors).begin(), (other.*errors).end());
}

double Tally::mean_ulp() const {
  return ulps.empty() ? 0 : std::accumulate(ulps.begin(), ulps.end(), 0.0) / static_cast<double>(ulps.size());
}

double Tally::max_ulp() const {
  return ulps.empty() ? 0 : *std::max_element(ulps.begin(), ulps.end());
}

}  // namespace lorentz::question
