// A picture of one answer beside the exact one: the flight, the obstacle in question, and an inset with
// enough magnification to show by how much it is met or missed.
#pragma once

#include <optional>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::pictures {

/// An <svg> for a page: no scripts, no ids, no external resources; numbers appear under the mouse. A page may
/// set the colours --exact, --given, --ink, --faint and --paper. In 3D it shows the plane of the flight and
/// the centre of the obstacle in question, and a view along the flight. A flight of many cells is broken; its
/// ends are to scale.
///
/// Distances in the inset are exact, rounded to 52 bits: 1e-15 of a radius is drawn as well as a tenth.
/// `exact` is the oracle's answer: hit, inside or never. The text is empty if scene, query or `exact` cannot
/// be drawn (flaw_of). `given` may be any answer; without one, the decision of smallest margin is shown.
/// `decisive` is the obstacle by which it is judged (Judgement::obstacle), which is therefore shown; the exact
/// one if that is not known. Margins are in ulps of the precision.
std::string finding_drawing(const Scene& scene, const Query& query, const std::optional<Answer>& given,
                            const Answer& exact, const std::optional<ObstacleId>& decisive = {},
                            NumberFormat precision = NumberFormat::binary64);

}  // namespace lorentz::pictures
