// The one question that a finding comes down to, for people to copy: a ray, and one ball or ellipsoid.
#pragma once

#include <optional>
#include <string>

#include <lorentz/margin.hpp>

namespace lorentz::report {

/// Every number exactly, the truth about it, and a snippet of C++ that has the same numbers.
struct Primitive {
  std::string
      json;  ///< origin, direction, centre, radius or semiaxes (hexadecimal), discriminant, entry_time
  std::string cpp;
};

/// Of an obstacle that exists.
Primitive primitive_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                       const ObstacleId& obstacle);

}  // namespace lorentz::report
