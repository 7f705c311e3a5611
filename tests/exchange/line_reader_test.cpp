#include <lorentz/line_reader.hpp>

#include <catch2/catch.hpp>

#include <cstdio>
#include <fstream>

#include <lorentz/exchange.hpp>
#include "tests/support/support.hpp"

using lorentz::LineReader;

namespace {

std::vector<std::string> lines_of(const std::string& content, std::vector<bool>* too_long = nullptr) {
  const std::string path = lorentz::test::temporary_file();
  std::ofstream(path, std::ios::binary) << content;
  std::vector<std::string> lines;
  {
    LineReader reader(path);
    for (LineReader::Line line; reader.next(line);) {
      CHECK(line.number == lines.size() + 1);
      lines.emplace_back(line.text);
      if (too_long) too_long->push_back(line.too_long);
    }
  }
  std::remove(path.c_str());
  return lines;
}

}  // namespace

TEST_CASE("Lines, with and without an end, empty ones too", "[exchange][line_reader]") {
  using Lines = std::vector<std::string>;
  CHECK(lines_of("").empty());
  CHECK(lines_of("a") == Lines{"a"});
  CHECK(lines_of("a\n") == Lines{"a"});
  CHECK(lines_of("\xef\xbb\xbf"
                 "a\n\xef\xbb\xbf"
                 "b") == Lines{"a",
                               "\xef\xbb\xbf"
                               "b"});
  CHECK(lines_of("\n\na\nb") == Lines{"", "", "a", "b"});
  CHECK(lines_of(std::string("a\0b\nc", 5)) == Lines{std::string("a\0b", 3), "c"});
}

TEST_CASE("Lines across the ends of buffers", "[exchange][line_reader]") {
  std::string content;
  std::vector<std::string> expected;
  for (int i = 0; i < 300; ++i) {
    expected.push_back(
        std::string(static_cast<std::size_t>(i * 97 % 20011), static_cast<char>('a' + i % 26)));
    content += expected.back() + '\n';
  }
  CHECK(lines_of(content) == expected);
}

TEST_CASE("A line of 100 MB is passed over, and those around it are not", "[exchange][line_reader]") {
  std::vector<bool> too_long;
  const auto lines = lines_of("first\n" + std::string(100'000'000, 'x') + "\nlast\n", &too_long);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] == "first");
  CHECK(lines[2] == "last");
  CHECK(too_long == std::vector<bool>{false, true, false});
}

TEST_CASE("A line has 32 MiB at most, wherever it comes from", "[exchange][line_reader]") {
  std::vector<bool> too_long;
  const std::string longest(LineReader::kMaxLine, 'x');
  lines_of(longest + "\n" + longest + "\r\n\n" + longest + "x\n" + longest, &too_long);
  CHECK(too_long == std::vector<bool>{false, true, false, true, false});
}

TEST_CASE("What cannot be read says so", "[exchange][line_reader]") {
  CHECK_THROWS_AS(LineReader("/no/such/file"), lorentz::FileError);
  CHECK_THROWS_WITH(LineReader("/"), Catch::Contains("is a directory"));
}
