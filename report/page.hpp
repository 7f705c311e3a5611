// A report as one HTML file that opens without a network (docs/page.md).
#pragma once

#include <string>
#include <string_view>

namespace lorentz::report {

/// Whether this program has the page in it: its script is bundled when the program is built, which needs npm.
bool has_page();

/// The page that shows a report, which is one JSON object in UTF-8 and is embedded as it is, but for the
/// characters that HTML or scripts would take for their own: these are written as JSON escapes.
/// Throws FileError if this program has no page.
std::string page(std::string_view report_json);

}  // namespace lorentz::report
