// A picture of one answer beside the exact one: the flight, the obstacle in question, and an inset that is
// magnified until one sees by how much it is met or missed.
#pragma once

#include <optional>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::pictures {

/// An <svg> to be put into a page: no scripts, no ids, nothing from elsewhere; numbers show under the mouse.
/// A page may set the colours --exact, --given, --ink, --faint and --paper. In space it shows the plane that
/// holds the flight and the centre of the obstacle in question, and a view along the flight. A flight of many
/// cells is broken, its ends are to scale.
///
/// Distances in the inset are exact ones, rounded to 52 bits: 1e-15 of a radius is drawn as well as a tenth.
/// `exact` is the oracle's answer: hit, inside or never. Empty if scene, query or `exact` is none to be drawn
/// (flaw_of). `given` may be anything. `decisive`: the obstacle that it is judged by (Judgement::obstacle),
/// and that is shown therefore; the exact one if it is not known.
std::string finding_drawing(const Scene& scene, const Query& query, const Answer& given, const Answer& exact,
                            const std::optional<ObstacleId>& decisive = {});

/// The same of the exact answer alone, with the decision that it rests on with the smallest margin.
std::string finding_drawing(const Scene& scene, const Query& query, const Answer& exact);

}  // namespace lorentz::pictures
