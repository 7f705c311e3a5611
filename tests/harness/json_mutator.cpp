// How the harnesses of JSON texts change their inputs: half of the time by whole numbers, members and lines,
// so that the text usually stays JSON. Where every bit counts, random changes of bytes give nothing but
// syntax errors.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "tests/harness/input_file.hpp"

namespace lorentz::harness {
namespace {

struct Span {
  std::size_t begin, end;
};

/// The places of numbers (also within strings), and of what is between commas: members, elements, lines.
struct NumberParts {
  std::vector<Span> numbers, items;

  explicit NumberParts(std::string_view text);

 private:
  void add_item(std::size_t begin, std::size_t end) {
    if (begin < end) items.push_back({begin, end});
  }
};

bool is_part_of_number(char c) {
  return std::string_view("+-.0123456789abcdefpx").find(c) != std::string_view::npos;
}

NumberParts::NumberParts(std::string_view text) {
  std::vector<std::size_t> open{0};  // where the items begin that have not ended yet
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && (i == 0 || text[i - 1] != '\\')) in_string = !in_string;
    const bool digit = c == '-' || (c >= '0' && c <= '9');
    if (digit && (i == 0 || std::string_view("[:, \"").find(text[i - 1]) != std::string_view::npos)) {
      std::size_t end = i;
      while (end < text.size() && is_part_of_number(text[end])) ++end;
      numbers.push_back({i, end});
    }
    if (in_string && c != '\n') continue;
    if (c == '{' || c == '[') open.push_back(i + 1);
    if (c == ',' || c == '\n' || c == '}' || c == ']') {
      add_item(open.back(), i);
      if (c == '\n') in_string = false, open.resize(1);
      if ((c == '}' || c == ']') && open.size() > 1)
        open.pop_back();
      else
        open.back() = i + 1;
    }
  }
  add_item(open.front(), text.size());
}

/// Makes one change. A number is moved a little, gets another sign or size, or is replaced by another number
/// of the text; a member, an element or a line is left out, doubled, or put in place of another.
class Editor {
 public:
  Editor(std::string_view text, std::minstd_rand& random) : text_(text), parts_(text), random_(random) {}

  std::string edited() {
    const bool of_number = !parts_.numbers.empty() && below(3) > 0;
    if (of_number) return edit_number();
    return parts_.items.empty() ? std::string(text_) : edit_item();
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  Span any(const std::vector<Span>& spans) { return spans[below(spans.size())]; }
  std::string_view at(Span span) const { return text_.substr(span.begin, span.end - span.begin); }
  std::string replaced(Span span, std::string_view by) const {
    return std::string(text_.substr(0, span.begin)).append(by).append(text_.substr(span.end));
  }

  std::string edit_number() {
    const Span span = any(parts_.numbers);
    const std::string_view number = at(span);
    if (below(6) == 0) return replaced(span, at(any(parts_.numbers)));
    if (below(8) == 0)
      return replaced(span,
                      number.starts_with('-') ? std::string(number.substr(1)) : '-' + std::string(number));
    if (number.find_first_not_of("-0123456789") != std::string_view::npos) {
      double value = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      if (error == std::errc() && end == number.data() + number.size()) return replaced(span, near(value));
    }
    return replaced(span, other_digit(number));
  }

  // Moves a number by ulps, or a little more, or changes its size.
  std::string near(double value) {
    const std::size_t kind = below(4);
    if (kind == 0) value = std::ldexp(value, static_cast<int>(below(7)) - 3);
    if (kind == 1) value += std::ldexp(value, -static_cast<int>(below(52)));
    if (kind > 1)
      for (std::size_t ulps = 1 + below(4); ulps > 0; --ulps)
        value = std::nextafter(value, kind == 2 ? INFINITY : -INFINITY);
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, std::isfinite(value) ? value : 1.0).ptr};
  }

  // Changes a digit of an integer or a hexadecimal number: at least half of the time the last one, where a
  // proof is tight.
  std::string other_digit(std::string_view number) {
    std::string other(number);
    std::size_t place = other.size() - 1 - (below(2) == 0 ? below(other.size()) : 0);
    if (other[place] < '0' || other[place] > '9') place = other.size() - 1;
    if (below(8) == 0)
      other.insert(place, 1, static_cast<char>('0' + below(10)));
    else
      other[place] = static_cast<char>('0' + (other[place] + (below(2) == 0 ? 1 : 9) + 2) % 10);
    return other;
  }

  std::string edit_item() {
    const Span span = any(parts_.items);
    const std::string_view item = at(span);
    const char separator = span.begin == 0 || text_[span.begin - 1] == '\n' ? '\n' : ',';
    switch (below(4)) {
      case 0: {  // without its comma
        Span whole = span;
        if (whole.end < text_.size() && text_[whole.end] == separator)
          ++whole.end;
        else if (whole.begin > 0 && text_[whole.begin - 1] == separator)
          --whole.begin;
        return replaced(whole, "");
      }
      case 1:
        return replaced(span, std::string(item) + separator + std::string(item));
      case 2:
        return replaced(span, std::string(item) + separator + std::string(at(any(parts_.items))));
      default:
        return replaced(span, at(any_like(item)));
    }
  }

  // An item with the same key, if three tries find one.
  Span any_like(std::string_view item) {
    Span span = any(parts_.items);
    const std::string_view key = item.substr(0, item.find(':'));
    for (int i = 0; i < 3 && !at(span).starts_with(key); ++i) span = any(parts_.items);
    return span;
  }

  const std::string_view text_;
  const NumberParts parts_;
  std::minstd_rand& random_;
};

}  // namespace
}  // namespace lorentz::harness

/// libFuzzer's own, or replay_main.cpp's.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  using namespace lorentz::harness;
  std::minstd_rand random(seed);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string text(text_of(data, size));
  for (auto edits = 1 + random() % 3; edits > 0; --edits) text = Editor(text, random).edited();
  const std::size_t count = std::min(text.size(), most);
  std::memcpy(data, text.data(), count);
  return count;
}
