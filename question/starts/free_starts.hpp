// Starts of several kinds that lie outside all obstacles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lorentz/certified.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/starts/candidates.hpp"

namespace lorentz::starts {

/// The default seed of drawn starts.
inline constexpr std::uint64_t kDefaultSeed = 20161115;

/// Kinds of starts.
enum class Kind {
  uniform,        ///< anywhere outside the obstacles, in any direction
  surface,        ///< on an obstacle's surface, by the cosine law, with `from`
  near_rational,  ///< anywhere, along a small lattice vector or a few ulps or 2^-40 beside it
  grazing         ///< the line passes or meets an obstacle within several ulps to 2^-10 of its edge
};

/// The names of all kinds that users know, in the order of Kind.
const std::vector<std::string>& kind_names();
inline const std::string& name_of(Kind kind) {
  return kind_names()[static_cast<std::size_t>(kind)];
}

/// The kind of this name. Throws InputError if the name is unknown; the message begins with `what`.
Kind kind_named(const std::string& name, const std::string& what);

/// The same for ensembles, which are the first two kinds.
flights::Ensemble ensemble_named(const std::string& name, const std::string& what);
constexpr Kind kind_of(flights::Ensemble ensemble) {
  return ensemble == flights::Ensemble::uniform ? Kind::uniform : Kind::surface;
}

/// Numbered starts. For `uniform` and `surface` they are those of Candidates: the first free attempt of each.
class FreeStarts {
 public:
  /// For a scene without flaws (flaw_of) and with independent vectors (oracle::dependence_in). Throws
  /// InputError as Candidates does. Starts consist of numbers of the format; the scene must, too.
  FreeStarts(const Scene& scene, Kind kind, std::uint64_t seed, NumberFormat format = NumberFormat::binary64);

  /// Start number `index`, which depends only on scene, kind, seed and index. It lies in no open obstacle
  /// except `from`; this is decided exactly. Throws InputError if Candidates::kMostAttempts candidates give
  /// no start.
  void draw(std::uint64_t index, Query& start) const;
  Query operator[](std::uint64_t index) const {
    Query start;
    draw(index, start);
    return start;
  }

  /// True if the start lies in no open obstacle except `from`. Exact.
  bool is_free(const Query& start) const;

 private:
  /// True if the candidate could be made into a start of the kind.
  bool make(cases::Random& random, Query& start) const;
  /// True if the start is valid after rounding, too.
  bool round(Query& start) const;

  Scene scene_;
  Kind kind_;
  std::uint64_t seed_;
  NumberFormat format_;
  Candidates candidates_;
  oracle::Oracle oracle_;
  oracle::Certified certified_;
};

/// Aims at a point in an obstacle of cell 0, because few lines meet an obstacle if most of space is empty. v then has
/// the length of the way there.
void aim(cases::Random& random, const Scene& scene, Query& start);

/// The first `count` starts of a scene.
inline std::vector<Query> free_starts(const Scene& scene, Kind kind, std::uint64_t seed, std::size_t count,
                                      NumberFormat format = NumberFormat::binary64) {
  const FreeStarts starts(scene, kind, seed, format);
  std::vector<Query> first(count);
  for (std::size_t i = 0; i < count; ++i) starts.draw(i, first[i]);
  return first;
}

}  // namespace lorentz::starts
