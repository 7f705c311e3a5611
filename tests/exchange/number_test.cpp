// Every reader of numbers against MPFR, which rounds exactly: the text's value in 53 bits, subnormals
// included.
#include "src/exchange/exchange_number.hpp"

#include <mpfr.h>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <lorentz/exchange.hpp>
#include "tests/support/command_line.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using test::Draw;
using test::Folder;
using test::Run;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();

/// An exact number: big enough for a double's, and for midpoints and their decimal digits.
class Exact {
 public:
  Exact() { mpfr_init2(value_, 2200); }
  explicit Exact(double value) : Exact() { mpfr_set_d(value_, value, MPFR_RNDN); }
  ~Exact() { mpfr_clear(value_); }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;

  void to_midpoint_above(double lower) {
    mpfr_set_d(value_, lower, MPFR_RNDN);
    if (lower == kLargest)
      mpfr_set_ui_2exp(value_, (1ul << 54) - 1, 970, MPFR_RNDN);
    else
      mpfr_add_d(value_, value_, std::nextafter(lower, kInfinity), MPFR_RNDN),
          mpfr_div_2ui(value_, value_, 1, MPFR_RNDN);
  }
  /// In decimal, exactly: D.DDDe+X with that many digits (a dyadic number of these sizes has less than 800).
  std::string decimal(int digits) const {
    char text[1200];
    mpfr_snprintf(text, sizeof text, "%.*Re", digits - 1, value_);
    return text;
  }

 private:
  mpfr_t value_;
};

/// The nearest binary64, by MPFR; infinite beyond the range.
double reference(const std::string& text, int base) {
  const mpfr_exp_t least = mpfr_get_emin(), most = mpfr_get_emax();
  mpfr_set_emin(-1073);
  mpfr_set_emax(1024);
  mpfr_t value;
  mpfr_init2(value, 53);
  char* end;
  const int inexact = mpfr_strtofr(value, text.c_str(), &end, base, MPFR_RNDN);
  mpfr_subnormalize(value, inexact, MPFR_RNDN);
  const double result = mpfr_get_d(value, MPFR_RNDN);
  mpfr_clear(value);
  mpfr_set_emin(least);
  mpfr_set_emax(most);
  REQUIRE(*end == '\0');
  return result;
}

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string query_with(const std::string& x, const std::string& v) {
  return "{\"x\":[" + x + ",0],\"v\":[1," + v + "]}";
}

/// As the first component of a query's x, and as the second of its v, before other signs.
double in_query(const std::string& number) {
  const Scene scene = unit_scene(2, 0.1);
  const std::string text = query_with(number, number);
  const std::string padded = text + std::string(LineReader::kPadding, ' ');
  ExchangeReader reader;
  StreamItem item;
  reader.read_query_line({{padded.data(), text.size()}, 1, false}, &scene, item);
  if (item.kind == StreamItem::Kind::bad && item.message.ends_with("beyond the range of binary64"))
    return number.starts_with('-') || number.starts_with("\"-") ? -kInfinity : kInfinity;
  INFO(item.message);
  REQUIRE(item.kind == StreamItem::Kind::query);
  REQUIRE(same(item.query.x[0], item.query.v[1]));
  return item.query.x[0];
}

/// As a position in a scene of TOML; the text is read as often as it holds numbers, so once for many.
std::vector<double> in_toml(const std::vector<std::string>& numbers) {
  std::string text = "dimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, 1]]\n";
  for (const std::string& number : numbers)
    text += "[[lattices.atoms]]\nradius = 1\nposition = [" + number + ", 0]\n";
  const std::string path = test::temporary_file();
  std::ofstream(path) << text;
  const Scene scene = read_scene_file(path);
  std::remove(path.c_str());
  std::vector<double> values;
  for (const Atom& atom : scene.lattices[0].atoms) values.push_back(atom.position[0]);
  return values;
}

