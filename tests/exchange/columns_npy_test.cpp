// Arrays of NumPy, in and out, byte by byte.
#include "src/exchange/columns_npy.hpp"

#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include <lorentz/errors.hpp>
#include "tests/support/command_line.hpp"
#include "tests/support/npy.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// All rows, read in parts; the last message, if it did not end well.
struct Reading {
  QueryRows rows;
  std::string failure;
  bool more = false;
};

Reading read_path(const std::string& path, int dimension, std::size_t part) {
  Reading reading;
  try {
    const auto reader = read_npy_queries(path, dimension);
    while (reader->next(reading.rows, part)) continue;
    reading.more = reader->has_more();
  } catch (const InputError& error) {
    reading.failure = error.what();
  }
  return reading;
}

Reading read(const std::string& content, int dimension, std::size_t part = 7) {
  static const Folder folder;  // one for thousands of files
  const Reading reading = read_path(folder.write("q.npy", content), dimension, part);
  fs::remove(folder.file("q.npy"));  // faster than to write over it
  return reading;
}

// The same out of a pipe, which has no places to go to.
Reading read_piped(const std::string& content, int dimension, std::size_t part) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  std::thread writer([&] {
    ssize_t more = 1;
    for (std::size_t done = 0; done < content.size() && more > 0; done += static_cast<std::size_t>(more))
      more = write(ends[1], content.data() + done, content.size() - done);
    close(ends[1]);
  });
  Reading reading = read_path("/dev/fd/" + std::to_string(ends[0]), dimension, part);
  close(ends[0]);
  writer.join();
  return reading;
}

using Rows = std::vector<std::vector<double>>;

Rows drawn_rows(std::mt19937_64& random, std::size_t count, std::size_t columns) {
  Rows rows(count, std::vector<double>(columns));
  for (auto& row : rows)
    for (double& number : row) number = std::ldexp(static_cast<double>(random()), -60);
  return rows;
}

void check_rows(const QueryRows& read, const Rows& rows, std::size_t d) {
  REQUIRE(read.count == rows.size());
  const bool limits = rows.front().size() > 2 * d;
  REQUIRE(read.max_time.size() == (limits ? rows.size() : 0));
  bool same = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < d; ++k) same &= read.x[k][i] == rows[i][k] && read.v[k][i] == rows[i][d + k];
    if (limits) same &= read.max_time[i] == rows[i][2 * d];
  }
  CHECK(same);
}

}  // namespace

TEST_CASE("Arrays of queries, in all versions of the format", "[exchange][npy]") {
  std::mt19937_64 random(20260101);
  for (const std::size_t d : {2, 3})
    for (const bool limits : {false, true})
      for (const int version : {1, 2, 3}) {
        INFO(d << limits << version);
        const Rows rows = drawn_rows(random, 100, 2 * d + limits);
        const Reading reading = read(npy_rows(rows, version), static_cast<int>(d));
        CHECK(reading.failure.empty());
        CHECK_FALSE(reading.more);
        check_rows(reading.rows, rows, d);
      }
}

