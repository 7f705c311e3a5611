// Where an engine begins to fail: its answers by the decade of what makes a question hard.
#pragma once

#include <array>
#include <map>
#include <optional>

#include <lorentz/verdict.hpp>

namespace lorentz::judge {

/// What makes a question hard.
enum class Measure {
  call,      ///< by how many radii the line enters or misses the obstacle in question
  distance,  ///< from the start to the centre of the obstacle in question, in its radii
  flight,    ///< to the obstacle that is hit, in lattice vectors
  start,     ///< from the origin to the start, in lattice vectors
  radius     ///< the smallest, in lattice vectors
};
inline constexpr int kMeasures = 5;

const char* name_of(Measure measure);

/// Answers from 10^decade to 10^(decade + 1).
struct Call {
  std::size_t right = 0, ill_posed = 0, wrong = 0, undecided = 0;
  double radii_off = 0;  ///< the largest error of a time, along the ray
};

/// By decade. A tolerance shows as an edge: wrong below, right above.
class Calls {
 public:
  /// Of an answer that is right or undecided the obstacle in question is the one that is hit, of others the
  /// one that is passed over or named. Nothing to tell: no size, or 0, or another verdict than the four.
  void add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off = {});
  void add(const Calls& others);

  const std::map<int, Call>& by_decade() const { return by_decade_; }

 private:
  std::map<int, Call> by_decade_;
};

/// One for each measure.
using Curves = std::array<Calls, kMeasures>;

}  // namespace lorentz::judge
