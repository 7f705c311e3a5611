// Why an answer departs from the exact one, for people: by how much the obstacle in question is met or
// missed, and which decision is hard.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/margin.hpp>

namespace lorentz::report {

/// "3.5 ulps"; from 2^20 on "2^20 ulps or more", because larger numbers say nothing, as for times near 0.
std::string ulps_text(double ulps);

/// "lattice 0, atom 1, cell (2, -1)".
std::string name_of(const ObstacleId& obstacle, const Components& count);

/// The decision that an exact answer rests on with the smallest margin, in a sentence.
std::string decision_text(const oracle::HardestDecision& decision, const Components& count);

/// The disagreement with an answer that names another obstacle or outcome than the exact one.
struct Dispute {
  /// By how many of its radii the line misses the obstacle in question (named though it is missed, or passed
  /// over), or (below 0) meets it. If the start is in question: by how many x lies outside or inside it.
  double radii = 0;
  std::string text;  ///< a sentence
};

/// Nothing if the two agree except for a time, or if an answer names no obstacle of the scene. `decisive` is
/// the obstacle that the judgement rests on (Judgement::obstacle), or the exact one if that is not known.
std::optional<Dispute> dispute_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                                  const Answer& exact, const Answer& given,
                                  const std::optional<ObstacleId>& decisive);

/// The obstacle by which such an answer is judged, with the usual tolerance in ulps of the claim; nothing if
/// the exact answer names none.
std::optional<ObstacleId> decisive_of(const Scene& scene, const Query& query, const Answer& exact,
                                      const Answer& given, const Claim& claim);

/// The dispute and the hard decision, one line each. Empty if the two agree.
std::vector<std::string> reason_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                                   const Answer& exact, const Answer& given,
                                   const std::optional<ObstacleId>& decisive);

}  // namespace lorentz::report