TEST_CASE("Arrays with fields: x and v, with and without limits and obstacles that are left",
          "[exchange][npy]") {
  for (const std::size_t d : {2, 3})
    for (const bool limits : {false, true})
      for (const bool leaves : {false, true}) {
        const std::string n = "(" + std::to_string(d) + ",)";
        std::string description = "[('x', '<f8', " + n + "), ('v', '<f8', " + n + ")", data;
        if (limits) description += ", ('max_time', '<f8')";
        if (leaves)
          description += ", ('from_lattice', '<i4'), ('from_atom', '<i4'), ('from_cell', '<i8', " + n + ")";
        for (int i = 0; i < 20; ++i) {
          for (std::size_t k = 0; k < 2 * d; ++k) data += bytes_of(0.5 * i + static_cast<double>(k));
          if (limits) data += bytes_of(10.0 + i);
          if (leaves) data += bytes_of(i % 2 == 0 ? -1 : 1) + bytes_of(70000 + i);
          for (std::size_t k = 0; leaves && k < d; ++k)
            data += bytes_of((std::int64_t{1} << 60) - i - static_cast<int>(k));
        }
        const Reading reading =
            read(npy_file(npy_dictionary(description + "]", "(20,)"), data), static_cast<int>(d));
        INFO(description << reading.failure);
        REQUIRE((reading.failure.empty() && reading.rows.count == 20));
        const QueryRows& rows = reading.rows;
        CHECK((rows.max_time.empty() == !limits && rows.from_lattice.empty() == !leaves));
        for (int i = 0; i < 20; ++i) {
          const auto at = static_cast<std::size_t>(i);
          for (std::size_t k = 0; k < d; ++k) {
            const double place = 0.5 * i + static_cast<double>(k);
            CHECK((rows.x[k][at] == place && rows.v[k][at] == place + static_cast<double>(d)));
          }
          if (limits) CHECK(rows.max_time[at] == 10 + i);
          const Query query = rows.query(at, static_cast<int>(d));
          CHECK(query.from.has_value() == (leaves && i % 2 == 1));
          if (!query.from) continue;
          CHECK((query.from->lattice == 1 && query.from->atom == 70000 + i));
          CHECK(query.from->cell[d - 1] == Integer((std::int64_t{1} << 60) - i - static_cast<int>(d - 1)));
        }
      }
}

TEST_CASE("Arrays that are not queries are refused, with what they are and the remedy", "[exchange][npy]") {
  const auto says = [](const std::string& content, const std::string& what) {
    const Reading reading = read(content, 2);
    INFO(reading.failure);
    CHECK(contains(reading.failure, "q.npy: "));
    CHECK(contains(reading.failure, what));
  };
  const auto array = [](const std::string& description, const std::string& shape) {
    return npy_file(npy_dictionary(description, shape), std::string(1000, '\0'));
  };
  says("", "is empty");
  says("{\"x\":[0,0]}", "--format ndjson");
  says("x1,x2,v1,v2\n", "is no .npy file");
  says("\x93NUM", "ends in its header");
  says("\x93NUMPY", "ends in its header");
  for (const char* version : {"\0\0", "\4\0", "\1\1"})
    says("\x93NUMPY" + std::string(version, 2) + std::string("\1\0", 2), "of version 1.0, 2.0 or 3.0");
  says(std::string("\x93NUMPY\1\0\x50\0{'descr'", 18), "ends in its header");
  says(std::string("\x93NUMPY\2\0\0\0\0\x7f", 12), "longer than 4 KiB");
  says(npy_file("{'descr': '<f8', 'fortran_order': True, 'shape': (5, 4), }", ""),
       "save np.ascontiguousarray(ARRAY, DTYPE)");
  const std::string good = npy_dictionary("'<f8'", "(1, 4)");
  for (const auto& [from, to] : {std::pair<std::string, std::string>{good, ""},
                                 {"{", ""},
                                 {"'<f8'", "8"},
                                 {"False", "0"},
                                 {", }", "}"},
                                 {"(1, 4)", "4"},
                                 {"(1, 4)", "(-1, 4)"},
                                 {"(1, 4)", "(1, 4, 1)"},
                                 {"(1, 4)", "(5)"},
                                 {"(1, 4)", "()"},
                                 {"(1, 4)", "(99999999999999999999, 4)"},
                                 {"'<f8'", "'=f8'"},
                                 {"'<f8'", "'>f8'"},
                                 {"'<f8'", "['<f8']"},
                                 {", ", ","},
                                 {"}", "} x"},
                                 {"'descr'", "\"descr\""},
                                 {"'<f8'", "[]"},
                                 {"'<f8'", "'|O'"},
                                 {"'<f8'", "''"},
                                 {"'<f8'", "'<c16'"},
                                 {"'<f8'", "'<f4'"},
                                 {"'<f8'", "'<i8'"},
                                 {"(1, 4)", "(1, 6)"},
                                 {"(1, 4)", "(4,)"}}) {
    std::string header = good;
    header.replace(header.find(from), from.size(), to);
    says(npy_file(header, std::string(100, '\0')), "is an array with the header ");
    says(npy_file(header, std::string(100, '\0')),
         "; in d = 2 dimensions queries are float64 of shape (N, 2 d)");
  }
  for (const char* description :
       {"[('x', '<f8', (2,))]", "[('x', '<f8', (3,)), ('v', '<f8', (3,))]",
        "[('x', '<f8', (2,)), ('v', '<f4', (2,))]", "[('x', '<f8', (2,)), ('v', '>f8', (2,))]",
        "[('v', '<f8', (2,)), ('x', '<f8', (2,))]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('colour', '<U2')]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('from_lattice', '<i8'), "
        "('from_atom', '<i4'), ('from_cell', '<i8', (2,))]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('from_lattice', '<i4')]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('from_cell', '<i4', (2,))]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('max_time', '<i4')]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('o', '|O')]",
        "[(('title', 'x'), '<f8', (2,)), ('v', '<f8', (2,))]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('in', [('a', '<f8')])]",
        "[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('a', '<f8', (2, 2))]",
        "[('x', '<f8', (2, 1)), ('v', '<f8', (2,))]", "[('x',)]", "['x', '<f8']"}) {
    INFO(description);
    says(array(description, "(5,)"), std::string("{'descr': ") + description);
  }
  says(array("[('x', '<f8', (2,)), ('v', '<f8', (2,))]", "(5, 1)"), "(5, 1)");
}

