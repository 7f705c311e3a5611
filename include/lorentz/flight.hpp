// What the reduction engine itself hands out: an Answer without strings, and which stage of its ladder
// decided.
#pragma once

#include <cstdint>

#include <lorentz/answer.hpp>

namespace lorentz {

/// The stages of a filtered decision, from the cheapest to the one that gives up.
enum class Stage : std::uint8_t { binary64, double_double, undecided };

/// How many queries each stage has decided: the last stage that any of a query's decisions needed.
struct StageTally {
  std::uint64_t binary64 = 0, double_double = 0, undecided = 0;

  void count(Stage stage) {
    ++(stage == Stage::binary64 ? binary64 : stage == Stage::double_double ? double_double : undecided);
  }
};

/// What the first hit of a query came to. `lattice`, `atom` and `cell` are of `hit` and `inside`.
struct Flight {
  Outcome outcome = Outcome::undecided;
  Stage stage = Stage::binary64;
  bool time_is_rounded = false;  ///< the time is known to be correctly rounded
  int lattice = 0, atom = 0;
  std::array<std::int64_t, 3> cell{};  ///< of `hit` and `inside`
  double time = 0;                     ///< of `hit`, in units in which x + time v is the place
};

}  // namespace lorentz