/// Numbers to be read, and what is known of them so far.
class Numbers {
 public:
  void add(const std::string& text) {
    INFO(text);
    const double right = reference(text, 10);
    const std::optional<double> value = nearest_decimal(text);
    REQUIRE(value);
    REQUIRE(same(*value, right));
    REQUIRE(is_json_number(text));
    REQUIRE(same(in_query(text), right));
    ++count_;
    (std::isinf(right) ? infinite_ : std::fabs(right) < 0x1p-1022 ? subnormal_ : normal_) += 1;
    // toml++ refuses longer numbers and integers beyond 2^63, with std::from_chars also what is rounded to 0.
    const bool is_real = text.find_first_of(".eE") != text.npos;
    if (std::isinf(right) || right == 0 || text.size() > 120 || (!is_real && std::fabs(right) >= 0x1p63))
      return;
    texts_.push_back(text);
    values_.push_back(right);
    if (texts_.size() == 1000) read_as_toml();
  }
  /// A number, two that are above it by less and less, and those with the last digit one up and one down.
  void add_beside(const std::string& text) {
    const auto end = std::min(text.find('e'), text.size());
    add(text);
    add(text.substr(0, end) + '1' + text.substr(end));
    add(text.substr(0, end) + std::string(30, '0') + '1' + text.substr(end));
    for (const auto& [from, to] : {std::pair{"0123456789", "1234567899"}, {"9876543210", "8765432100"}}) {
      std::string beside = text;
      beside[end - 1] = to[std::string_view(from).find(beside[end - 1])];
      add(beside);
    }
  }
  void read_as_toml() {
    if (texts_.empty()) return;
    const std::vector<double> read = in_toml(texts_);
    REQUIRE(read.size() == values_.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      INFO(texts_[i]);
      REQUIRE(same(read[i], values_[i]));
    }
    texts_.clear();
    values_.clear();
  }
  std::string report() const {
    return std::to_string(count_) + " numbers: " + std::to_string(normal_) + " normal, " +
           std::to_string(subnormal_) + " subnormal or zero, " + std::to_string(infinite_) +
           " beyond the range";
  }
  int count() const { return count_; }
  int normal() const { return normal_; }
  int subnormal() const { return subnormal_; }
  int infinite() const { return infinite_; }

 private:
  int count_ = 0, normal_ = 0, subnormal_ = 0, infinite_ = 0;
  std::vector<std::string> texts_;  // not yet read as TOML
  std::vector<double> values_;
};

double drawn_double(Draw& draw) {
  switch (draw.below(4)) {
    case 0:
      return static_cast<double>(draw.below(1ull << 53)) * 0x1p-53;
    case 1:
      return std::bit_cast<double>(draw.below(1ull << 53));  // half of them subnormal, the others next to it
    case 2:
      return std::ldexp(static_cast<double>(draw.below(1ull << 53)), static_cast<int>(draw.below(120)) - 90);
    default:
      return draw.finite();
  }
}

std::string printed(const char* format, double value) {
  char text[1600];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string drawn_digits(Draw& draw, std::size_t count) {
  std::string digits;
  const bool one_kind = draw.one_in(4);
  const char kind = "0129"[draw.below(4)];
  for (std::size_t i = 0; i < count; ++i)
    digits += one_kind && !draw.one_in(50) ? kind : static_cast<char>('0' + draw.below(10));
  return digits;
}

/// Digits, a point anywhere, an exponent that makes up for it more or less.
std::string drawn_text(Draw& draw) {
  const std::size_t count = draw.one_in(3) ? 1 + draw.below(800) : 1 + draw.below(45);
  std::string digits = drawn_digits(draw, count);
  std::string text = draw.one_in(2) ? "-" : "";
  const std::size_t zeros = draw.one_in(3) ? draw.below(400) : draw.below(4);
  long exponent = 0;
  switch (draw.below(3)) {
    case 0:  // 0.000ddd
      text += "0." + std::string(zeros, '0') + digits;
      exponent = static_cast<long>(zeros);
      break;
    case 1:  // d.ddd000
      text += digits.substr(0, 1) + "." + digits + std::string(zeros, '0');
      break;
    default:  // ddd000
      text += std::to_string(1 + draw.below(9)) + digits + std::string(zeros, '0');
      exponent = -static_cast<long>(digits.size() + zeros);
  }
  if (draw.one_in(4)) return text;
  exponent +=
      draw.one_in(2) ? static_cast<long>(draw.below(700)) - 370 : static_cast<long>(draw.below(9)) - 4;
  const std::string sign = exponent < 0 ? "-" : draw.one_in(2) ? "+" : "";
  return text + (draw.one_in(2) ? "e" : "E") + sign + (draw.one_in(9) ? "000" : "") +
         std::to_string(std::labs(exponent));
}

}  // namespace