TEST_CASE("A file that ends too early: its rows are read, and those that are missing are counted",
          "[exchange][npy]") {
  std::mt19937_64 random(2);
  const Rows rows = drawn_rows(random, 10, 5);
  const std::string whole = npy_rows(rows);
  for (std::size_t missing = 1; missing <= 10 * 40; missing += 3) {
    const std::string content = whole.substr(0, whole.size() - missing);
    const std::size_t gone = (missing + 39) / 40;
    for (const Reading& reading : {read(content, 2, 4), read_piped(content, 2, 4)}) {
      INFO(missing);
      CHECK(contains(reading.failure, ": ends too early: " + std::to_string(gone) + " of 10 rows"));
      if (gone < 10) check_rows(reading.rows, Rows(rows.begin(), rows.end() - static_cast<int>(gone)), 2);
    }
  }
  CHECK(read(whole + "x", 2).more);
  CHECK(read_piped(whole + "x", 2, 7).more);
  // What a header promises is not taken before it is there.
  const std::string promises = npy_file(npy_dictionary("'<f8'", "(1099511627776, 4)"), std::string(20, '\0'));
  for (const auto& reads : {read, read_piped})
    CHECK(contains(reads(promises, 2, 7).failure, "ends too early: 1099511627776 of 1099511627776 rows"));
  CHECK(read(npy_rows({}), 2).failure.empty());
}

