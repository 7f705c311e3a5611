#include "src/exchange/npy_literal.hpp"

#include <algorithm>
#include <charconv>

#include <lorentz/errors.hpp>

namespace lorentz {

const PythonValue* PythonValue::at(std::string_view key) const {
  const auto place = std::find(keys.begin(), keys.end(), key);
  return place == keys.end() ? nullptr : &items[static_cast<std::size_t>(place - keys.begin())];
}

namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  PythonValue whole() {
    PythonValue value = read(0);
    if (next_char() != '\0' || place_ < text_.size()) fail();
    return value;
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError("the header is not a literal of Python, from byte " + std::to_string(place_) + " on");
  }

  char next_char() {
    while (place_ < text_.size() && (text_[place_] == ' ' || text_[place_] == '\n')) ++place_;
    return place_ < text_.size() ? text_[place_] : '\0';
  }

  bool take(char c) {
    if (next_char() != c || place_ >= text_.size()) return false;
    ++place_;
    return true;
  }

  bool take_word(std::string_view word) {
    if (!text_.substr(place_).starts_with(word)) return false;
    place_ += word.size();
    return true;
  }

  PythonValue read(int depth) {
    constexpr int kDeepest = 32;
    if (depth > kDeepest) fail();
    PythonValue value;
    switch (next_char()) {
      case '{':
        read_items(value, PythonValue::Kind::dictionary, '}', depth);
        break;
      case '(':
        read_items(value, PythonValue::Kind::tuple, ')', depth);
        break;
      case '[':
        read_items(value, PythonValue::Kind::list, ']', depth);
        break;
      default:
        read_word(value);
    }
    return value;
  }

  void read_word(PythonValue& value) {
    const std::string_view rest = text_.substr(place_);
    const bool prefixed = rest.size() > 1 && (rest[0] == 'u' || rest[0] == 'b') && is_quote(rest[1]);
    if (prefixed) ++place_;
    if (prefixed || (!rest.empty() && is_quote(rest[0])))
      read_string(value);
    else if (take_word("True"))
      value.kind = PythonValue::Kind::boolean, value.number = 1;
    else if (take_word("False"))
      value.kind = PythonValue::Kind::boolean;
    else if (!take_word("None"))
      read_integer(value);
  }

  static bool is_quote(char c) { return c == '\'' || c == '"'; }

  // An escaped character stands for itself; names that matter have none.
  void read_string(PythonValue& value) {
    value.kind = PythonValue::Kind::string;
    const char quote = text_[place_++];
    for (; place_ < text_.size() && text_[place_] != quote; ++place_) {
      if (text_[place_] == '\\' && ++place_ == text_.size()) break;
      value.text += text_[place_];
    }
    if (place_ >= text_.size()) fail();
    ++place_;
  }

  void read_integer(PythonValue& value) {
    value.kind = PythonValue::Kind::integer;
    const char* const begin = text_.data() + place_;
    const auto [end, status] = std::from_chars(begin, text_.data() + text_.size(), value.number);
    if (status != std::errc{}) fail();
    place_ += static_cast<std::size_t>(end - begin);
    take_word("L");  // Python 2 wrote it after some
  }

  // Parentheses make a tuple only with a comma.
  void read_items(PythonValue& value, PythonValue::Kind kind, char end, int depth) {
    value.kind = kind;
    ++place_;  // the opening one
    bool comma = true;
    while (!take(end)) {
      if (!comma) fail();
      if (kind == PythonValue::Kind::dictionary) {
        const PythonValue key = read(depth + 1);
        if (!key.is(PythonValue::Kind::string) || !take(':')) fail();
        value.keys.push_back(key.text);
      }
      value.items.push_back(read(depth + 1));
      comma = take(',');
    }
    if (kind == PythonValue::Kind::tuple && value.items.size() == 1 && !comma) {
      PythonValue only = std::move(value.items.front());
      value = std::move(only);
    }
  }

  std::string_view text_;
  std::size_t place_ = 0;
};

}  // namespace

PythonValue read_python_literal(std::string_view text) {
  return Parser(text).whole();
}

}  // namespace lorentz
