// Where speed does not matter, Python uses the project's own format: a scene, a query or an answer as a line
// of JSON, which the reader of this format reads and checks. Private to python/.
#pragma once

#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>

namespace lorentz::python {

/// Reads `{"scene": {..}}`. Unknown keys are errors. Throws InputError.
Scene read_scene(const std::string& text);
RationalScene read_rational_scene(const std::string& text);

/// Reads `{"x": [..], "v": [..], "from": {..}}`. Throws InputError.
Query read_query(const std::string& text, const Scene& scene);
Start read_start(const std::string& text, const RationalScene& scene);

/// Reads `{"outcome": "hit", ..}`. Unknown keys are errors. Throws InputError.
Answer read_answer(const std::string& text, const Components& count);

/// Writes an answer as such a line.
std::string answer_text(const Answer& answer, const Components& count);

/// The handler of unknown keys for the readers: throws InputError.
void refuse_key(const std::string& key);

/// The claim in the line that a program writes about itself (question/introduction.hpp). Throws InputError.
Claim claim_of(const std::string& line);

}  // namespace lorentz::python
