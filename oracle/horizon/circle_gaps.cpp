#include "oracle/horizon/circle_gaps.hpp"

#include <algorithm>

#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/root_sums.hpp"

namespace lorentz::oracle {
namespace {

// Sign of (a + sqrt(a2)) - (b + sqrt(b2)).
int compare_ends(const Z& a, const Z& a2, const Z& b, const Z& b2) {
  return -compare_entries(-a, a2, -b, b2);
}

// Moves the start of each block into [0, period), and sorts the blocks by start.
void put_in_order(std::vector<Blocked>& blocks, const Z& period) {
  for (Blocked& block : blocks) {
    const Z turns = period * floor_surd(block.start, -1, block.start2, period);
    block.start -= turns;
    block.end -= turns;
  }
  std::sort(blocks.begin(), blocks.end(), [](const Blocked& a, const Blocked& b) {
    return compare_entries(a.start, a.start2, b.start, b.start2) < 0;
  });
}

// Calls visit(order, reach, reach2, block) for each block in order. reach + sqrt(reach2) is the furthest end
// of the blocks before, and `order` is the sign of this end minus the block's start.
template <class Visit>
void sweep(std::vector<Blocked>& blocks, const Z& period, Visit visit) {
  if (blocks.empty()) return;
  put_in_order(blocks, period);
  const auto last = std::max_element(blocks.begin(), blocks.end(), [](const Blocked& a, const Blocked& b) {
    return compare_ends(a.end, a.end2, b.end, b.end2) < 0;
  });
  // The blocks of the period before come first. If one of them reaches further than a period, nothing is free
  // anyway, so one turn is enough.
  Z reach = last->end - period, reach2 = last->end2;
  for (const Blocked& block : blocks) {
    visit(-sign_of_rest(block.start - reach, block.start2, reach2), reach, reach2, block);
    if (compare_ends(block.end, block.end2, reach, reach2) > 0) reach = block.end, reach2 = block.end2;
  }
}

}  // namespace

std::vector<Gap> gaps_between(std::vector<Blocked> blocks, const Z& period) {
  std::vector<Gap> gaps;
  sweep(blocks, period, [&](int order, const Z& reach, const Z& reach2, const Blocked& block) {
    if (order < 0) gaps.push_back({reach, reach2, block.start, block.start2});
  });
  return gaps;
}

std::vector<Blocked> blocks_between(const std::vector<Gap>& gaps, const Z& period, unsigned long copies) {
  std::vector<Blocked> blocks;
  blocks.reserve(gaps.size() * copies);
  for (unsigned long copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const bool last = i + 1 == gaps.size();
      const Gap &gap = gaps[i], &next = gaps[last ? 0 : i + 1];
      const Z turn = period * copy, next_turn = last ? Z(turn + period) : turn;
      blocks.push_back({Z(gap.high + turn), gap.high2, Z(next.low + next_turn), next.low2});
    }
  return blocks;
}

Cover cover_of(std::vector<Blocked> blocks, const Z& period) {
  bool touch = false, gap = false;
  sweep(blocks, period, [&](int order, auto&&...) {
    touch |= order == 0;
    gap |= order < 0;
  });
  return gap ? Cover::gaps : touch ? Cover::touching : Cover::full;
}

}  // namespace lorentz::oracle
