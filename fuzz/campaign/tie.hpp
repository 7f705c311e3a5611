// If several obstacles contain x, or are entered together, the answer is the first of them in the order
// (lattice, atom, cell). In other words for the scene that may be another one.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include <lorentz/verdict.hpp>

namespace lorentz::fuzz {

/// Whether an answer differs from the exact one only by the choice among obstacles that it may name: the
/// outcome is the same, and the time is the same to the bit. Decided exactly. The scene must have no flaw;
/// the judge must be that scene's.
bool is_tie(const Scene& scene, const oracle::Judge& judge, const Query& query, const Answer& exact,
            const Answer& other);

}  // namespace lorentz::fuzz