TEST_CASE("Numbers: midpoints between neighbours, and what is beside them", "[exchange][number]") {
  Draw draw(71);
  INFO("seed 71");
  Numbers numbers;
  Exact midpoint;
  std::vector<double> lower = {0,        0x1p-1074,   0x1p-1073, 0x1p-1022, 0x1p-1022 - 0x1p-1074,
                               1,        1 - 0x1p-53, 0.1,       0x1p53,    0x1p53 - 1,
                               kLargest, 0x1p1023};
  for (int i = 0; i < 400; ++i) lower.push_back(std::fabs(drawn_double(draw)));
  for (const double value : lower) {
    midpoint.to_midpoint_above(value);
    for (const int digits : {17, 18, 19, 20, 21, 25, 40, 200, 500, 769, 800})
      numbers.add_beside(midpoint.decimal(digits));
    if (value < kLargest) numbers.add_beside(Exact(value).decimal(780));
  }
  numbers.read_as_toml();
  INFO(numbers.report());
  CHECK(numbers.count() > 20000);     // 24 715 seen
  CHECK(numbers.subnormal() > 2000);  // 2 657 seen
  CHECK(numbers.infinite() >= 30);    // 38 seen
}

TEST_CASE("Numbers: as printf writes them", "[exchange][number]") {
  Draw draw(72);
  INFO("seed 72");
  Numbers numbers;
  for (int i = 0; i < 8000; ++i) {
    const double value = drawn_double(draw);
    for (const char* format : {"%.17g", "%.20f", "%.40e", "%.60f", "%.19f", "%.21f", "%.25g"})
      numbers.add(printed(format, value));
    REQUIRE(same(in_query('"' + printed("%a", value) + '"'), value));
  }
  numbers.read_as_toml();
  INFO(numbers.report());
  CHECK(numbers.count() == 56000);
}

TEST_CASE("Numbers: 1 to 800 digits, with points and exponents that make up for each other",
          "[exchange][number]") {
  Draw draw(73);
  INFO("seed 73");
  Numbers numbers;
  for (int i = 0; i < 50000; ++i) {
    std::string text = drawn_text(draw);
    if (is_json_number(text)) numbers.add(text);
  }
  numbers.read_as_toml();
  INFO(numbers.report());
  CHECK(numbers.normal() > 30000);    // 45 197 seen
  CHECK(numbers.subnormal() > 2400);  // 3 030 seen
  CHECK(numbers.infinite() > 1000);   // 1 773 seen
}

TEST_CASE("Numbers: exponents of any size that the digits make up for", "[exchange][number]") {
  const auto zeros = [](std::size_t count) { return std::string(count, '0'); };
  for (const std::size_t n : {300u, 330u, 400u, 5000u, 20000u, 70000u, 200000u, 1000000u}) {
    const std::string size = std::to_string(n), size4 = std::to_string(4 * n);
    INFO(n << " zeros");
    CHECK(in_query("0." + zeros(n) + "15e" + size) == 0.15);
    CHECK(in_query("-15" + zeros(n) + "e-" + size) == -15);
    CHECK(nearest_hexadecimal("0x0." + zeros(n) + "18p" + size4) == 0x0.18p0);
    CHECK(nearest_hexadecimal("-0x18" + zeros(n) + "p-" + size4) == -0x18p0);
    CHECK(in_query("0." + zeros(n) + "1") == (n == 300 ? 1e-301 : 0));
    CHECK(in_query("1" + zeros(n)) == (n == 300 ? 1e300 : kInfinity));
    CHECK(in_query("0." + zeros(n)) == 0);
  }
  for (const std::string power : {"65535", "65536", "2147483648", "9223372036854775808",
                                  "18446744073709551616", "99999999999999999999999999"}) {
    INFO(power);
    CHECK(in_query("1e" + power) == kInfinity);
    CHECK(in_query("-1e+" + power) == -kInfinity);
    CHECK(same(in_query("-1.5e-" + power), -0.0));
    CHECK(in_query("0e" + power) == 0);
    CHECK(in_query("0.000e" + power) == 0);
    CHECK(nearest_hexadecimal("0x1p" + power) == kInfinity);
    CHECK(nearest_hexadecimal("0x1p-" + power) == 0);
    CHECK(nearest_hexadecimal("0x0p" + power) == 0);
  }
  CHECK(in_query("1e000000000000000000000000000001") == 10);
}

