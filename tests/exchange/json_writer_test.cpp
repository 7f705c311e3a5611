// JSON as it is written: every sort of value, and what a reader makes of it.
#include "src/exchange/json_writer.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "src/exchange/exchange_json.hpp"

namespace json = lorentz::json;
using lorentz::Integer;

namespace {

struct Named {
  int number;
};
void append_json(std::string& out, const Named& named) {
  json::append(out, [&](json::Members& object) { object.add("number", named.number); });
}

}  // namespace

TEST_CASE("Each sort of value has its text", "[exchange][json]") {
  CHECK(json::text_of(true) == "true");
  CHECK(json::text_of(-7) == "-7");
  CHECK(json::text_of(std::uint8_t{200}) == "200");
  CHECK(json::text_of(0.1) == "0.1");
  CHECK(json::text_of(-std::numeric_limits<double>::infinity()) == "\"-inf\"");
  CHECK(json::text_of(json::finite(std::numeric_limits<double>::quiet_NaN())) == "null");
  CHECK(json::text_of(json::finite(0.5)) == "0.5");
  CHECK(json::text_of("a\"\n\\") == R"("a\"\u000a\\")");
  CHECK(json::text_of(std::optional<std::string>()) == "null");
  CHECK(json::text_of(std::optional(3)) == "3");
  CHECK(json::text_of(json::Raw{"[ 1 ]"}) == "[ 1 ]");
  CHECK(json::text_of(std::vector<std::array<int, 2>>{{1, 2}, {3, 4}}) == "[[1,2],[3,4]]");
  CHECK(json::text_of(std::vector<double>()) == "[]");
  CHECK(json::text_of(Named{4}) == R"({"number":4})");
  CHECK(json::text_of([](json::Members&) {}) == "{}");
  CHECK(json::line_of(json::raw({"{}", "1"})) == "[{},1]\n");
}

TEST_CASE("Whole numbers are in quotes from where binary64 has not all of them", "[exchange][json]") {
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  for (const std::int64_t n : {kExact, -kExact, kExact - 1}) CHECK(json::text_of(n) == std::to_string(n));
  for (const std::int64_t n : {kExact + 1, -kExact - 1, std::numeric_limits<std::int64_t>::min()}) {
    CHECK(json::text_of(n) == '"' + std::to_string(n) + '"');
    CHECK(json::text_of(Integer(n)) == json::text_of(n));
  }
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  CHECK(json::text_of(kMost) == "\"18446744073709551615\"");
}

TEST_CASE("Members stand in the order in which they were added", "[exchange][json]") {
  const std::vector<Named> items{{1}, {2}};
  const auto fill = [](json::Members& one, const Named& item) { one.add("n", item.number); };
  const std::string text = json::text_of([&](json::Members& object) {
    object.add("b", 1, "a", [](json::Members& inner) { inner.add_named("k\"", 2); }).add_members(R"("c":[])");
    object.add("d", json::objects(items, fill), "e", json::objects(items, fill, "\n"), "f", items);
  });
  CHECK(text == R"({"b":1,"a":{"k\"":2},"c":[],"d":[{"n":1},{"n":2}],"e":[)"
                "\n{\"n\":1},\n{\"n\":2}],"
                R"("f":[{"number":1},{"number":2}]})");
}

TEST_CASE("Texts of any bytes are read as they were written", "[exchange][json]") {
  std::string all;
  for (char32_t c = 0; c < 0x800; ++c) {
    if (c >= 0x80) all += static_cast<char>(0xc0 | c >> 6);
    all += static_cast<char>(c < 0x80 ? c : 0x80 | (c & 0x3f));
  }
  const std::string text =
      json::text_of([&](json::Members& object) { object.add_named(all, all).add("bad", "\xff"); });
  json::Document document;
  document.open(text);
  std::vector<std::string> read;
  json::each_member(document.object(), [&](std::string_view key, json::Value value) {
    read.emplace_back(key);
    read.emplace_back(value.text());
  });
  CHECK(read == std::vector<std::string>{all, all, "bad", "\ufffd"});
}
