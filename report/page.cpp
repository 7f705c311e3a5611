#include "report/page.hpp"

#include <algorithm>
#include <charconv>

#include <lorentz/errors.hpp>
#include "src/problem/safe_text.hpp"

namespace lorentz::report {
namespace {

constexpr std::string_view kPlace = "%REPORT%";
// The escape \uXXXX at the beginning of a text, if it stands for a character that acts.
bool is_acting_escape(std::string_view text) {
  unsigned code = 0;
  if (!text.starts_with("\\u") || text.size() < 6) return false;
  std::from_chars(text.data() + 2, text.data() + 6, code, 16);
  return acts(code) && code != '\n' && code != '\t';
}

// The JSON in a form that ends no element. A character that acts becomes the text of its escape, so that none
// turns the page's texts round.
std::string embedded(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 16);
  while (!json.empty()) {
    const Character c = first_character(json);
    const std::size_t bytes = json[0] == '\\' ? std::min<std::size_t>(2, json.size()) : c.bytes;
    if (json[0] == '<')
      out += "\\u003c";
    else if (c.acts && c.code >= 0x80)
      out += '\\' + printable(json.substr(0, bytes));
    else
      out += (is_acting_escape(json) ? "\\" : "") + std::string(json.substr(0, bytes));
    json.remove_prefix(bytes);
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
        "this program was built without the page of reports; ./run build builds it with the page, and ./run "
        "wheel then has it, too (--json writes the same report as text)");
  const std::size_t place = page_text.find(kPlace);
  std::string out(page_text.substr(0, place));
  out += embedded(report_json);
  out += page_text.substr(place + kPlace.size());
  return out;
}

}  // namespace lorentz::report
