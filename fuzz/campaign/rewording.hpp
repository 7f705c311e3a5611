// The same question in other words: another basis, units, axes, names, a start elsewhere in the lattice. The
// answer must be the same. docs/campaigns.md, "In other words", lists the relations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include "fuzz/campaign/exact_sums.hpp"
#include "fuzz/campaign/rewording_steps.hpp"

namespace lorentz::fuzz {

/// A query in the words of a rewording, with the changes that belong to the query and not to the scene.
struct Reworded {
  Query query;
  std::array<std::int64_t, 3> periods{};  ///< periods of the scene by which its start was moved
  int speed = 0;                          ///< its velocity was multiplied by 2^speed
  bool rounded = false;  ///< its start is the old one moved, rounded to binary64: another question
};

/// The vectors after which every lattice of a scene repeats: all multiples of `multiple` of lattice 0's
/// vectors, if `multiple` is at most kMostBitsOfMultiple long. For each lattice l a matrix P with U_l P k =
/// multiple U_0 k. A lattice of fewer vectors than dimensions has its own if it is the only one; otherwise
/// the scene has none.
struct Periods {
  static constexpr long kMostBitsOfMultiple = 20;

  explicit Periods(const Scene& scene);

  Z multiple = 1;
  std::vector<IntegerMatrix> in_cells;  ///< empty if the scene has no periods
};

/// Other words for one scene: a chain of a few steps, each drawn as mild or as hard as the numbers allow.
/// Everything is exact: what binary64 cannot express is not said.
class Rewording {
 public:
  /// The scene must be without flaws, its vectors independent.
  Rewording(cases::Random& random, const Scene& scene);

  /// The scene in the new words.
  const Scene& scene() const { return scene_; }

  /// What was done, like "basis 2^37, lengths 2^-1000, start moved 2^12, velocity 2^40".
  std::string words(const Reworded& reworded) const;

  /// A query without flaws in the new words, its start often moved by periods of the scene and its velocity
  /// in other units; nothing if its numbers are not binary64 values there.
  std::optional<Reworded> reword(cases::Random& random, const Query& query) const;

  /// Maps an obstacle from the old words to the new ones, and back.
  ObstacleId there(ObstacleId id, const Reworded& reworded) const;
  ObstacleId back(ObstacleId id, const Reworded& reworded) const;

  /// The exact answer to the old question as one to the new: `hit`, `inside` or `never`. Where obstacles are
  /// entered together, another of them may be the first in the order (lattice, atom, cell) there; everything
  /// else is exact. Nothing if the old answer does not determine the time's rounding in the new units, or if
  /// the question is another one.
  std::optional<Answer> carried(const Answer& exact, const Reworded& reworded) const;

 private:
  void move_start(cases::Random& random, Reworded& reworded) const;
  void round_start(const std::array<std::int64_t, 3>& k, const IntegerVec& cells, Reworded& reworded) const;
  void shift(ObstacleId& id, const Reworded& reworded, int sign) const;

  int rank_;                    // of lattice 0
  Scene scene_;                 // in the new words
  std::array<Vec, 3> vectors_;  // of lattice 0, in the old
  Periods periods_;             // in the old
  std::vector<RewordingStep> steps_;
};

}  // namespace lorentz::fuzz
