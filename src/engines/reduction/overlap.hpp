// Do the obstacles of one atom overlap their own translates? Decided without rounding.
#pragma once

#include <optional>

#include <lorentz/vec.hpp>

namespace lorentz {

/// True if an obstacle { A y : |y| < 1 }, whose semiaxes are the columns of A, overlaps its translate by
/// t_0 u_0 + t_1 u_1 + t_2 u_2. (Two that touch do not overlap.) Requires integers t below 2^30. Nothing if
/// products are so small that they are not exact.
std::optional<bool> overlaps_translate(const Vec (&semiaxes)[3], const Vec (&u)[3], const Vec& t);

}  // namespace lorentz
