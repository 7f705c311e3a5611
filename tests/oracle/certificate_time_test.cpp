// The check of certificates: times and their digits.
#include "oracle/certificate/check/certificate_time.hpp"
#include "tests/oracle/certificate_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::test::proofs;

TEST_CASE("The sign of a + sqrt(c) - sqrt(b), also where it is 0", "[oracle][certificate_time]") {
  int zeros = 0;
  for (int a = -8; a <= 8; ++a)
    for (int b = 0; b <= 40; ++b)
      for (int c = 0; c <= 40; ++c) {
        const long double value =
            a + std::sqrt(static_cast<long double>(c)) - std::sqrt(static_cast<long double>(b));
        const int expected = std::fabs(value) < 1e-12L ? 0 : value < 0 ? -1 : 1;  // none is that small but 0
        INFO(a << " " << b << " " << c);
        REQUIRE(oracle::certificate::sign_of(a, c, b) == expected);
        zeros += expected == 0;
      }
  CHECK(zeros > 50);  // 83 seen
}

TEST_CASE("A time one ulp off is refused, and so are other numbers", "[oracle][certificate_time]") {
  Draw draw(2108);
  INFO("seed 2108");
  const auto hold = [](Case c) {
    require_accepted(c);
    const double time = *c.answer.time;
    for (const double other : {std::nextafter(time, kInfinity), std::nextafter(time, -kInfinity), -time,
                               time + 1, time * 2, std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
      if (other == time && std::signbit(other) == std::signbit(time)) continue;
      c.answer.time = other;
      require_refused(c, "is not entered at the time given");
    }
    c.answer.time.reset();
    require_refused(c, "is not entered at the time given");
  };
  for (int i = 0; i < 300; ++i) hold(drawn_hit(draw));
  // Ties among large times (2^60 is where they begin to lie twice as far apart), and what is next to ties.
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {Vec{0x1p61, 0}, Vec{0, 0x1p61}};
  const Vec v{1, 0};
  for (int k = -600; k <= 600; ++k) {
    scene.lattices[0].atoms[0].position = {0x1p60 + 1, 0};
    hold(proved(scene, {{-static_cast<double>(k), 0}, v, {}}));
  }
  // Subnormal times, 0, and those around the largest.
  scene = unit_scene(2, 0.25);
  for (int k = 0; k <= 40; ++k) hold(proved(scene, {{-0.25 - k * 0x1p-53, 0}, {0x1p1023, 0}, {}}));
  scene.lattices[0].vectors = {Vec{0x1p24, 0}, Vec{0, 0x1p24}};
  int infinite = 0;
  for (int k = 1; k <= 64; ++k)
    for (const double more : {0., 0x1p-60}) {
      scene.lattices[0].atoms[0].radius = k * 0x1p-33 + more;
      Case c = proved(scene, {{0, 0}, {0x1p-1000, 0}, ObstacleId{}});
      c.proof.windows[0].from = -0x1p980;  // beyond binary64
      c.proof.windows[0].to = *Integer::from_decimal("1" + std::string(310, '0'));
      hold(c);
      infinite += std::isinf(*c.answer.time);
    }
  CHECK(infinite > 10);   // 15 seen
  CHECK(infinite < 110);  // 15 seen
}

TEST_CASE("Times at the ends of binary64's range", "[oracle][certificate_time]") {
  // Around the smallest normal number, 2^-1022, where the numbers do not begin to lie closer: in steps of
  // 2^-1076.
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].vectors = {Vec{8, 0}, Vec{0, 8}};
  scene.lattices[0].atoms[0].position = {2.25, 0};
  for (int k = -12; k <= 12; ++k) {
    Case c = proved(scene, {{k * 0x1p-53, 0}, {0x1p1023, 0}, {}});
    require_accepted(c);
    for (const double sign : {-1., 1.}) {
      Case other = c;
      other.answer.time = *c.answer.time + sign * 0x1p-1074;
      require_refused(other, "is not entered at the time given");
    }
  }
  // Far beyond the largest, where a NaN or a negative number could be taken for one.
  for (const double time : {0x1.8p24, 0x1p25, 0x1.4p25, 0x1p40}) {
    scene.lattices[0].vectors = {Vec{0x1p50, 0}, Vec{0, 0x1p50}};
    scene.lattices[0].atoms[0].position = {time + 0.25, 0};
    Case c = proved(scene, {{0, 0}, {0x1p-1000, 0}, {}});
    REQUIRE(c.answer.time == kInfinity);
    c.proof.windows[0].from = -0x1p1000;
    c.proof.windows[0].to = *Integer::from_decimal("1" + std::string(320, '0'));
    require_accepted(c);
    for (const double other : {std::numeric_limits<double>::quiet_NaN(), -0.0, -0x1p-1024, -0x1.4p-1022,
                               -kInfinity, std::numeric_limits<double>::max()}) {
      c.answer.time = other;
      require_refused(c, "is not entered at the time given");
    }
  }
}

