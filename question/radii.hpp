// Lengths in radii, which say more of an error than ulps of a time near 0 do.
#pragma once

#include <optional>

#include "question/question.hpp"

namespace lorentz::question {

/// A ball's radius, or the smallest of an ellipsoid's principal semiaxes.
double smallest_semiaxis(const Atom& atom, int dimension);

/// |t' - t| |v| / r: so far along the ray the time of the right obstacle is off, in its radii (of an ellipsoid its
/// smallest semiaxis). Nothing if the two answers have no two finite times.
std::optional<double> radii_off(const Question& question, const Answer& given);

}  // namespace lorentz::question
