#include "src/problem/safe_text.hpp"

#include <algorithm>

namespace lorentz {
namespace {

constexpr char32_t kNoText = 0xfffd;

unsigned byte(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

bool follows(unsigned byte) {
  return (byte & 0xc0) == 0x80;
}

}  // namespace

bool acts(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0x061c ||
         code == 0xfeff || code == 0xfffe || code == 0xffff;
}

Character first_character(std::string_view text) {
  const unsigned first = byte(text, 0);
  if (first < 0x80) return {first, 1, acts(first)};
  const std::size_t bytes = first < 0xc2 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 1;
  char32_t code = first & (0xff >> (bytes + 1));
  std::size_t good = 1;
  for (; good < bytes && follows(byte(text, good)); ++good) code = code << 6 | (byte(text, good) & 0x3f);
  const bool is_short = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool is_text =
      bytes > 1 && good == bytes && !is_short && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
  if (!is_text) return {kNoText, good, false, false};
  return {code, bytes, acts(code)};
}

void append_escape(std::string& out, char32_t code, int digits) {
  out += digits == 2 ? "\\x" : "\\u";
  for (int shift = 4 * digits; (shift -= 4) >= 0;) out += "0123456789abcdef"[code >> shift & 15];
}

std::string printable(std::string_view text, Lines lines) {
  std::string out;
  while (!text.empty()) {
    const Character c = first_character(text);
    const bool is_kept = lines == Lines::kept && (c.code == '\n' || c.code == '\t');
    if (!c.is_text) {
      out += "\ufffd";
    } else if (!c.acts || is_kept) {
      out += text.substr(0, c.bytes);
    } else {
      append_escape(out, c.code, c.code < 0x100 ? 2 : 4);
    }
    text.remove_prefix(c.bytes);
  }
  return out;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = 0;
  for (std::size_t next = 0; next <= most; next += first_character(text.substr(next)).bytes) end = next;
  return std::string(text.substr(0, end)) + "...";
}

std::size_t width_of(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
           return follows(static_cast<unsigned char>(c));
         }));
}

}  // namespace lorentz