TEST_CASE("Digits that are not those of the time are refused", "[oracle][certificate_time]") {
  Draw draw(2109);
  INFO("seed 2109");
  const std::string reason = "at the time given in decimal";
  for (int i = 0; i < 200; ++i) {
    Case c = drawn_hit(draw);
    if (c.answer.time_decimal == "0") continue;
    const std::string right = c.answer.time_decimal;
    for (std::size_t k = 0; k < right.find('e') && k < right.size(); k += 3) {
      if (right[k] == '.') continue;
      c.answer.time_decimal = right;
      c.answer.time_decimal[k] = static_cast<char>('0' + (right[k] - '0' + 1 + draw.below(9)) % 10);
      require_refused(c, reason);
    }
  }
  // All short decimals next to a right one; ties go to the even digit, also where the number of digits
  // changes.
  oracle::Request request;
  for (int k = 1; k <= 3300; k += k < 400 ? 1 : 7) {
    Case c = timed(k / 32.);
    const oracle::Oracle oracle(c.scene);
    for (request.digits = 1; request.digits <= 4; ++request.digits) {
      const std::string right = oracle.first_hit(c.query, request).time_decimal;
      c.answer.time_decimal = right;
      require_accepted(c);
      const std::size_t last =
          right.find_last_of("0123456789", right.find('e') - (right.find('e') != right.npos));
      for (const int change : {-1, 1}) {
        const char digit = static_cast<char>(right[last] + change);
        if (digit < '0' || digit > '9') continue;
        c.answer.time_decimal[last] = digit;
        require_refused(c, reason);
      }
    }
  }
  Case c = timed(9.75);
  for (const char* right : {"9.75", "9.8", "1e+1", "1e+0001", "975e-2", "9.7500000", "09.75", "0.975e+1"}) {
    c.answer.time_decimal = right;
    require_accepted(c);
  }
  for (const char* wrong : {"10",   "9",      "9.7",      "+9.75",       "-9.75",  " 9.75",    "9.75 ",
                            "9.",   ".975e1", "9.75e",    "9.75e+",      "nan",    "inf",      "0",
                            "0.0",  "e",      "9,75",     "9.75e000000", "9.75e-", "975.e-2",  "0x9",
                            "9.74", "9.76",   "1e+99999", "1e-99999",    "1e1",    "1e+00001", "975.e-2"}) {
    c.answer.time_decimal = wrong;
    require_refused(c, reason);
  }
  c.answer.time_decimal = "9.75" + std::string(5000, '0');
  require_refused(c, reason);
  c = timed(0);
  REQUIRE(c.answer.time_decimal == "0");
  require_accepted(c);
  c.answer.time_decimal = "1e-300";
  require_refused(c, reason);
}

TEST_CASE("Decades: 9.96875 to two digits is 10, not 9.9 or 1.1e+1", "[oracle][certificate_time]") {
  Case c = timed(9.96875);
  for (const auto& [digits, right] : {std::pair{"10", true},
                                      {"1e+1", true},
                                      {"1.0e+1", true},
                                      {"9.97", true},
                                      {"9.9", false},
                                      {"1.1e+1", false},
                                      {"11", false},
                                      {"10.0", false}}) {
    c.answer.time_decimal = digits;
    INFO(digits);
    CHECK((refutation(c) == "") == right);
  }
  c = timed(9.25);
  for (const char* wrong : {"1e+1", "01e+1", "0.01e+3", "10"}) {
    c.answer.time_decimal = wrong;
    require_refused(c, "at the time given in decimal");
  }
  c = timed(9.5);  // halfway between 9 and 1e1, whose last digit counts as even
  for (const auto& [digits, right] : {std::pair{"1e+1", true}, {"9", false}, {"9.5", true}, {"10", false}}) {
    c.answer.time_decimal = digits;
    INFO(digits);
    CHECK((refutation(c) == "") == right);
  }
  c = timed(15);  // halfway between 1e1 and 2e1
  for (const auto& [digits, right] : {std::pair{"1e+1", false}, {"2e+1", true}, {"15", true}}) {
    c.answer.time_decimal = digits;
    INFO(digits);
    CHECK((refutation(c) == "") == right);
  }
}

// ---- never
