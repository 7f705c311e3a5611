// The record that a campaign keeps of a case that went wrong, in the words of the exchange formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "fuzz/campaign/examiner.hpp"

namespace lorentz::fuzz {

/// A case as text: one line each, without the line end. The answers are as in answer streams.
struct CaseText {
  std::string scene, query, given, exact;
  double departs = 0;            ///< as in oracle::Judgement
  std::optional<double> margin;  ///< of the exact answer

  /// The members in the order in which stores and messages between ranks have them.
  friend auto members_of(CaseText& self) {
    return std::tie(self.scene, self.query, self.given, self.exact, self.departs, self.margin);
  }
};

/// How far the shrinking of a finding has come.
enum class Shrinking {
  due,        ///< not begun
  cut_short,  ///< ended by the time limit
  done        ///< complete, or the finding cannot be shrunk
};

struct Finding {
  std::string target;
  std::uint64_t index = 0;
  int step = 0;       ///< 0: the case itself; otherwise the number of its variant
  std::string words;  ///< the other words in which the case was asked; empty if in its own
  std::string kind;   ///< name_of(Kind).words
  std::string sort;   ///< of each sort (sort_of) and target only the first few are kept
  std::string cause;  ///< of the shrunk case (cause_of)
  CaseText text;      ///< as found
  CaseText shrunk;    ///< the same until shrinking begins
  Shrinking shrinking = Shrinking::due;
  int bits = 0;         ///< the largest number of significant bits in the shrunk case
  long complexity = 0;  ///< of the shrunk case
  int tries = 0;        ///< number of tries of shrinking

  friend auto members_of(Finding& self) {
    return std::tie(self.target, self.index, self.step, self.words, self.kind, self.sort, self.cause,
                    self.text, self.shrunk, self.shrinking, self.bits, self.complexity, self.tries);
  }
};

/// Kinds in the order in which they matter: `wrong` first, then wrong time, error, undecided. They are
/// shrunk and listed in this order.
int rank_of(std::string_view kind);

CaseText text_of(const std::string& id, const Scene& scene, const Query& query, const Examined& examined);

/// A case as read from its lines.
struct ReadCase {
  Scene scene;
  Query query;
  Answer given, exact;
};

/// Throws FileError if these are not lines that text_of() wrote.
ReadCase case_in(const CaseText& text);

/// The obvious properties of a case as it was met: kind, dimension, outcomes, `from`. Like "wrong, 2D, hit
/// for hit, leaving".
std::string sort_of(const Scene& scene, const Query& query, const Examined& examined);

/// What a shrunk case says about the fault behind it. Findings with the same cause are taken for duplicates.
/// The cause consists of
/// - the kind; for wrong hits, whether the obstacle named comes before the true one (then the line does not
///   even meet it) or after it (then the true one was passed over); for others, both outcomes;
/// - the dimension, and the scene: unit lattice, lattice, several atoms, several lattices, with ellipsoids;
/// - of the query: leaving (`from` matters), along an axis, in a plane of axes (3D), a far start, numbers
///   near the ends of the range.
std::string cause_of(const Scene& scene, const Query& query, const Examined& examined);

}  // namespace lorentz::fuzz
