#include <lorentz/obstacle.hpp>

#include <charconv>

namespace lorentz {

std::optional<Integer> Integer::from_decimal(std::string_view text) {
  Integer result;
  const char* const ends = text.data() + text.size();
  if (const auto [end, status] = std::from_chars(text.data(), ends, result.value_);
      status == std::errc{} && end == ends)
    return result;
  const bool negative = !text.empty() && text.front() == '-';
  std::string_view digits = text.substr(negative ? 1 : 0);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  digits.remove_prefix(digits.find_first_not_of('0'));  // 64 bits do not hold it, so one digit is not 0
  result.value_ = 0;
  result.digits_ = std::make_unique<const std::string>((negative ? "-" : "") + std::string(digits));
  return result;
}

std::optional<WideInteger> Integer::int128_of_digits() const {
  constexpr std::size_t kDigits = 38;  // 10^38 < 2^127
  const bool negative = digits_->front() == '-';
  const std::string_view digits = std::string_view(*digits_).substr(negative ? 1 : 0);
  if (digits.size() > kDigits) return std::nullopt;
  WideInteger n = 0;
  for (const char c : digits) n = 10 * n + (c - '0');
  return negative ? -n : n;
}

Integer Integer::of_wide(WideInteger value) {
  std::string digits;
  for (WideInteger rest = value; rest != 0; rest /= 10)
    digits.insert(digits.begin(),
                  static_cast<char>('0' + static_cast<int>(rest < 0 ? -(rest % 10) : rest % 10)));
  return *from_decimal(value < 0 ? '-' + digits : digits);
}

std::string Integer::decimal() const {
  return fits_int64() ? std::to_string(value_) : *digits_;
}

}  // namespace lorentz