TEST_CASE("Arrays longer than a pipe holds, and than what is read of them at once", "[exchange][npy]") {
  std::mt19937_64 random(3);
  for (const std::size_t count : {1638, 1639, 10'000}) {  // 64 KiB are 1638.4 rows
    const Rows rows = drawn_rows(random, count, 5);
    const Reading reading = read_piped(npy_rows(rows), 2, 3000);
    INFO(count << reading.failure);
    CHECK((reading.failure.empty() && !reading.more));
    check_rows(reading.rows, rows, 2);
  }
}

TEST_CASE("Queries as an array, with and without obstacles that they leave, are read back",
          "[exchange][npy]") {
  std::mt19937_64 random(4);
  for (const std::size_t d : {2, 3})
    for (const bool with_from : {false, true}) {
      const Rows rows = drawn_rows(random, 5, 2 * d);
      QueryRows queries;
      for (const auto& row : rows) {
        for (std::size_t k = 0; k < d; ++k)
          queries.x[k].push_back(row[k]), queries.v[k].push_back(row[d + k]);
        if (with_from) {
          const auto n = static_cast<std::int32_t>(queries.count);
          queries.from_lattice.push_back(n - 1), queries.from_atom.push_back(7 * n);
          for (std::size_t k = 0; k < d; ++k)
            queries.from_cell[k].push_back((std::int64_t{1} << 60) - n - static_cast<int>(k));
        }
        ++queries.count;
      }
      std::string text = npy_query_header(10, static_cast<int>(d), with_from);
      for (int twice = 0; twice < 2; ++twice) append_npy_queries(text, queries, static_cast<int>(d));
      const Reading reading = read(text, static_cast<int>(d));
      INFO(d << with_from << reading.failure);
      CHECK((reading.failure.empty() && !reading.more));
      Rows both = rows;
      both.insert(both.end(), rows.begin(), rows.end());
      check_rows(reading.rows, both, d);
      for (std::size_t i = 0; i < 10; ++i) {
        const Query read = reading.rows.query(i, static_cast<int>(d)),
                    written = queries.query(i % 5, static_cast<int>(d));
        CHECK(read.from == written.from);
        CHECK(read.from.has_value() == (with_from && i % 5 > 0));
      }
    }
}

TEST_CASE("Spoilt .npy files never do worse than an error", "[exchange][npy]") {
  std::mt19937_64 random(31);
  const std::string fields =
      npy_file(npy_dictionary("[('x', '<f8', (2,)), ('v', '<f8', (2,)), ('from_lattice', '<i4'), "
                              "('from_atom', '<i4'), ('from_cell', '<i8', (2,))]",
                              "(9,)"),
               std::string(9 * 56, '\1'));
  const std::string numbers = npy_rows(drawn_rows(random, 9, 4));
  const std::string alphabet = "(){}[]'\",: 0123456789<>|=fiuVSUOTrueFalsxN\\\n\xff";
  int read_well = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string content = i % 2 == 0 ? fields : numbers;
    const std::size_t header = content.find('\n');
    for (std::uint64_t changes = random() % 4 + 1; changes-- > 0;) {
      const std::size_t place = random() % header;
      const char c = random() % 4 == 0 ? static_cast<char>(random()) : alphabet[random() % alphabet.size()];
      if (random() % 3 == 0)
        content.insert(place, 1, c);
      else if (random() % 2 == 0)
        content[place] = c;
      else
        content.erase(place, random() % 5);
    }
    const Reading reading = read(content, 2, 4);
    ++(reading.failure.empty() ? read_well : refused);
    CHECK(reading.rows.count < 1000);
  }
  CHECK(read_well > 50);  // 318 seen
  CHECK(refused > 2000);
}

