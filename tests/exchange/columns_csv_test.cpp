// Queries and answers as CSV.
#include "src/exchange/columns_csv.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include <lorentz/exchange.hpp>
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

struct Reading {
  QueryRows rows;
  std::string failure;
  std::vector<std::string> unknown;  // with their places
};

Reading read(const std::string& content, int dimension = 2) {
  const Folder folder;
  Reading reading;
  try {
    CsvQueryReader reader(folder.write("q.csv", content), dimension,
                          [&](const std::string& place, const std::string& column) {
                            reading.unknown.push_back(place.substr(place.rfind('/') + 1) + " " + column);
                          });
    while (reader.next(reading.rows, 5)) continue;
  } catch (const InputError& error) {
    reading.failure = error.what();
  }
  return reading;
}

// What is wrong with the one row.
std::string flaw(const std::string& row, const std::string& names = "x1,x2,v1,v2") {
  const Reading reading = read(names + "\n" + row + "\n");
  REQUIRE(reading.failure.empty());
  REQUIRE(reading.rows.count == 1);
  return reading.rows.flaws.empty() ? "" : reading.rows.flaws[0].message;
}

}  // namespace

TEST_CASE("CSV: columns in any order, spaces, quotes, CRLF, a byte order mark, blank lines",
          "[exchange][csv]") {
  const Reading reading = read(
      "\xef\xbb\xbf v2 ,id,\"x2\",max_time,v1,x1\r\n"
      "4,a,2,5,3,1\r\n"
      "\r\n"
      " +4 , \"a, \"\"b\"\"\" ,\t0x1p1\t,,\"3\", 1e0 \r\n"
      "4, c d ,2.,inf,3,01.0");
  REQUIRE(reading.failure.empty());
  const QueryRows& rows = reading.rows;
  REQUIRE(rows.count == 3);
  CHECK(rows.flaws.empty());
  for (std::size_t i = 0; i < 3; ++i)
    CHECK((rows.x[0][i] == 1 && rows.x[1][i] == 2 && rows.v[0][i] == 3 && rows.v[1][i] == 4));
  CHECK(rows.id == std::vector<std::string>{"a", "a, \"b\"", "c d"});
  CHECK(rows.lines == std::vector<std::size_t>{2, 4, 5});
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(rows.max_time == std::vector<double>{5, inf, inf});
}

