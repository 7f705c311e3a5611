// lorentz first-hit --format csv|npy: the answers are those of the stream in JSON, to the bit.
#include <pty.h>
#include <unistd.h>
#include <catch2/catch.hpp>
#include <charconv>
#include <cmath>
#include <limits>

#include <lorentz/exchange.hpp>
#include "tests/support/command_line.hpp"
#include "tests/support/npy.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Asked {
  Query query;
  double limit = kNoLimit;
};

// From anywhere, some from inside, some along an axis; some leave an obstacle, some have a limit. `far`: some
// fly so far that the fast engines do not know where.
std::vector<Asked> drawn(std::uint64_t seed, const Scene& scene, int count, bool far) {
  Draw draw(seed);
  std::vector<Asked> asked(static_cast<std::size_t>(count));
  for (Asked& one : asked) {
    one.query.x = draw.vec(scene.dimension, -2, 2);
    one.query.v = draw.vec(scene.dimension, -1, 1);
    if (draw.one_in(8)) one.query.v = {draw.sign(), 0, 0};
    if (far && draw.one_in(8)) one.query.v = {draw.sign(), draw.tiny(-60, -54), 0};
    if (draw.one_in(3)) one.limit = draw.one_in(2) ? 0.5 : 3;
    if (!draw.one_in(3)) continue;
    one.query.from.emplace();
    one.query.from->lattice = static_cast<int>(draw.below(scene.lattices.size()));
    const auto& atoms = scene.lattices[static_cast<std::size_t>(one.query.from->lattice)].atoms;
    one.query.from->atom = static_cast<int>(draw.below(atoms.size()));
    for (int k = 0; k < scene.dimension; ++k)
      one.query.from->cell[k] = static_cast<std::int64_t>(draw.below(3)) - 1;
  }
  return asked;
}

std::string ndjson_of(const std::vector<Asked>& asked, int d) {
  std::string text;
  for (const Asked& one : asked) append_query_line(text, "null", one.query, d);
  return text;
}

std::string csv_of(const std::vector<Asked>& asked, int d) {
  std::string text = "max_time,from_lattice,from_atom";
  for (int k = 1; k <= d; ++k) text += ",from_cell" + std::to_string(k) + ",x" + std::to_string(k);
  for (int k = 1; k <= d; ++k) text += ",v" + std::to_string(k);
  for (const Asked& one : asked) {
    text += '\n';
    if (one.limit < kNoLimit) append_number(text, one.limit);
    const auto& from = one.query.from;
    text += from ? "," + std::to_string(from->lattice) + "," + std::to_string(from->atom) : ",,";
    for (int k = 0; k < d; ++k) {
      text += "," + (from ? from->cell[k].decimal() : "") + ",";
      append_number(text, one.query.x[k]);
    }
    for (int k = 0; k < d; ++k) append_number(text += ',', one.query.v[k]);
  }
  return text + '\n';
}

std::string npy_of(const std::vector<Asked>& asked, int d) {
  const std::string vector = ", (" + std::to_string(d) + ",))";
  const std::string description = "[('x', '<f8'" + vector + ", ('v', '<f8'" + vector +
                                  ", ('max_time', '<f8'), ('from_lattice', '<i4'), ('from_atom', '<i4'), " +
                                  "('from_cell', '<i8'" + vector + "]";
  std::string data;
  for (const Asked& one : asked) {
    const auto& from = one.query.from;
    for (int k = 0; k < d; ++k) data += bytes_of(one.query.x[k]);
    for (int k = 0; k < d; ++k) data += bytes_of(one.query.v[k]);
    data += bytes_of(one.limit) + bytes_of(from ? from->lattice : -1) + bytes_of(from ? from->atom : 0);
    for (int k = 0; k < d; ++k) data += bytes_of(from ? from->cell[k].int64() : 0);
  }
  return npy_file(npy_dictionary(description, "(" + std::to_string(asked.size()) + ",)"), data);
}

