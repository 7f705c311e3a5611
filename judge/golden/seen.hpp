// What the program finds out about a given question: tags, and a comment on its difficulty.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lorentz/margin.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::golden {

/// All tags, each with the sentence that explains it.
const std::vector<std::pair<std::string, std::string>>& seen_tags();

/// The tags of a question with this exact answer and this hardest decision (or nothing).
std::vector<std::string> tags_seen(const Scene& scene, const Query& query, const Answer& exact,
                                   const std::optional<oracle::HardestDecision>& decision);

/// "misses lattice 0, atom 0, cell [3,1] by 2.1 ulps"; empty if no decision is hard.
std::string comment_on(const std::optional<oracle::HardestDecision>& decision, const Components& count);

}  // namespace lorentz::golden
