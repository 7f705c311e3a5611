// What kernels and their host share: which flights are to be flown, and what is counted of them.
#pragma once

#include <cstdint>

#include "src/engines/gpu/columns.hpp"

namespace lorentz::gpu {

/// The sizes of flights::Bins.
inline constexpr unsigned kLogarithmic = 802, kLinear = 257;

/// A sum of flights::ExactSum in parts: integers in units of 2^(32 i - 1074), added up modulo 2^64. Their sum
/// is that of signed integers, because a launch has fewer than 2^28 summands, of less than 2^34 a digit.
struct DigitSums {
  static constexpr int kDigits = 68, kLowest = -1074;
  std::uint64_t digits[kDigits];
};

inline constexpr std::uint64_t kPiece = 1 << 16;  ///< flights::kBlock

/// Flights from drawn starts, in a scene on the card: as starts::Candidates draws uniform ones, and
/// FlightTally counts.
struct DrawnFlights {
  const Bravais* atoms;
  std::uint64_t atom_count;
  double unit, inverse_unit;                  ///< of PreparedScene
  double vectors[3][3], cells[3], corner[3];  ///< of cases::Box
  std::uint64_t seed, series;                 ///< the key of the random numbers
  std::uint64_t first, count;  ///< the starts: `count`, in pieces of kPiece from `first` on, one in `every`
  std::uint64_t every;
  int bins_exponent;  ///< of Bins
  bool hard;          ///< directions are moved next to rational ones
};

/// A start that the card does not decide: whose flight lanes leave to a single one, or whose time is not
/// known to be correctly rounded. Its candidates before this attempt lay in obstacles, and have been counted.
struct LeftStart {
  std::uint64_t index, attempt;
};

/// The results; zero before a launch.
struct DrawnTally {
  std::uint64_t hits, never, inside;
  std::uint64_t zeros;              ///< hits at t = 0
  std::uint64_t longest, shortest;  ///< as bits; `shortest` counted from the largest number down
  DigitSums time, square, log;
  std::uint64_t logarithmic[kLogarithmic], linear[kLinear];
  std::uint64_t left;  ///< starts in the list, or more, if it was too short
};
inline constexpr std::uint64_t kMostLeft = 1 << 20;  ///< the length of the list behind a tally

}  // namespace lorentz::gpu
