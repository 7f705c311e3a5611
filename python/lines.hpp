// Python speaks the project's own format where speed does not matter: a scene, a query, an answer as a line
// of JSON, read and checked by the one reader that knows the format. Private to python/.
#pragma once

#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>

namespace lorentz::python {

/// Of `{"scene": {..}}`; a key that scenes do not have is an error. Throws InputError.
Scene read_scene(const std::string& text);
RationalScene read_rational_scene(const std::string& text);

/// Of `{"x": [..], "v": [..], "from": {..}}`. Throws InputError.
Query read_query(const std::string& text, const Scene& scene);
Start read_start(const std::string& text, const RationalScene& scene);

/// Of `{"outcome": "hit", ..}`; a key that answers do not have is an error. Throws InputError.
Answer read_answer(const std::string& text, const Components& count);

/// An answer as such a line.
std::string answer_text(const Answer& answer, const Components& count);

/// Throws InputError: what readers are to do with keys that they do not know.
void refuse_key(const std::string& key);

/// What an engine claims, "binary64" or "binary32".
inline Claim claim_of(const std::string& precision, std::optional<double> time_tolerance) {
  return {precision == "binary32" ? NumberFormat::binary32 : NumberFormat::binary64, time_tolerance};
}

}  // namespace lorentz::python