TEST_CASE("Numbers: hexadecimal, of up to 400 digits", "[exchange][number]") {
  Draw draw(74);
  INFO("seed 74");
  int subnormal = 0, infinite = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::size_t count = 1 + draw.below(draw.one_in(8) ? 400 : 20);
    std::string digits;
    for (std::size_t k = 0; k < count; ++k) digits += "0008fF1234567aBc"[draw.below(16)];
    const std::size_t point = draw.below(count + 1);
    const long middle = draw.one_in(2) ? -1074 : draw.one_in(2) ? 1022 : 0;
    const long exponent = middle - 4 * static_cast<long>(point) + static_cast<long>(draw.below(70)) - 35;
    const std::string text = std::string(draw.one_in(2) ? "-0x" : "0X") + digits.substr(0, point) +
                             (point < count || draw.one_in(2) ? "." : "") + digits.substr(point) + "p" +
                             std::to_string(exponent);
    INFO(text);
    const double right = reference(text, 16);
    const auto value = nearest_hexadecimal(text);
    REQUIRE(value);
    REQUIRE(same(*value, right));
    if (i % 8 == 0) REQUIRE(same(in_query('"' + text + '"'), right));
    subnormal += right != 0 && std::fabs(right) < 0x1p-1022;
    infinite += std::isinf(right);
  }
  CHECK(subnormal > 18'000);  // 23 548 seen
  CHECK(infinite > 8400);     // 10 546 seen
}

TEST_CASE("Numbers: texts that are not numbers", "[exchange][number]") {
  for (const char* text : {"", "-", "+", ".", "e1", "1e", "1e+", "inf", "nan", "-inf", "0x1", "1x", "--1",
                           "+-1", "1..2", "1.2.3", " 1", "1 ", "1_0"}) {
    INFO(text);
    CHECK_FALSE(nearest_decimal(text));
    CHECK_FALSE(is_json_number(text));
  }
  for (const char* text : {"01", "1.", ".5", "+1", "-01.5"}) CHECK_FALSE(is_json_number(text));
  for (const char* text : {"", "0x", "0x.", "0xp1", "0x1p", "0x1p+", "0x1p1.0", "0x1.8.0", "x1", "1.8",
                           "0x-1", "--0x1", "0x1g", "0xinf", "0xnan", "0x1p 1", "0x0x1"}) {
    INFO(text);
    CHECK_FALSE(nearest_hexadecimal(text));
  }
  CHECK(nearest_hexadecimal("0x1") == 1);
  CHECK(nearest_hexadecimal("0x1.8") == 1.5);
  CHECK(nearest_hexadecimal("0x.8") == 0.5);
  CHECK(nearest_hexadecimal("0x1.") == 1);
  CHECK(nearest_hexadecimal("+0x1p+1") == 2);
  CHECK(nearest_hexadecimal("-0X1P-1") == -0.5);
}

TEST_CASE("Numbers of TOML: underscores, other bases, and what is refused", "[exchange][number]") {
  CHECK(in_toml({"9007199254740993", "+1_000.5", "0x10", "0b11", "1E+01", "-0.0"}) ==
        std::vector<double>{0x1p53, 1000.5, 16, 3, 10, 0});
  for (const std::string text : {"1_", "-1e400", "9223372036854775808"}) {
    INFO(text);
    CHECK_THROWS_WITH(in_toml({"1", text}), Catch::Contains("line 9: not TOML"));
  }
  CHECK_THROWS_AS(in_toml({"1." + std::string(400, '0')}), InputError);
}

TEST_CASE("Numbers of 20 digits, in queries and in answers that were logged with them",
          "[exchange][number]") {
  const Folder folder;
  const std::string scene =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.05}]}]}})"
      "\n";
  const std::string query = R"({"id":0,"x":[0.20000000000000001110,0],"v":[1,0]})"
                            "\n";
  const Run hit = folder.lorentz("first-hit " + folder.write("q", scene + query));
  CHECK(hit.out == R"({"id":0,"outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.75})"
                   "\n");
  std::string queries, answers;
  Draw draw(75);
  for (int i = 0; i < 200; ++i) {
    append_query_line(queries, std::to_string(i), {{0.5, 0.5}, {draw.uniform(), draw.uniform()}, {}}, 2);
  }
  const std::string path = folder.write("queries", scene + queries);
  std::istringstream lines(folder.lorentz("first-hit " + path).out);
  for (std::string line; std::getline(lines, line);) {
    const auto time = line.find("\"time\":") + 7;
    answers += line.substr(0, time) + printed("%.20f", std::stod(line.substr(time))) + "}\n";
  }
  const Run run =
      folder.lorentz("compare --queries " + path + " --answers logged=" + folder.write("a", answers));
  INFO("seed 75\n" << run.out << run.err);
  CHECK(run.status == 0);
}
