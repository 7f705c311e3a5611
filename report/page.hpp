// A report as one HTML file that opens without a network (docs/page.md).
#pragma once

#include <string>
#include <string_view>

namespace lorentz::report {

/// The page without its report, made by report/web/build.mjs. Empty in a program that was built without npm.
extern const std::string_view page_text;

/// True if this program contains the page. Its script is bundled when the program is built, which needs npm.
bool has_page();

/// The page that shows a report. The report is one JSON object in UTF-8. It is embedded unchanged, except
/// that characters with a meaning in HTML or scripts are written as JSON escapes. Throws FileError if this
/// program has no page.
std::string page(std::string_view report_json);

}  // namespace lorentz::report