// One answer as text, with the bits of its time.
std::string words(int outcome, int lattice, int atom, const std::vector<std::string>& cell, double time) {
  std::string text = std::to_string(outcome);
  if (outcome == 0 || outcome == 2) {
    text += " " + std::to_string(lattice) + " " + std::to_string(atom);
    for (const std::string& n : cell) text += " " + n;
  }
  return outcome == 0 ? text + " " + std::to_string(std::bit_cast<std::uint64_t>(time)) : text;
}

std::vector<std::string> answers_in_json(const std::string& text, int d) {
  const Folder folder;
  LineReader lines(folder.write("a", text));
  ExchangeReader reader;
  std::vector<std::string> answers;
  for (LineReader::Line line; lines.next(line);) {
    Id id;
    Answer answer;
    std::size_t components;
    reader.read_answer_line(line, id, answer, components);
    std::vector<std::string> cell;
    for (int k = 0; k < d; ++k) cell.push_back(answer.obstacle.cell[k].decimal());
    answers.push_back(words(static_cast<int>(answer.outcome), answer.obstacle.lattice, answer.obstacle.atom,
                            cell, answer.time.value_or(0)));
  }
  return answers;
}

std::vector<std::string> answers_in_csv(const std::string& text, int d) {
  std::vector<std::string> answers;
  std::istringstream in(text);
  std::string line;
  for (std::getline(in, line); std::getline(in, line);) {
    std::vector<std::string> fields{""};
    for (const char c : line)
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    REQUIRE(fields.size() == static_cast<std::size_t>(4 + d));
    const std::vector<std::string> outcomes{"hit", "never", "inside", "later", "undecided", "error"};
    const auto outcome = std::find(outcomes.begin(), outcomes.end(), fields[0]) - outcomes.begin();
    const bool has_obstacle = outcome == 0 || outcome == 2;
    CHECK(has_obstacle == !fields[1].empty());
    answers.push_back(words(static_cast<int>(outcome), has_obstacle ? std::stoi(fields[1]) : 0,
                            has_obstacle ? std::stoi(fields[2]) : 0, {fields.begin() + 3, fields.end() - 1},
                            outcome == 0 ? parse_number(fields.back()) : 0));
  }
  return answers;
}

std::vector<std::string> answers_in_npy(const std::string& file, int d) {
  const std::string data = npy_data(file);
  std::vector<std::string> answers;
  const std::size_t row = 19 + 8 * static_cast<std::size_t>(d);
  REQUIRE(data.size() % row == 0);
  for (const char* at = data.data(); at < data.data() + data.size(); at += row) {
    std::vector<std::string> cell;
    for (int k = 0; k < d; ++k) cell.push_back(std::to_string(number_of<std::int64_t>(at + 11 + 8 * k)));
    const auto time = number_of<double>(at + row - 8);
    CHECK(std::isnan(time) == (at[0] != 0));
    answers.push_back(
        words(at[0], number_of<std::int32_t>(at + 3), number_of<std::int32_t>(at + 7), cell, time));
  }
  return answers;
}

// What the stream in JSON says, each query before its own limit; --max-time holds for all.
std::vector<std::string> by_stream(const Folder& folder, const std::string& command,
                                   const std::vector<Asked>& asked, int d, double max_time) {
  const auto queries = folder.write("q.ndjson", ndjson_of(asked, d));
  std::vector<std::string> answers(asked.size());
  for (const double limit : {0.5, 3.0, kNoLimit}) {
    const double both = std::min(limit, max_time);
    const std::string option = both < kNoLimit ? " --max-time " + std::to_string(both) : "";
    const auto all = answers_in_json(folder.lorentz(command + option + " " + queries).out, d);
    REQUIRE(all.size() == asked.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      if (asked[i].limit == limit) answers[i] = all[i];
  }
  return answers;
}

// Slow on long flights.
bool cells_one_by_one(const std::string& engine) {
  return engine == "walk" || engine == "classical" || engine == "published";
}

}  // namespace

