// The one question to which a finding reduces, for people to copy: a ray, and one ball or ellipsoid.
#pragma once

#include <optional>
#include <string>

#include <lorentz/margin.hpp>

namespace lorentz::report {

/// All numbers exactly, the true answer, and a snippet of C++ with the same numbers.
struct Primitive {
  std::string
      json;  ///< origin, direction, centre, radius or semiaxes (hexadecimal), discriminant, entry_time
  std::string cpp;
};

/// The obstacle must exist.
Primitive primitive_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                       const ObstacleId& obstacle);

}  // namespace lorentz::report
