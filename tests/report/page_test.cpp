// A report in a page: what is embedded comes back, and stays data.
#include "report/page.hpp"

#include <catch2/catch.hpp>

#include <lorentz/errors.hpp>

using namespace lorentz;

namespace {

// What the page's script reads: between the tags, as an HTML parser takes it.
std::string embedded_in(const std::string& page) {
  const std::string begin = "<script id=\"report\" type=\"application/json\">";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

// What a JSON reader makes of the escapes that were put in; characters that act are texts of escapes.
std::string read_back(std::string text) {
  const std::pair<std::string, std::string> escapes[] = {
      {"\\u003c", "<"}, {"\\\\u2028", "\u2028"}, {"\\\\u2029", "\u2029"}, {"\\\\u202e", "\\u202e"}};
  for (const auto& [escape, character] : escapes)
    for (std::size_t at = text.find(escape); at != std::string::npos; at = text.find(escape, at))
      text.replace(at, escape.size(), character);
  return text;
}

}  // namespace

TEST_CASE("A report in a page stays text, and what acts in it is shown as its escape", "[report][page]") {
  // With what ends a script, opens a comment in one, breaks lines in one, is a place in the template, or
  // begins as a line separator does without being one (the Euro sign).
  const std::string json =
      "{\"kind\":\"judge\",\"findings\":[{\"cause\":\"</script><script>alert(1)</script><!--\",\"where\":"
      "\"\u2028\u2029 5 \u20ac \\u202e \\u20ac \\n \\\\u20ac %REPORT% %SCRIPT% $& \\\" "
      "\\\\\"}],\"line\":\"\xe2\x80\"}";
  if (!report::has_page()) {
    CHECK_THROWS_AS(report::page(json), FileError);
    return;
  }
  const std::string page = report::page(json);
  const std::string embedded = embedded_in(page);
  CHECK(read_back(embedded) == json);
  CHECK(embedded.find('<') == std::string::npos);
  CHECK(embedded.find("\u2028") == std::string::npos);
  CHECK(embedded.find("\u2029") == std::string::npos);
  CHECK(page.find("default-src 'none'") < page.find(embedded));  // the policy holds before any of it is read
  CHECK(page.ends_with("</html>\n"));
}