TEST_CASE("Columns have the answers of the stream in JSON, to the bit", "[cli][columns]") {
  const Folder folder;
  std::map<char, int> outcomes;
  std::uint64_t seed = 4711;
  for (const std::string scene :
       {"square --radius 0.1", "cubic --radius 0.2", "ellipses-mixed", "cesium-chloride"})
    for (const std::string engine :
         {"oracle", "walk", "certified", "certified-batch", "reduction", "batch", "classical", "published"})
      for (const double max_time : {kNoLimit, 2.0}) {
        INFO(scene << " " << engine << " " << max_time << " seed " << seed);
        const Scene drawn_in = all_scenes().at(scene.substr(0, scene.find(' ')));
        const int d = drawn_in.dimension;
        const bool slow = cells_one_by_one(engine);
        const auto asked = drawn(seed++, drawn_in, slow ? 30 : 300, !slow);
        const std::string command = "first-hit --scene " + scene + " --engine " + engine;
        const auto expected = by_stream(folder, command, asked, d, max_time);
        const std::string option = max_time < kNoLimit ? " --max-time 2" : "";
        const Run csv =
            folder.lorentz(command + option + " --format csv " + folder.write("q.csv", csv_of(asked, d)));
        CHECK(csv.status == 0);
        CHECK(answers_in_csv(csv.out, d) == expected);
        const Run npy =
            folder.lorentz(command + option + " --format npy " + folder.write("q.npy", npy_of(asked, d)));
        CHECK(npy.status == 0);
        CHECK(answers_in_npy(npy.out, d) == expected);
        for (const std::string& answer : expected) ++outcomes[answer[0]];
      }
  CHECK(outcomes['0'] > 5000);
  CHECK(outcomes['1'] > 100);
  CHECK(outcomes['2'] > 1000);
  CHECK(outcomes['3'] > 1000);
}

