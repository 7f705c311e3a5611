#include "report/page.hpp"

#include "report/page_text.hpp"

#include <lorentz/errors.hpp>

namespace lorentz::report {
namespace {

constexpr std::string_view kPlace = "%REPORT%";
constexpr std::string_view kLineSeparator = "\u2028", kParagraphSeparator = "\u2029";

// JSON has these characters only inside strings, so the escape stands for the same text.
std::string embedded(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 16);
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string_view rest = json.substr(i, kLineSeparator.size());
    if (json[i] == '<') {
      out += "\\u003c";
    } else if (rest == kLineSeparator || rest == kParagraphSeparator) {
      out += rest == kLineSeparator ? "\\u2028" : "\\u2029";
      i += rest.size() - 1;
    } else {
      out += json[i];
    }
  }
  return out;
}

}  // namespace

bool has_page() {
  return !page_text.empty();
}

std::string page(std::string_view report_json) {
  if (!has_page())
    throw FileError(
        "this program was built without the page of reports; install node and npm, run ./run build, and ask "
        "again (--json writes the same report as text)");
  const std::size_t place = page_text.find(kPlace);
  std::string out(page_text.substr(0, place));
  out += embedded(report_json);
  out += page_text.substr(place + kPlace.size());
  return out;
}

}  // namespace lorentz::report
