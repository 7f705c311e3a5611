// Starts that lie in no obstacle, of several kinds.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// What starts are like.
enum class Kind {
  uniform,        ///< anywhere outside the obstacles, in any direction
  surface,        ///< off an obstacle, by the cosine law, with `from`
  near_rational,  ///< anywhere, along a small lattice vector or a few ulps, or 2^-40, beside it
  grazing         ///< the line passes or meets an obstacle within some ulps to 2^-40 of its edge
};

/// All kinds, by the names that people know them by; in the order of Kind.
const std::vector<std::string>& kind_names();

/// Starts, numbered; of `uniform` and `surface` those of Starts, the first attempt of each that is free.
class FreeStarts {
 public:
  /// For a scene without flaws (flaw_of) and with independent vectors (oracle::dependence_in). Throws
  /// InputError as Starts does.
  FreeStarts(const Scene& scene, Kind kind, std::uint64_t seed);
  ~FreeStarts();
  FreeStarts(FreeStarts&&) noexcept;

  /// Start number `index`, which depends on scene, kind, seed and index only. In no open obstacle but `from`:
  /// decided exactly. Throws InputError if Starts::kMostAttempts candidates do not come to one.
  void draw(std::uint64_t index, Query& start) const;

 private:
  struct Inside;
  std::unique_ptr<const Inside> inside_;
};

}  // namespace lorentz::flights
