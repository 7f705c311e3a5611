// The reduction engine's own result: an answer without strings, and the stage of its ladder that decided.
#pragma once

#include <cstdint>

#include <lorentz/answer.hpp>

namespace lorentz {

/// The stages of a filtered decision, from the cheapest to the one that gives up.
enum class Stage : std::uint8_t { binary64, double_double, undecided };

/// Counts queries by the stage that decided them: the last stage that any of a query's decisions needed.
struct StageTally {
  std::uint64_t binary64 = 0, double_double = 0, undecided = 0;

  void count(Stage stage) {
    ++(stage == Stage::binary64 ? binary64 : stage == Stage::double_double ? double_double : undecided);
  }
};

/// The first hit of a query. `lattice`, `atom` and `cell` are set for `hit` and `inside`.
struct Flight {
  Outcome outcome = Outcome::undecided;
  Stage stage = Stage::binary64;
  bool time_is_rounded = false;  ///< true if the time is known to be correctly rounded
  bool is_far = false;           ///< true if 64 bits do not hold the cell, which `cell` then does not say
  int lattice = 0, atom = 0;
  std::array<std::int64_t, 3> cell{};  ///< set for `hit` and `inside`
  double time = 0;                     ///< set for `hit`, in units in which x + time v is the collision point

  friend bool operator==(const Flight&, const Flight&) = default;
};

}  // namespace lorentz
