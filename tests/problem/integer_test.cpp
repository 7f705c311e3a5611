#include <catch2/catch.hpp>

#include <lorentz/obstacle.hpp>

using lorentz::Integer;

TEST_CASE("Integers of any size keep their decimal form", "[problem][integer]") {
  for (const char* text : {"0", "-1", "9007199254740993", "9223372036854775807", "-9223372036854775808"}) {
    REQUIRE(Integer::from_decimal(text).has_value());
    CHECK(Integer::from_decimal(text)->fits_int64());
    CHECK(Integer::from_decimal(text)->decimal() == text);
  }
  for (const char* text : {"9223372036854775808", "-9223372036854775809", "123456789012345678901234567890"}) {
    REQUIRE(Integer::from_decimal(text).has_value());
    CHECK_FALSE(Integer::from_decimal(text)->fits_int64());
    CHECK(Integer::from_decimal(text)->decimal() == text);
  }
}

TEST_CASE("One number has one form", "[problem][integer]") {
  CHECK(Integer::from_decimal("-0") == Integer(0));
  CHECK(Integer::from_decimal("007") == Integer(7));
  CHECK(Integer::from_decimal("-0009223372036854775809") == Integer::from_decimal("-9223372036854775809"));
}

TEST_CASE("Text that is not an integer is refused", "[problem][integer]") {
  for (const char* text : {"", "-", "+1", "1.0", "1e3", " 1", "1 ", "0x10", "--1"}) {
    INFO(text);
    CHECK_FALSE(Integer::from_decimal(text).has_value());
  }
}