TEST_CASE("Answers as an array: the header as NumPy pads it, and every byte of the rows", "[exchange][npy]") {
  for (const int d : {2, 3}) {
    const std::string header = npy_answer_header(7, d);
    CHECK(header.size() % 64 == 0);
    CHECK(header.starts_with(std::string("\x93NUMPY\1\0", 8)));
    CHECK(header.back() == '\n');
    CHECK(header.substr(10).starts_with("{'descr': [('outcome', '|u1'), ('stage', '|u1'), "));
    CHECK(contains(header, d == 2 ? "('cell', '<i8', (2,)), ('time', '<f8')]" : "(3,)), ('time', '<f8')]"));
    CHECK(contains(header, "'fortran_order': False, 'shape': (7,), }  "));
    AnswerRows answers;
    answers.resize(3, d);
    answers.set(0, Answer::hit({1, 2, {-3, 4, 5}}, 0.5), 2, true);
    answers.set(1, Answer::never(), AnswerRows::kExactStage, true);
    answers.set(2, Answer::error("no"), 0, true);
    std::string out;
    append_npy_answers(out, answers);
    const auto row = [&](const std::string& bytes, int lattice, int atom, Cell cell, double time) {
      std::string text = bytes + bytes_of(lattice) + bytes_of(atom);
      for (int k = 0; k < d; ++k) text += bytes_of(cell[k].int64());
      return text + bytes_of(time);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(out == row(std::string("\0\2\1", 3), 1, 2, {-3, 4, 5}, 0.5) +
                     row(std::string("\1\3\0", 3), 0, 0, {}, nan) +
                     row(std::string("\5\xff\0", 3), 0, 0, {}, nan));
  }
}

TEST_CASE("Rows of queries that are cleared are as new ones, and queries as an array hold their bytes alone",
          "[exchange][npy]") {
  std::mt19937_64 random(5);
  for (const int dimension : {2, 3}) {
    const Rows numbers = drawn_rows(random, 5, static_cast<std::size_t>(2 * dimension));
    QueryRows rows = read(npy_rows(numbers), dimension).rows;
    std::string bytes;
    append_npy_queries(bytes, rows, dimension);
    CHECK(bytes.size() == 5 * 16 * static_cast<std::size_t>(dimension));
    check_rows(read(npy_query_header(5, dimension, false) + bytes, dimension).rows, numbers, dimension);

    rows.from_lattice = rows.from_atom = std::vector<std::int32_t>(5, 1);
    for (int k = 0; k < dimension; ++k) rows.from_cell[k] = {1, 2, 3, 4, 5};
    bytes.clear();
    append_npy_queries(bytes, rows, dimension);
    CHECK(bytes.size() == 5 * (24 * static_cast<std::size_t>(dimension) + 8));

    rows.max_time = {1, 2, 3, 4, 5}, rows.large_from = {{2, ObstacleId{}}};
    rows.id = {"1"}, rows.flaws = {{3, "no number"}}, rows.lines = {7};
    rows.clear();
    CHECK(rows.count == 0);
    std::size_t left = rows.max_time.size() + rows.from_lattice.size() + rows.from_atom.size() +
                       rows.large_from.size() + rows.id.size() + rows.flaws.size() + rows.lines.size();
    for (int k = 0; k < 3; ++k) left += rows.x[k].size() + rows.v[k].size() + rows.from_cell[k].size();
    CHECK(left == 0);
  }
}

TEST_CASE("Answers whose cells a column does not hold are refused once, each with its row",
          "[exchange][npy]") {
  AnswerRows answers;
  answers.resize(3, 2);
  const Integer large = *Integer::from_decimal("1180591620717411303424");
  answers.set(0, Answer::inside({0, 0, {large, 1}}), 0, false);
  answers.set(1, Answer::hit({0, 0, {1, 2}}, 2.5), 0, true);
  answers.set(2, Answer::hit({1, 2, {3, large}}, 3.5), 0, true);
  REQUIRE(answers.large_cells.size() == 2);
  for (int times = 0; times < 2; ++times) {
    answers.refuse_large_cells();
    CHECK(answers.large_cells.empty());
    REQUIRE(answers.reasons.size() == 2);
    CHECK(answers.reasons[0].row == 0);
    CHECK(answers.reasons[1].row == 2);
    CHECK(contains(answers.reasons[1].message, "(3, 1180591620717411303424)"));
    CHECK((answers.outcome[0] == Outcome::error && answers.outcome[2] == Outcome::error));
    CHECK((answers.outcome[1] == Outcome::hit && answers.time[1] == 2.5 && answers.cell(1)[1] == 2));
  }
  answers.set(0, Answer::inside({0, 0, {large, 1}}), 0, false);
  answers.resize(3, 2);
  CHECK((answers.large_cells.empty() && answers.reasons.empty()));
}
