// What the program sees of a question that was given: tags, and a comment on what is hard about it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lorentz/margin.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::golden {

/// The tags that there are, each with the sentence that explains it.
const std::vector<std::pair<std::string, std::string>>& seen_tags();

/// Those of a question with this exact answer, and the decision that is the hardest (or nothing).
std::vector<std::string> tags_seen(const Scene& scene, const Query& query, const Answer& exact,
                                   const std::optional<oracle::HardestDecision>& decision);

/// "misses lattice 0, atom 0, cell [3,1] by 2.1 ulps"; empty where no decision is hard.
std::string comment_on(const std::optional<oracle::HardestDecision>& decision, const Components& count);

}  // namespace lorentz::golden
