// What a campaign keeps of a case that went wrong, in the words of the exchange formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "fuzz/examine/examiner.hpp"

namespace lorentz::fuzz {

/// A case in words: one line each, without the line end. The answers are as in answer streams.
struct CaseText {
  std::string scene, query, given, exact;
  double departs = 0;            ///< as in oracle::Judgement
  std::optional<double> margin;  ///< of the exact answer
};

/// How far a finding is on its way to the simplest case.
enum class Shrinking {
  due,        ///< nobody has begun
  cut_short,  ///< as far as the time allowed
  done        ///< as far as it goes, or it cannot be shrunk
};

struct Finding {
  std::string target;
  std::uint64_t index = 0;
  int step = 0;       ///< 0: the case itself; else its variant of this number
  std::string words;  ///< of a case asked in other words, and found there: which; else empty
  std::string kind;   ///< name_of(Kind)
  std::string sort;   ///< what of each target only the first few are kept of (sort_of)
  std::string cause;  ///< of the shrunk case (cause_of)
  CaseText text;      ///< as found
  CaseText shrunk;    ///< the same until shrinking begins
  Shrinking shrinking = Shrinking::due;
  int bits = 0;         ///< the most that a number of the shrunk case has
  long complexity = 0;  ///< of the shrunk case
  int tries = 0;        ///< that shrinking took
};

/// Kinds in the order in which they matter: `wrong` first, then wrong time, error, undecided, slow. They are
/// shrunk and listed in this order.
int rank_of(std::string_view kind);

CaseText text_of(const std::string& id, const Scene& scene, const Query& query, const Examined& examined);

/// A case as its lines say it.
struct ReadCase {
  Scene scene;
  Query query;
  Answer given, exact;
};

/// Throws FileError if these are no lines of text_of().
ReadCase case_in(const CaseText& text);

/// Why a finding is not one that a campaign keeps, or nothing. A finding without a flaw has lines that
/// case_in() reads, each of them JSON, and no control characters.
std::string flaw_of(const Finding& finding);

/// Does the scene have what the answer names?
bool is_in(const Scene& scene, const Answer& answer);

/// What is plain from a case as it was met: kind, dimension, outcomes, `from`. Like "wrong, 2D, hit for hit,
/// leaving".
std::string sort_of(const Scene& scene, const Query& query, const Examined& examined);

/// What a shrunk case says about the fault behind it. Findings of one cause are taken for duplicates. It is
/// made of
/// - the kind; of wrong hits: whether the obstacle named comes before the true one (then the line does not
///   even meet it) or after it (then the true one was passed over); of others: both outcomes;
/// - the dimension, and the scene: unit lattice, lattice, several atoms, several lattices, with ellipsoids;
/// - of the query: leaving (`from` matters), along an axis, in a plane of axes (3D), a far start, numbers
///   near the ends of the range.
/// What is read back otherwise than it was written is one cause: a fault of the reader shows in one notation
/// as in another, and in scenes of every kind.
std::string cause_of(const Scene& scene, const Query& query, const Examined& examined);

}  // namespace lorentz::fuzz
