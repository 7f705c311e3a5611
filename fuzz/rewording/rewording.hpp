// The same question in other words: another basis, units, axes, names, a start elsewhere in the lattice. The
// answer must be the same. docs/campaigns.md, "In other words", lists the relations.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::fuzz {

/// A query in the words of a rewording, with the changes that belong to the query and not to the scene.
struct Reworded {
  Query query;
  std::array<std::int64_t, 3> periods{};  ///< periods of the scene by which its start was moved
  int speed = 0;                          ///< its velocity was multiplied by 2^speed
  bool rounded = false;  ///< its start is the old one moved, rounded to binary64: another question
};

/// Other words for one scene: a chain of a few steps, each drawn as mild or as hard as the numbers allow.
/// Everything is exact: what binary64 cannot express is not said.
class Rewording {
 public:
  /// The scene must be without flaws, its vectors independent.
  Rewording(cases::Random& random, const Scene& scene);
  Rewording(Rewording&&) noexcept;
  Rewording& operator=(Rewording&&) noexcept;
  ~Rewording();

  /// The scene in the new words.
  const Scene& scene() const;

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
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace lorentz::fuzz
