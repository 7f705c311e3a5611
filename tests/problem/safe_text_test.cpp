// Text from elsewhere: valid UTF-8 that does nothing to a terminal, whatever its bytes are.
#include "src/problem/safe_text.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lorentz;

namespace {

// The bytes of a text that are UTF-8, by the table of the standard (Unicode 15, 3-7).
bool is_utf8(std::string_view text) {
  const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto in = [](unsigned byte, unsigned low, unsigned high) { return low <= byte && byte <= high; };
  while (!text.empty()) {
    const unsigned a = at(0), b = at(1);
    std::size_t bytes = 0;
    if (a < 0x80) bytes = 1;
    if (in(a, 0xc2, 0xdf) && in(b, 0x80, 0xbf)) bytes = 2;
    if (in(a, 0xe0, 0xef) && in(b, a == 0xe0 ? 0xa0 : 0x80, a == 0xed ? 0x9f : 0xbf) && in(at(2), 0x80, 0xbf))
      bytes = 3;
    if (in(a, 0xf0, 0xf4) && in(b, a == 0xf0 ? 0x90 : 0x80, a == 0xf4 ? 0x8f : 0xbf) &&
        in(at(2), 0x80, 0xbf) && in(at(3), 0x80, 0xbf))
      bytes = 4;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

}  // namespace

TEST_CASE("Characters that act on a terminal are escaped, others are not", "[problem][safe_text]") {
  CHECK(printable("plain, \"quoted\" and \\n") == "plain, \"quoted\" and \\n");
  CHECK(printable("M\u00fcnchen \u03c0 \u4e2d \U0001f600") == "M\u00fcnchen \u03c0 \u4e2d \U0001f600");
  CHECK(printable("\x1b[31mred\x07\x7f\r") == "\\x1b[31mred\\x07\\x7f\\x0d");
  CHECK(printable("C1: \u009b31m") == "C1: \\x9b31m");
  CHECK(printable("turned: \u202eabc\u2066") == "turned: \\u202eabc\\u2066");
  CHECK(printable(std::string("a\0b", 3)) == "a\\x00b");
  CHECK(printable("two\nlines\tand\x1b") == "two\\x0alines\\x09and\\x1b");
  CHECK(printable("two\nlines\tand\x1b", Lines::kept) == "two\nlines\tand\\x1b");
}

TEST_CASE("The first and the last characters that act, and those beside them", "[problem][safe_text]") {
  const auto utf8 = [](char32_t code) {
    if (code < 0x80) return std::string(1, static_cast<char>(code));
    const char last = static_cast<char>(0x80 | (code & 0x3f));
    if (code < 0x800) return std::string{static_cast<char>(0xc0 | code >> 6), last};
    return std::string{static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
                       last};
  };
  const auto acts = [&](char32_t code) { return printable(utf8(code)) != utf8(code); };
  constexpr std::pair<char32_t, char32_t> kThose[] = {{0, 0x1f},        {0x7f, 0x9f},     {0x61c, 0x61c},
                                                      {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x2069},
                                                      {0xfeff, 0xfeff}, {0xfffe, 0xffff}};
  for (const auto& [first, last] : kThose) {
    INFO(static_cast<unsigned long>(first));
    CHECK(acts(first));
    CHECK(acts(last));
    if (first > 0) CHECK_FALSE(acts(first - 1));
    if (last < 0xffff) CHECK_FALSE(acts(last + 1));
  }
}

TEST_CASE("Bytes that are not UTF-8 become the replacement character", "[problem][safe_text]") {
  CHECK(printable("\x9b"
                  "31m") ==
        "\ufffd"
        "31m");
  CHECK(printable("cut \xc3") == "cut \ufffd");
  CHECK(printable("cut \xe4\xb8") == "cut \ufffd");
  CHECK(printable("long \xc0\xaf form") == "long \ufffd\ufffd form");
  CHECK(printable("\xed\xa0\x80") == "\ufffd");  // half a surrogate
  CHECK(printable("\xf4\x90\x80\x80") == "\ufffd");
}

TEST_CASE("The first and last characters of each length are text, forms that are too long are not",
          "[problem][safe_text]") {
  for (const std::string text : {"\x7e", "\xc2\xa0", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                                 "\xee\x80\x80", "\xef\xbf\xbd", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    INFO(text);
    CHECK(is_utf8(text));
    CHECK(printable(text) == text);
  }
  for (const std::string text :
       {"\xc1\xbf", "\xe0\x9f\xbf", "\xed\xbf\xbf", "\xf0\x8f\xbf\xbf", "\xf5\x80\x80\x80"}) {
    CHECK_FALSE(is_utf8(text));
    CHECK(printable(text).starts_with("\ufffd"));
  }
}

TEST_CASE("A cut lies between two characters", "[problem][safe_text]") {
  const std::string text = "a\u00e9\u4e2d\U0001f600z";  // 1, 2, 3, 4, 1 bytes
  for (std::size_t most = 0; most < text.size(); ++most) {
    const std::string cut = shortened(text, most);
    INFO(most << ": " << cut);
    CHECK(is_utf8(cut));
    CHECK(cut.size() <= most + 3);
    CHECK(cut.ends_with("..."));
  }
  CHECK(shortened(text, 3) == "a\u00e9...");
  CHECK(shortened(text, 5) == "a\u00e9...");
  CHECK(shortened(text, 6) == "a\u00e9\u4e2d...");
  CHECK(shortened(text, text.size()) == text);
  CHECK(width_of(text) == 5);
}

TEST_CASE("Drawn bytes: what is printed is UTF-8 without control characters", "[problem][safe_text]") {
  std::mt19937 draw(17);
  std::size_t valid = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (unsigned n = draw() % 12; n > 0; --n) {
      const unsigned kind = draw() % 3;
      if (kind == 0) text += static_cast<char>(draw() % 128);
      if (kind == 1) text += static_cast<char>(draw() % 256);
      if (kind == 2) text += std::string("\u00e9\u4e2d\U0001f600").substr(draw() % 9, 1 + draw() % 4);
    }
    const std::string shown = printable(text), cut = shortened(shown, draw() % 12);
    valid += is_utf8(text);
    INFO(Catch::StringMaker<std::string>::convert(text) << " as " << shown);
    CHECK(is_utf8(shown));
    CHECK(is_utf8(cut));
    for (std::string_view rest = shown; !rest.empty(); rest.remove_prefix(first_character(rest).bytes))
      CHECK_FALSE(first_character(rest).acts);
    CHECK(printable(shown) == shown);
    bool good = true;
    for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(first_character(rest).bytes))
      good &= first_character(rest).is_text;
    CHECK(good == is_utf8(text));
  }
  CHECK(valid > 2000);
  CHECK(valid < 18'000);
}
