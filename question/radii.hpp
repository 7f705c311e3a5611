// Errors as lengths in radii. For times near 0 these say more than ulps.
#pragma once

#include <optional>

#include "question/question.hpp"

namespace lorentz::question {

/// A ball's radius, or the smallest of an ellipsoid's principal semiaxes.
double smallest_semiaxis(const Atom& atom, int dimension);

/// |t' - t| |v| / r: the error of the time as a distance along the ray, in radii of the right obstacle (for
/// an ellipsoid its smallest semiaxis). Nothing unless both answers have finite times.
std::optional<double> radii_off(const Question& question, const Answer& given);

}  // namespace lorentz::question
