// The text of a file in which a run is kept in pieces: what the run depends on, and what is done of it. Every
// line has a checksum, so that what was changed is noticed before it is believed.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lorentz::store {

/// All that the pieces of a run depend on, as names and values. Runs are the same if all of it is the same.
using Plan = std::vector<std::pair<std::string, std::string>>;

/// A header line of the kind ("flights", "bench", ..) and the plan, and a line for each piece. A piece is a
/// JSON object without line ends; what it means is known to the run.
std::string text_of(std::string_view kind, const Plan& plan, const std::vector<std::string>& pieces);

/// What to do about a file that cannot be believed.
inline constexpr const char* kRemedy =
    "; take a copy from before, or name another file (this one stays as it is)";

/// The line, from 1, of the first piece.
inline constexpr std::size_t kFirstPiece = 2;

/// The pieces in what text_of() wrote of the same kind and plan. Throws InputError for anything else, with
/// the line, or with what differs in the plan.
std::vector<std::string> pieces_in(std::string_view text, std::string_view kind, const Plan& plan);

}  // namespace lorentz::store