TEST_CASE("Columns: many rows, any number of threads, a file or a pipe", "[cli][columns]") {
  const Folder folder;
  Draw draw(815);
  std::vector<std::vector<double>> rows(30'000);
  for (auto& row : rows) row = {draw.uniform(), draw.uniform(), draw.between(-1, 1), draw.between(-1, 1)};
  const auto queries = folder.write("q.npy", npy_rows(rows));
  const std::string command = "first-hit --scene square --format npy --engine ";
  for (const std::string engine : {"batch", "certified-batch"}) {
    const Run run = folder.lorentz(command + engine + " " + queries);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK(npy_data(run.out).size() == rows.size() * 35);
    for (const std::string& other :
         {engine + " --jobs 3 " + queries, engine + " < " + queries, engine + " - < " + queries}) {
      INFO(other);
      CHECK((folder.lorentz(command + other).out == run.out));
    }
    CHECK((folder.run("cat " + queries + " | " LORENTZ_PROGRAM " " + command + engine).out == run.out));
  }
}

TEST_CASE("Columns: bad rows are errors in their place, and said on stderr", "[cli][columns]") {
  const Folder folder;
  const auto csv = folder.write("q.csv",
                                "id,x1,x2,v1,v2,max_time,from_lattice,from_atom,from_cell1,from_cell2\n"
                                "a,0.5,0,1,0,,,,,\n"
                                "b,0.5,0,0,0,,,,,\n"
                                "c,0.5,zero,1,0,,,,,\n"
                                "d,0.5,0,1,0,,7,0,0,0\n"
                                "e,0.5,0,1,0,0.25,,,,\n");
  for (const std::string engine : {"oracle", "batch", "certified-batch", "classical"}) {
    const Run run =
        folder.lorentz("first-hit --scene square --radius 0.25 --format csv -e " + engine + " " + csv);
    INFO(engine << run.err);
    CHECK(run.status == 2);
    CHECK(run.out ==
          "id,outcome,lattice,atom,cell1,cell2,time\n"
          "a,hit,0,0,1,0,0.25\nb,error,,,,,\nc,error,,,,,\nd,error,,,,,\n"
          "e,later,,,,,\n");  // the limit is the time
    CHECK(lines(run.err) == 3);
    CHECK(contains(run.err, "q.csv:3: v is zero"));
    CHECK(contains(run.err, "q.csv:4: column x2: \"zero\" is not a number"));
    CHECK(contains(run.err, "q.csv:5: from names lattice 7, which the scene does not have"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Run npy = folder.lorentz("first-hit --scene square --radius 0.25 --format npy -e " + engine + " " +
                                   folder.write("q.npy", npy_rows({{0.5, 0, 1, 0, kNoLimit},
                                                                   {nan, 0, 1, 0, 1},
                                                                   {0.5, 0, 1, 0, -1},
                                                                   {0.5, 0, 1, 0, nan},
                                                                   {0.5, 0, 1, 0, 0.25}})));
    CHECK(npy.status == 2);
    CHECK(lines(npy.err) == 3);
    CHECK(contains(npy.err, "q.npy: row 1: x is not finite"));
    CHECK(contains(npy.err, "q.npy: row 2: max_time must be above zero"));
    CHECK(contains(npy.err, "q.npy: row 3: max_time"));
    const std::string data = npy_data(npy.out);
    for (const int row : {1, 2, 3}) CHECK(data.substr(35 * row, 3) == std::string("\5\xff\0", 3));
    CHECK((data[0] == 0 && data[35 * 4] == 3));
  }
  std::string many = "x1,x2,v1,v2\n";
  for (int i = 0; i < 25; ++i) many += "0,0,0,0\n";
  const Run run = folder.lorentz("first-hit --scene square --format csv " + folder.write("many", many));
  CHECK(lines(run.err) == 21);
  CHECK(contains(run.err, "many: 5 more bad rows"));
}

TEST_CASE("Columns: a file that ends too early has the answers to its rows, and is bad input",
          "[cli][columns]") {
  const Folder folder;
  const std::string whole = npy_rows({{0.5, 0, 1, 0}, {0.5, 0.5, 1, 0}, {0, 0, 1, 0}});
  const auto queries = folder.write("q.npy", whole.substr(0, whole.size() - 5));
  const Run run = folder.lorentz("first-hit --scene square --radius 0.25 --format npy " + queries);
  CHECK(run.status == 2);
  CHECK(contains(run.err, "q.npy: ends too early: 1 of 3 rows are missing"));
  CHECK(npy_data(run.out).size() == 2 * 35);
  const Run longer = folder.lorentz("first-hit --scene square --radius 0.25 --format npy " +
                                    folder.write("l.npy", whole + "more"));
  CHECK(longer.status == 0);
  CHECK(contains(longer.err, "l.npy: there is more behind the last row"));
  CHECK(npy_data(longer.out).size() == 3 * 35);
  // A terminal whose other end is gone gives what it has, and then an error.
  int ours = 0, other = 0;
  REQUIRE(openpty(&ours, &other, nullptr, nullptr, nullptr) == 0);
  REQUIRE(write(other, "x1,x2,v1,v2\n0.5,0,1,0\n", 23) == 23);
  close(other);
  const Run broken =
      folder.lorentz("first-hit --scene square --radius 0.25 --format csv <&" + std::to_string(ours));
  close(ours);
  CHECK((broken.status == 3 && contains(broken.out, "\nhit,0,0,1,0,0.25\n")));
}

TEST_CASE("Columns: cells beyond 64 bits stand in CSV, and are errors in arrays", "[cli][columns]") {
  const Folder folder;
  const std::string command = "first-hit --scene square --radius 0.1 --format ";
  for (const std::string engine : {"oracle", "certified", "certified-batch"}) {
    const Run csv = folder.lorentz(command + "csv -e " + engine + " " +
                                   folder.write("q.csv", "x1,x2,v1,v2\n0,0.445,1,1e-20\n0,0.445,1,0\n"));
    CHECK(csv.out ==
          "outcome,lattice,atom,cell1,cell2,time\nhit,0,0,45500000000000001275,1,4.55e+19\nnever,,,,,\n");
    const Run npy = folder.lorentz(command + "npy -e " + engine + " " +
                                   folder.write("q.npy", npy_rows({{0, 0.445, 1, 1e-20}, {0, 0.445, 1, 0}})));
    CHECK(npy.status == 0);
    CHECK(npy_data(npy.out)[0] == 5);
    CHECK(npy_data(npy.out)[35] == 1);
    CHECK(contains(
        npy.err,
        "q.npy: row 0: the cell of the answer, (45500000000000001275, 1), does not fit the 64 bits"));
  }
}

TEST_CASE("Columns: what the options ask for, and invalid files", "[cli][columns]") {
  const Folder folder;
  const auto csv = folder.write("q.csv", "x1,x2,v1,v2\n0.5,0,1,0\n");
  const auto npy = folder.write("q.npy", npy_rows({{0.5, 0, 1, 0}}));
  const auto says = [&](const std::string& arguments, int status, const std::string& what) {
    const Run run = folder.lorentz("first-hit " + arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.status == status);
    CHECK(contains(run.err, what));
  };
  says("--format cvs --scene square " + csv, 2,
       "--format: \"cvs\" is not one of ndjson, csv, npy (did you mean csv?)");
  says("--format csv " + csv, 2, "--format csv: needs --scene");
  says("--format csv --scene square --digits 20 " + csv, 2, "--digits: only streams in JSON");
  says("--format csv --scene square --v 0,1 " + csv, 2, "--x and --v: ask one query, without columns");
  says("--format npy --scene square --detail " + npy, 2, "--detail: only streams in JSON");
  says("--format npy --scene square -e cmd:true " + npy, 2, "not with cmd: engines and libraries");
  says("--format npy --scene square -e nobody " + npy, 2, "no engine is called");
  says("--format csv --scene square --jobs 2 " + csv, 2,
       "--jobs: only the engines batch, certified-batch and gpu");
  says("--format csv --scene square -e batch --jobs 0 " + csv, 2, "--jobs: \"0\" is not a whole number");
  says("--format csv --scene square " + npy, 2, "--format npy");
  says("--format npy --scene square " + csv, 2, "is no .npy file");
  says("--format npy --scene cubic " + npy, 2, "in d = 3 dimensions queries are float64 of shape (N, 2 d)");
  says("--format csv --scene cubic " + csv, 2, "there is no column x3");
  for (const std::string format : {"csv", "npy"}) {
    says("--scene square --format " + format + " " + folder.write("e", ""), 2, "e: is empty");
    says("--scene square --format " + format + " < /dev/null", 2, "standard input: is empty");
    says("--scene square --format " + format + " /tmp", 3, "is a directory");
    says("--scene square --format " + format + " /no/such/file", 3, "/no/such/file");
  }
  const auto unknown = folder.write("u.csv", "x1,x2,v1,v2,max_tiem\n0.5,0,1,0,1\n");
  says("--format csv --scene square " + unknown, 0,
       "warning: " + unknown + ":1: the column \"max_tiem\" is not known (did you mean max_time?), and is");
  says("--format csv --strict --scene square " + unknown, 2, "u.csv:1: the column \"max_tiem\" is not known");
  CHECK(lines(folder.lorentz("first-hit --format csv --strict --scene square " + unknown).out) == 0);
  const std::string full = "first-hit --scene square --format npy " + npy + " >/dev/full 2>/dev/null";
  CHECK(WEXITSTATUS(std::system((std::string(LORENTZ_PROGRAM) + " " + full).c_str())) == 3);
}

TEST_CASE("Columns from a pipe that pauses are answered meanwhile", "[cli][columns]") {
  const Folder folder;
  const std::string csv = "x1,x2,v1,v2\n0.5,0,1,0\n0.5,0.5,1,0\n",
                    npy = npy_rows({{0.5, 0, 1, 0}, {0.5, 0.5, 1, 0}});
  for (const auto& [format, two] : {std::pair{"csv", csv}, {"npy", npy}}) {
    const std::string command =
        LORENTZ_PROGRAM " first-hit --scene square --radius 0.25 --format " + std::string(format);
    const std::string expected = folder.run(command + " " + folder.write("two", two)).out;
    CHECK(lines(expected) > 0);
    // After two rows nothing comes until they are answered; or for 20 seconds.
    folder.run("{ cat " + folder.file("two") + "; for i in $(seq 200); do sleep 0.1; [ $(wc -c < " +
               folder.file("answers") + ") -ge " + std::to_string(expected.size()) +
               " ] && break; done; cp " + folder.file("answers") + " " + folder.file("early") + "; } | " +
               command + " > " + folder.file("answers") + "; true");
    INFO(format);
    CHECK((folder.read("early") == expected));
  }
}