TEST_CASE("CSV: numbers are the nearest to their text, however long it is", "[exchange][csv]") {
  const auto x = [](const std::string& text) {
    const Reading reading = read("x1,x2,v1,v2\n" + text + ",0,1,0\n");
    INFO(text.substr(0, 100));
    REQUIRE(reading.rows.flaws.empty());
    return reading.rows.x[0][0];
  };
  CHECK(x("0x1.8p-1") == 0.75);
  CHECK(x("-0X.8P1") == -1);
  CHECK(x("+0x10") == 16);
  CHECK(x("1e-400") == 0);
  CHECK(x("9007199254740993") == 9007199254740992.0);
  CHECK(x("9007199254740993" + std::string("." + std::string(50'000, '0') + "1")) == 9007199254740994.0);
  CHECK(x("0." + std::string(400, '0') + "1e401") == 1);
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string digits = "0.";
    for (std::uint64_t n = random() % 800 + 1; n-- > 0;) digits += static_cast<char>('0' + random() % 10);
    CHECK(x(digits) == parse_number(digits));
  }
}

TEST_CASE("CSV: the obstacle that is left, integers as tables write them", "[exchange][csv]") {
  const Reading reading = read(
      "x1,x2,x3,v1,v2,v3,from_lattice,from_atom,from_cell1,from_cell2,from_cell3\n"
      "0,0,0,1,0,0,1,2,-3,4,9223372036854775807\n"
      "0,0,0,1,0,0,,,,,\n"
      "0,0,0,1,0,0,-1,,,,\n"
      "0,0,0,1,0,0,0.0,0,2.7e1,-0,9007199254740992.0\n",
      3);
  REQUIRE(reading.failure.empty());
  REQUIRE(reading.rows.flaws.empty());
  CHECK(reading.rows.query(0, 3).from == ObstacleId{1, 2, {-3, 4, std::numeric_limits<std::int64_t>::max()}});
  CHECK_FALSE(reading.rows.query(1, 3).from);
  CHECK_FALSE(reading.rows.query(2, 3).from);
  CHECK(reading.rows.query(3, 3).from == ObstacleId{0, 0, {27, 0, std::int64_t{1} << 53}});
}

TEST_CASE("CSV: of rows that were removed nothing is left in those that come after", "[exchange][csv]") {
  const Folder folder;
  std::string text = "id,x1,x2,v1,v2,max_time,from_lattice,from_atom,from_cell1,from_cell2\n";
  for (int i = 0; i < 9; ++i) {
    const std::string n = std::to_string(i);
    text += "q" + n + ',' + n + ",0," + (i % 4 == 2 ? "bad" : "1") + ",0,1" + n + ',' +
            (i % 2 == 0 ? ",,,\n" : "0,0," + n + ",0\n");
  }
  const QueryRows whole = read(text).rows;
  REQUIRE((whole.count == 9 && whole.flaws.size() == 2));
  CsvQueryReader reader(folder.write("q.csv", text), 2, [](const std::string&, const std::string&) {});
  QueryRows part;
  for (std::size_t done = 0; reader.next(part, 3); done += 3, part.clear()) {
    REQUIRE(part.count == 3);
    CHECK((part.flaws.size() == (done == 3 ? 0 : 1) && part.lines[0] == done + 2));
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(part.id[i] == whole.id[done + i]);
      CHECK(part.max_time[i] == whole.max_time[done + i]);
      CHECK(part.query(i, 2).x == whole.query(done + i, 2).x);
      CHECK(part.query(i, 2).from == whole.query(done + i, 2).from);
    }
  }
}

TEST_CASE("CSV: a bad line is told with its column, and the next is read", "[exchange][csv]") {
  CHECK(flaw("0,0,1,0").empty());
  CHECK(flaw("0,zero,1,0") == "column x2: \"zero\" is not a number");
  CHECK(flaw("0,0,,0") == "column v1: \"\" is not a number");
  CHECK(flaw("0,0,nan,0") == "column v1: \"nan\" is not a number");
  CHECK(flaw("0,0,1,inf") == "column v2: \"inf\" is not a number");
  CHECK(flaw("0,0,1,1e999") == "column v2: \"1e999\" is beyond the range of binary64");
  CHECK(flaw("0,0,1,1 2") == "column v2: \"1 2\" is not a number");
  CHECK(flaw("0,0,1,+-2") == "column v2: \"+-2\" is not a number");
  CHECK(flaw("0,0,1") == "there are 3 fields, and 4 names of columns");
  CHECK(flaw("0,0,1,0,") == "there are 5 fields, and 4 names of columns");
  CHECK(flaw("0,0,1,\"0") == "a quote is not closed");
  CHECK(flaw("0,0,\"1\"1,0") == "there is text behind a quote");
  CHECK(flaw("0,0,1,0,0", "x1,x2,v1,v2,max_time") == "column max_time: \"0\" must be above zero");
  const std::string from = "x1,x2,v1,v2,from_lattice,from_atom,from_cell1,from_cell2";
  CHECK(flaw("0,0,1,0,0,0,0,9223372036854775808", from) ==
        "column from_cell2: \"9223372036854775808\" does not fit 64 bits");
  CHECK(flaw("0,0,1,0,0,0,0.5,0", from) == "column from_cell1: \"0.5\" is not an integer");
  CHECK(flaw("0,0,1,0,0,,0,0", from) == "column from_atom: \"\" is not an integer");
  CHECK(flaw("0,0,1,0,2147483648,0,0,0", from) ==
        "column from_lattice: \"2147483648\" is too large for a number in a scene");
  const Reading reading = read("id,x1,x2,v1,v2\na,0,0,1,0\nb,0,0,1\nc,0,0,x,0\nd,0,0.5,1,0\n");
  REQUIRE(reading.rows.count == 4);
  CHECK(reading.rows.id == std::vector<std::string>{"a", "", "c", "d"});
  REQUIRE(reading.rows.flaws.size() == 2);
  CHECK((reading.rows.flaws[0].row == 1 && reading.rows.flaws[1].row == 2));
  CHECK(reading.rows.x[1][3] == 0.5);
}

TEST_CASE("CSV: names of columns that are wanting, twice there, or not known", "[exchange][csv]") {
  const auto says = [](const std::string& content, const std::string& what) {
    const std::string failure = read(content).failure;
    INFO(failure);
    CHECK(contains(failure, what));
  };
  says("", "q.csv: is empty");
  says("\n \n", "q.csv: is empty");
  says("x1,x2,v1\n", "q.csv:1: there is no column v2; queries in 2 dimensions need it");
  says("\nx1,x1,v1,v2\n", "q.csv:2: there are two columns x1");
  says("x1,x2,v1,v2,from_atom\n", "there is no column from_lattice; from_lattice, from_atom and the cell");
  says("\x93NUMPY\1\n", "--format npy");
  says("{\"scene\":1}\n", "--format ndjson");
  says("x1,x2,v1,\"v2\n", "q.csv:1: a quote is not closed");
  CHECK(read("x1,x2,v1,v2,x3,from_lattise\n0,0,1,0,7,8\n").unknown ==
        std::vector<std::string>{"q.csv:1 x3", "q.csv:1 from_lattise"});
}

TEST_CASE("CSV: answers, a line each", "[exchange][csv]") {
  AnswerRows answers;
  answers.resize(7, 2);
  answers.set(0, Answer::hit({0, 1, {-3, 4}}, 0.1), 0, true);
  answers.set(1, Answer::never(), 0, true);
  answers.set(2, Answer::inside({2, 0, {*Integer::from_decimal("-45500000000000001275"), 1}}), 0, true);
  answers.set(3, Answer::hit({}, std::numeric_limits<double>::infinity()), 0, true);
  answers.set(4, Answer::later(), 0, true);
  answers.set(5, Answer::undecided(), 0, true);
  answers.set(6, Answer::error("no"), 0, true);
  QueryRows queries;
  queries.id = {"a", "b,c", "\"", " d", "", "e", "f"};
  std::string out;
  append_csv_names(out, 2, true);
  append_csv_answers(out, queries, answers, 2, true);
  CHECK(out ==
        "id,outcome,lattice,atom,cell1,cell2,time\n"
        "a,hit,0,1,-3,4,0.1\n"
        "\"b,c\",never,,,,,\n"
        "\"\"\"\",inside,2,0,-45500000000000001275,1,\n"
        "\" d\",hit,0,0,0,0,inf\n"
        ",later,,,,,\n"
        "e,undecided,,,,,\n"
        "f,error,,,,,\n");
  answers.refuse_large_cells();
  CHECK(answers.outcome[2] == Outcome::error);
  REQUIRE(answers.reasons.size() == 2);
  CHECK(answers.large_cells.empty());
  CHECK((answers.reasons[1].row == 2 && answers.reasons[1].unsupported));
  out.clear();
  append_csv_names(out, 3, false);
  CHECK(out == "outcome,lattice,atom,cell1,cell2,cell3,time\n");
}
