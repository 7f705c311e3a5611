// Unions of open intervals on a circle, exactly: the parts of a period that the obstacles of a scene, seen
// along its planes, leave free. Private to oracle/.
#pragma once

#include <vector>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// The open interval (start - sqrt(start2), end + sqrt(end2)), repeated with a period.
struct Blocked {
  Z start, start2, end, end2;
};

/// The open interval (low + sqrt(low2), high - sqrt(high2)) between two blocks.
struct Gap {
  Z low, low2, high, high2;

  /// Its width is width() - sqrt(low2) - sqrt(high2).
  Z width() const { return high - low; }
  void shift(const Z& by) { low += by, high += by; }
};

/// The gaps of the union of the blocks modulo `period`, those of one period in ascending order. A gap has a
/// width above 0, so touching blocks leave no gap between them. Without blocks there are no gaps.
std::vector<Gap> gaps_between(std::vector<Blocked> blocks, const Z& period);

/// The blocks between the gaps, over `copies` periods.
std::vector<Blocked> blocks_between(const std::vector<Gap>& gaps, const Z& period, unsigned long copies);

/// How blocks (at least one) cover a circle: with gaps, touching somewhere so that points stay free, or
/// fully.
enum class Cover { gaps, touching, full };
Cover cover_of(std::vector<Blocked> blocks, const Z& period);

}  // namespace lorentz::oracle
