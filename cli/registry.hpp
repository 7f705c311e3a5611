// Everything that answers queries, by name: the binary64 engines, the oracle, and walk.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oracle.hpp"
#include "problem.hpp"

namespace lorentz::cli {

/// Answers the queries of one scene, into an answer that is there already. `digits` are the oracle's only; a
/// detail that binary64 cannot compute is left out.
using FirstHit = std::function<void(const Query&, const oracle::Request&, Answer&)>;

/// All names, for help texts and checks.
std::vector<std::string> answerer_names();

/// Throws InputError for an unknown name.
void check_name(const std::string& name);

/// For a scene without flaws.
FirstHit make_first_hit(const std::string& name, const Scene& scene);

}  // namespace lorentz::cli
