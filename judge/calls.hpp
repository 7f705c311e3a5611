// How close the calls were: answers, by how many radii the line enters or misses the obstacle in question.
#pragma once

#include <map>
#include <optional>

#include <lorentz/verdict.hpp>

namespace lorentz::judge {

/// Answers with a call from 10^decade to 10^(decade + 1) radii.
struct Call {
  std::size_t right = 0, ill_posed = 0, wrong = 0, undecided = 0;
};

/// By decade. A tolerance shows as an edge: wrong below, right above.
class Calls {
 public:
  /// Of an answer that is right or undecided the obstacle in question is the one that is hit, of others the
  /// one that is passed over or named. Nothing to tell: no radii, or 0, or another verdict than the four.
  void add(std::optional<double> radii, oracle::Verdict verdict);
  void add(const Calls& others);

  const std::map<int, Call>& by_decade() const { return by_decade_; }

 private:
  std::map<int, Call> by_decade_;
};

}  // namespace lorentz::judge
