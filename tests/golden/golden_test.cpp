// Golden records and sets: written and read, made and verified, and each kind of tampering named.
#include <catch2/catch.hpp>

#include <lorentz/certificate_check.hpp>
#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using golden::Record;

namespace {

constexpr std::uint64_t kSeed = 7001;

// One disc of radius 1/4 a unit cell.
const Scene kSquare = unit_scene(2, 0.25);

GoldenCase hit_case() {
  return golden_case(kSquare, {{0.5, 0.125}, {1, 0.03125}, ObstacleId{0, 0, {0, 0, 0}}});
}
GoldenCase long_case() {
  return golden_case(unit_scene(3, 0x1p-10), {{0.5, 0.25, 0.125}, {0.71, 0.313, 0.877}, {}});
}
GoldenCase inside_case() {
  return golden_case(kSquare, {{0.125, 0}, {1, 0.5}, {}});
}
GoldenCase never_case() {
  return golden_case(kSquare, {{0.5, 0.5}, {1, 0}, {}});
}

std::vector<golden::ReadRecord> read_all(const std::string& path) {
  golden::Reader reader(path);
  std::vector<golden::ReadRecord> all;
  for (golden::ReadRecord read; reader.next(read);) all.push_back(read);
  return all;
}

// What a record of another program might hold, and ours must be able to write: sizes, ends and cells beyond
// what a flight here meets.
std::vector<GoldenCase> odd_cases() {
  std::vector<GoldenCase> cases{hit_case(), inside_case(), never_case(), long_case()};
  GoldenCase far = hit_case();
  far.query->from.reset();
  far.record.question = golden::question_of(*far.query, 2);
  far.record.expect.obstacle.cell = {*Integer::from_decimal("-123456789012345678901234567890"),
                                     Integer(std::int64_t{1} << 53), 0};
  far.record.expect.time = INFINITY;
  far.record.expect.time_decimal = "2.834968051720322701504158358630275386392e+319";
  far.record.margin = 0;
  far.record.condition = std::numeric_limits<double>::max();
  auto& window = far.record.certificate->windows.front();
  window.from = oracle::WindowEnd(Integer(-3), -1200);
  window.to = oracle::WindowEnd(*Integer::from_decimal("98765432109876543210987654321"), 1100);
  window.basis[0][1] = *Integer::from_decimal("9007199254740993");
  window.basis[1][0] = *Integer::from_decimal("-98765432109876543210987654321");
  cases.push_back(far);
  window.from = -0x1.23456789abcdep-1074;
  window.to = 0x1.fffffffffffffp1023;
  far.record.margin = 0x1p20;
  far.record.condition = 0x1.5p-3;
  // Brackets in a text are not nested, also behind a quotation mark.
  far.record.tags = {"drawn", "drawn \"\\\n\t, too", "no],\"end", '"' + std::string(2000, '[')};
  cases.push_back(far);
  cases.push_back(far);
  return cases;
}

void require_same(const Record& a, const Record& b) {
  CHECK(a.id == b.id);
  CHECK(a.tags == b.tags);
  CHECK(a.question == b.question);
  CHECK(a.expect.outcome == b.expect.outcome);
  CHECK(a.expect.obstacle == b.expect.obstacle);
  CHECK(a.expect.time == b.expect.time);
  CHECK(a.expect.exit_time == b.expect.exit_time);
  CHECK(a.expect.time_decimal == b.expect.time_decimal);
  CHECK(a.expect.message == b.expect.message);
  CHECK(a.margin == b.margin);
  CHECK(a.condition == b.condition);
  REQUIRE(a.certificate.has_value() == b.certificate.has_value());
  if (!a.certificate) return;
  REQUIRE(a.certificate->windows.size() == b.certificate->windows.size());
  REQUIRE(a.certificate->rows.size() == b.certificate->rows.size());
  for (std::size_t i = 0; i < a.certificate->windows.size(); ++i) {
    const oracle::Window &one = a.certificate->windows[i], &two = b.certificate->windows[i];
    CHECK(std::tie(one.lattice, one.atom) == std::tie(two.lattice, two.atom));
    CHECK(one.basis == two.basis);
    for (const auto end : {&oracle::Window::from, &oracle::Window::to}) {
      const auto value = oracle::binary64_of(one.*end);
      CHECK(value == oracle::binary64_of(two.*end));
      if (!value) CHECK(oracle::text_of(one.*end) == oracle::text_of(two.*end));
    }
  }
  for (std::size_t i = 0; i < a.certificate->rows.size(); ++i) {
    const oracle::Rows &one = a.certificate->rows[i], &two = b.certificate->rows[i];
    CHECK(std::tie(one.lattice, one.atom) == std::tie(two.lattice, two.atom));
    CHECK(one.basis == two.basis);
  }
}

// Written and read again: the same record, and the same line.
void require_read_back(const Folder& folder, const std::vector<GoldenCase>& cases) {
  const std::string path = folder.write("set", set_of(cases));
  golden::Reader reader(path);
  CHECK(reader.header().count == cases.size());
  golden::ReadRecord read;
  std::size_t line = 1;
  for (const GoldenCase& c : cases) {
    REQUIRE(reader.next(read));
    const std::string text = record_line(c.record, c.scene);
    INFO(text);
    CHECK(read.line == (line += 2));
    CHECK(read.text + '\n' == text);
    CHECK(record_line(read.record, c.scene) == text);
    require_same(read.record, c.record);
    REQUIRE(read.query.has_value() == c.query.has_value());
    CHECK(read.flaw.empty() == c.query.has_value());
    if (c.query) CHECK(stream(reader.scene(), *read.query) == stream(c.scene, *c.query));
  }
  CHECK_FALSE(reader.next(read));
}

}  // namespace

TEST_CASE("Golden: what is written is read back, whatever the record holds", "[golden]") {
  const Folder folder;
  require_read_back(folder, odd_cases());
  for (const golden::Set& set : golden::sets()) {
    std::vector<GoldenCase> cases;
    for (std::uint64_t index = 0; index < 40; index += 3) cases.push_back(golden_case(set, kSeed, index));
    INFO(set.name << ", seed " << kSeed);
    require_read_back(folder, cases);
  }
}

TEST_CASE("Golden: a key that comes twice is refused, wherever it is, and so is text behind a line",
          "[golden]") {
  const Folder folder;
  const std::string good = set_of({hit_case()});
  REQUIRE(read_all(folder.write("set", good)).size() == 1);
  const auto hold = [&](const char* old, const std::string& replacement, const std::string& complaint) {
    INFO(replacement);
    CHECK_THROWS_WITH(read_all(folder.write("set", replaced(good, old, replacement))),
                      Catch::Contains(complaint));
  };
  const std::string second = " comes twice in an object";
  hold("\"tags\":[", R"("tags":["other"],"tags":[)", "set:3: the key \"tags\"" + second);
  hold(",\"margin\"", R"(,"margin":1,"margin")", "set:3: the key \"margin\"" + second);
  hold(",\"margin\"", R"(,"more":{"a":[{"b":0,"\u0062":0}]},"margin")", "set:3: the key \"b\"" + second);
  hold("\"windows\":", R"("windows":[],"windows":)", "set:3: the key \"windows\"" + second);
  hold("\"windows\":[{", R"("windows":[{"atom":0,)", "set:3: the key \"atom\"" + second);
  hold("\"expect\":{", R"("expect":{"outcome":"never",)", "set:3: the key \"outcome\"" + second);
  hold("\"scene\":{", R"("scene":{"dimension":2,)", "set:2: the key \"dimension\"" + second);
  hold("{\"golden\":{", R"({"golden":{"format":1,)", "set:1: the key \"format\"" + second);
  hold("{\"golden\":{", R"({"golden":{},"golden":{)", "set:1: the key \"golden\"" + second);
  hold("\n", " {}\n", "set:1: not JSON: more than one value");
  CHECK_THROWS_WITH(read_all(folder.write("set", good.substr(0, good.size() - 1) + " 1\n")),
                    Catch::Contains("set:3: not JSON"));
}

TEST_CASE("Golden: long keys and numbers fit wherever they are", "[golden]") {
  const Folder folder;
  const std::string good = set_of({hit_case()}), longer(3'000'000, '0');
  for (const std::string& text :
       {replaced(good, "\"expect\":{", "\"expect\":{\"" + longer + "\":1,"),
        replaced(good, "\"margin\":", "\"margin\":\"0x" + longer + "1\",\"more\":")}) {
    const auto records = read_all(folder.write("set", text));
    REQUIRE(records.size() == 1);
    CHECK(records[0].record.expect.outcome == Outcome::hit);
  }
}

TEST_CASE("Golden: the header is read back", "[golden]") {
  const Folder folder;
  const golden::Header header{.format = GENERATE(1, 2),
                              .name = "a name",
                              .description = "a \"description\"\n",
                              .generator = "lorentz golden make",
                              .version = "1.2.3",
                              .count = 12'345'678'901,
                              .tags = {{"one", "first"}, {"two", "\\second"}},
                              .precision = GENERATE(NumberFormat::binary64, NumberFormat::binary32)};
  std::string text;
  golden::append_header_line(text, header);
  const golden::Header read = golden::Reader(folder.write("set", text)).header();
  CHECK(read.format == header.format);
  CHECK(read.name == header.name);
  CHECK(read.description == header.description);
  CHECK(read.generator == header.generator);
  CHECK(read.version == header.version);
  CHECK(read.count == header.count);
  CHECK(read.tags == header.tags);
  CHECK(read.precision == header.precision);
  CHECK(contains(text, "precision") == (header.precision == NumberFormat::binary32));
}

TEST_CASE("Golden: a file that is not a set is refused with the line's number", "[golden]") {
  const Folder folder;
  const std::string good = set_of({hit_case(), inside_case()});
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      read_all(folder.write("set", text));
      return "";
    } catch (const InputError& error) {
      const std::string what = error.what();
      REQUIRE(what.starts_with(folder.file("set:")));
      return what.substr(folder.file("set:").size());
    }
  };
  CHECK(complaint(good) == "");
  CHECK(complaint(replaced(good, "\n", "\n\n")) == "");  // blank lines are skipped
  CHECK_THAT(complaint(""), Catch::Contains("is empty"));
  CHECK(complaint(good.substr(good.find('\n') + 1)).starts_with("1: a golden set begins with its header"));
  for (const char* other : {"\"format\":3", "\"format\":0"})
    CHECK(complaint(replaced(good, "\"format\":2", other)).starts_with("1: format: only formats 1 and 2"));
  CHECK(complaint(replaced(good, "\"count\":2", "\"count\":-2")).starts_with("1: count"));
  CHECK(complaint(replaced(good, "{\"scene\"", "{\"scenery\"")).starts_with("2: "));
  CHECK(complaint(replaced(good, "\"expect\"", "\"expected\"")).starts_with("3: the keys of a record stand"));
  CHECK(complaint(replaced(good, "\"outcome\":\"hit\"", "\"outcome\":\"hat\"")).starts_with("3: "));
  CHECK(complaint(replaced(good, "\"windows\":[{", "\"windows\":[[")).starts_with("3: "));
  CHECK(complaint(replaced(good, "\"windows\":[{", "\"panes\":[{")).starts_with("3: certificate: has neit"));
  CHECK(complaint(replaced(good, ",\"cell\":[1,0]", ",\"cell\":[1,0,0]")).starts_with("3: "));
  CHECK(complaint(replaced(good, "\"to\":", "\"to\":\"0x1p\",\"t\":"))
            .starts_with("3: to: is neither a number nor a text"));
  CHECK(complaint(replaced(good, "\"margin\":", "\"margin\":\"much\",\"m\":")).starts_with("3: margin"));
  CHECK(complaint(good.substr(0, good.size() - 9)).starts_with("5: not JSON"));
  // No index that becomes another one in fewer bits.
  const std::string window = "\"windows\":[{\"lattice\":0,\"atom\":0";
  CHECK(complaint(replaced(good, window, "\"windows\":[{\"lattice\":4294967296,\"atom\":0"))
            .starts_with("3: lattice"));
  CHECK(complaint(replaced(good, window, "\"windows\":[{\"lattice\":0,\"atom\":4294967296"))
            .starts_with("3: atom"));
  // A record before any scene, also one that is bad for another reason.
  const auto scene = good.find('\n') + 1;
  const std::string no_scene = good.substr(0, scene) + good.substr(good.find('\n', scene) + 1);
  CHECK_THAT(complaint(no_scene), Catch::Contains("2: no scene"));
  CHECK_THAT(complaint(replaced(no_scene, "\"x\":[0.5,0.125]", "\"x\":null")),
             Catch::Contains("2: no scene"));
}

TEST_CASE("Golden: a basis has as many vectors and components as the lattice", "[golden]") {
  const Folder folder;
  const GoldenCase in_space =
      golden_case(unit_scene(3, 0.25), {{0.5, 0.125, 0.125}, {1, 0.03125, 0.0625}, {}});
  for (const GoldenCase& c : {hit_case(), in_space}) {
    const int dimension = c.scene.dimension;
    const std::string good = set_of({c});
    const std::size_t begin = good.find("\"basis\":") + 8, end = good.find("]]", begin) + 2;
    const auto read_with = [&](int rows, int longest, int components) {
      std::string basis;
      for (int i = 0; i < rows; ++i) {
        basis += i == 0 ? "[" : ",[";
        for (int k = 0; k < (i == longest ? components : dimension); ++k) basis += k == 0 ? "0" : ",0";
        basis += ']';
      }
      return read_all(folder.write("set", good.substr(0, begin) + '[' + basis + ']' + good.substr(end)));
    };
    CHECK(read_with(dimension, 0, dimension).size() == 1);
    for (int count = 0; count <= 6; ++count) {
      if (count == dimension) continue;
      INFO(count << " for " << dimension);
      const auto complaint = [&](const std::string& what) {
        return Catch::EndsWith(count > 3 ? "basis: has more than 3 " + what
                                         : "basis: has " + std::to_string(count) + " " + what +
                                               " where the lattice has " + std::to_string(dimension));
      };
      CHECK_THROWS_WITH(read_with(count, -1, 0), complaint("vectors"));
      for (int row = 0; row < dimension; ++row)
        CHECK_THROWS_WITH(read_with(dimension, row, count), complaint("components"));
    }
  }
}

TEST_CASE("Golden: a header has a format, a count and tags", "[golden]") {
  const Folder folder;
  const std::string tags = ",\"tags\":" + between(set_of({}), ",\"tags\":", "}}") + "}";
  for (const std::string& part : {std::string("\"format\":2,"), std::string("\"count\":0,"), tags})
    CHECK_THROWS_WITH(read_all(folder.write("set", replaced(set_of({}), part, ""))),
                      Catch::EndsWith("set:1: the header needs format, count and tags"));
  CHECK(read_all(folder.write("set", set_of({}))).empty());
}

TEST_CASE("Golden: ids are the beginning of a SHA-256 of scene and question", "[golden]") {
  CHECK(golden::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(golden::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  // python3 -c 'import hashlib; print(hashlib.sha256(b"SCENE LINE\nQUESTION").hexdigest()[:16])'
  GoldenCase c = hit_case();
  CHECK(c.record.question == R"("x":[0.5,0.125],"v":[1,0.03125],"from":{"lattice":0,"atom":0,"cell":[0,0]})");
  CHECK(c.record.id == "6c80ee066492e0e7");
  CHECK(inside_case().record.id == "7b96c59001ea4c7a");
  const std::string id = c.record.id;
  c.record.tags = {"other", "tags"};
  c.record.expect = Answer::never();
  CHECK(golden::id_of(golden::Maker(c.scene).scene_line(), c.record.question) == id);
  CHECK(golden::id_of(golden::Maker(unit_scene(2, 0.2)).scene_line(), c.record.question) != id);
}

TEST_CASE("Golden: a second opinion that differs in anything stops the maker, and the verifier", "[golden]") {
  const Query query{{0.5, 0.125}, {1, 0.03125}, {}};
  const std::string text = golden::question_of(query, 2);
  const golden::Maker honest(kSquare);
  const golden::MadeRecord made = honest.make(text, query);
  REQUIRE(made.walked);
  REQUIRE(made.record.expect.outcome == Outcome::hit);
  using Change = std::function<void(Answer&)>;
  const std::vector<Change> changes{[](Answer& a) { a.time = std::nextafter(*a.time, 9); },
                                    [](Answer& a) { a.obstacle.cell[0] = 7; },
                                    [](Answer& a) { a.obstacle.cell[1] = 7; },
                                    [](Answer& a) { a.obstacle.atom = 1; },
                                    [](Answer& a) { a.obstacle.lattice = 1; },
                                    [](Answer& a) { a = Answer::never(); },
                                    [](Answer& a) { a = Answer::inside(a.obstacle); },
                                    [](Answer& a) { a.time.reset(); }};
  for (const Change& change : changes) {
    golden::Others others;
    others.walk = [&](const Query&) {
      Answer walked = made.record.expect;
      change(walked);
      return walked;
    };
    const golden::Maker maker(kSquare, others);
    CHECK_THROWS_WITH(maker.make(text, query), Catch::StartsWith("walk does not agree"));
    CHECK(maker.flaw_of(made.record, query, true) == "walk says otherwise");
    CHECK_FALSE(maker.flaw_of(made.record, query, false));
  }
  // Where it cannot go it says nothing against the record, and does not count.
  golden::Others lost;
  lost.walk = [](const Query&) { return Answer::undecided(); };
  const golden::Maker alone(kSquare, lost);
  CHECK_FALSE(alone.make(text, query).walked);
  CHECK_FALSE(alone.flaw_of(made.record, query, true));
  // A prover whose proof is of something else.
  golden::Others careless;
  careless.prove = [&](const Query&, const Answer&) { return *honest.make(text, query).record.certificate; };
  const Query farther{{0.5, 0.5}, {1, 0.03125}, {}};
  CHECK_THROWS_WITH(golden::Maker(kSquare, careless).make(golden::question_of(farther, 2), farther),
                    Catch::StartsWith("the check of the certificate ("));
}

TEST_CASE("Golden: made records are proved, and nothing is wrong with them", "[golden]") {
  for (const golden::Set& set : golden::sets()) {
    int walked = 0;
    for (std::uint64_t index = 0; index < std::min<std::uint64_t>(set.most, 160); index += 3) {
      const golden::SetQuestion question = set.question(kSeed, index);
      const golden::Maker maker(question.scene, golden::Others{}, set.precision);
      const golden::MadeRecord made = maker.make(question.text, question.query);
      const Record& record = made.record;
      INFO(set.name << ", seed " << kSeed << ", index " << index << "\n"
                    << maker.scene_line() << "\n"
                    << record_line(record, question.scene));
      walked += made.walked;
      CHECK(record.id == golden::id_of(maker.scene_line(), question.text));
      CHECK(maker.flaw_of(record, question.query, index % 8 == 0).value_or("") == "");
      const bool hit = record.expect.outcome == Outcome::hit;
      CHECK(record.condition.has_value() == hit);
      const bool missed =
          record.expect.outcome == Outcome::never &&  // of which there is a nearest one
          std::all_of(question.scene.lattices.begin(), question.scene.lattices.end(),
                      [&](const Lattice& lattice) { return lattice.rank < question.scene.dimension; });
      CHECK(record.margin.has_value() == (hit || missed || record.expect.outcome == Outcome::inside));
      CHECK((!record.margin || (*record.margin >= 0 && *record.margin <= 0x1p20)));
      CHECK(record.certificate.has_value() == question.query.has_value());
      if (record.certificate)
        CHECK(oracle::CertificateCheck(question.scene)
                  .refutation(*question.query, record.expect, *record.certificate)
                  .value_or("") == "");
    }
    INFO(set.name);
    if (set.family != "tiny-radius")  // flights too long for walk, nearly all
      CHECK((walked > 0) == (set.name != "bad-queries"));
  }
}

TEST_CASE("Golden: a record whose numbers are computed by hand", "[golden]") {
  // From (1/2, 1/8) along x to the disc of radius 1/4 around (1, 0): it is entered at t = 1/2 - sqrt(3)/8,
  // where the normal is (-sqrt(3), 1) / 2. The line passes its centre at 1/8, so is 1/8 from missing it, and
  // an ulp each in x (that of the cell, 2^-52) and r (2^-54) makes 1.25 2^-52 of that: far more than 2^20.
  const GoldenCase c = golden_case(kSquare, {{0.5, 0.125}, {1, 0}, {}});
  CHECK(c.record.expect.obstacle == ObstacleId{0, 0, {1, 0, 0}});
  CHECK(c.record.expect.time_decimal == "0.2834936490538903383090692073117659541321");
  CHECK(c.record.margin == 0x1p20);
  // dt = dx_1 - tan dx_2 - t dv_1 + dr / cos in ulps: 2^-52 (1 + 1/sqrt(3) + t + 1/(2 sqrt(3))), ulp(t)
  // 2^-54.
  const double root = std::sqrt(3), time = 0.5 - root / 8;
  CHECK(c.record.condition.value() == Approx(4 * (1 + 1 / root + time) + 2 / root).epsilon(1e-12));
  // 4 ulps of the cell below the edge of that disc: 4 / 1.25 ulps of margin.
  const GoldenCase edge = golden_case(kSquare, {{0.5, 0.25 - 0x1p-50}, {1, 0}, {}});
  CHECK(edge.record.margin.value() == Approx(3.2).epsilon(1e-12));
}

namespace {

using Edit = std::function<void(Record&)>;

std::string flaw_after(GoldenCase c, const Edit& edit) {
  edit(c.record);
  return flaw(c);
}

// Each edit makes a flaw, and what is said of it holds these words.
void require_flaws(const GoldenCase& c, const std::vector<std::pair<std::string, Edit>>& edits) {
  REQUIRE(flaw(c) == "");
  for (const auto& [expected, edit] : edits) {
    INFO(record_line(c.record, c.scene));
    const std::string said = flaw_after(c, edit);
    CHECK(said != "");
    CHECK_THAT(said, Catch::Contains(expected) && !Catch::Contains("\n"));
  }
}

// The number `steps` ulps away.
double stepped(double value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, INFINITY);
  for (; steps < 0; ++steps) value = std::nextafter(value, -INFINITY);
  return value;
}

}  // namespace

TEST_CASE("Golden: each kind of tampering with a hit is named", "[golden]") {
  for (const GoldenCase& c : {hit_case(), long_case()}) {
    const std::size_t digit = c.record.expect.time_decimal.size() - 1;
    const char other = c.record.expect.time_decimal[digit] == '5' ? '6' : '5';
    require_flaws(
        c, {{"the id", [](Record& r) { r.id[3] = r.id[3] == '0' ? '1' : '0'; }},
            {"the id", [](Record& r) { r.id += "0"; }},
            {"the id", [](Record& r) { r.question += " "; }},
            {"not met", [](Record& r) { r.expect.obstacle.cell[1] = 5; }},
            {"", [](Record& r) { r.expect.obstacle.lattice = 1; }},
            {"time", [](Record& r) { r.expect.time = stepped(*r.expect.time, 1); }},
            {"time", [](Record& r) { r.expect.time = stepped(*r.expect.time, -1); }},
            {"time", [](Record& r) { r.expect.time.reset(); }},
            {"decimal", [&](Record& r) { r.expect.time_decimal[digit] = other; }},
            {"no time_decimal", [](Record& r) { r.expect.time_decimal.clear(); }},
            {"has not 40 digits", [](Record& r) { r.expect.time_decimal.pop_back(); }},
            {"has not 40 digits", [](Record& r) { r.expect.time_decimal += "0"; }},
            {"margin", [](Record& r) { r.margin = stepped(*r.margin, -1); }},
            {"condition", [](Record& r) { r.condition = stepped(*r.condition, 1); }},
            {"time_change", [](Record& r) { r.time_change = stepped(*r.time_change, 1); }},
            {"comment", [](Record& r) { r.comment += "?"; }},
            {"no certificate", [](Record& r) { r.certificate.reset(); }},
            {"window", [](Record& r) { r.certificate->windows.clear(); }},
            {"window", [](Record& r) { r.certificate->windows.erase(r.certificate->windows.begin()); }},
            {"window", [](Record& r) { r.certificate->windows.back().to = 0.0; }},
            {"window", [](Record& r) { r.certificate->windows.front().from = 0.0; }},
            {"", [](Record& r) { r.certificate->windows.front().atom = 1; }},
            {"basis",
             [](Record& r) {
               r.certificate->windows.front().basis[0] = {2, 2, 0};
             }},
            {"never", [](Record& r) { r.expect = Answer::never(); }},
            {"", [](Record& r) { r.expect = Answer::inside(r.expect.obstacle); }},
            {"is a query", [](Record& r) {
               r = {.id = r.id, .tags = r.tags, .question = r.question, .expect = Answer::error("no query")};
             }}});
  }
}

TEST_CASE("Golden: records of one single obstacle, and no others, say when it is left", "[golden]") {
  Scene ball = unit_scene(3, 0.25);
  ball.lattices[0].rank = 0, ball.lattices[0].vectors = {};
  const GoldenCase hit = golden_case(ball, {{-1, 0.125, 0}, {1, 0, 0.03125}, {}}),
                   inside = golden_case(ball, {{0.125, 0, 0}, {1, 0.5, 0}, {}}),
                   graze = golden_case(ball, {{-1, 0.25 - 0x1p-54, 0}, {1, 0, 0}, {}});
  for (const GoldenCase& c : {hit, inside, graze}) {
    REQUIRE(c.record.expect.exit_time);
    const std::string no_exit = "is not left at the exit_time given";
    require_flaws(c, {{no_exit, [](Record& r) { r.expect.exit_time = stepped(*r.expect.exit_time, 1); }},
                      {no_exit, [](Record& r) { r.expect.exit_time = stepped(*r.expect.exit_time, -1); }},
                      {no_exit, [](Record& r) { r.expect.exit_time = -*r.expect.exit_time; }},
                      {no_exit, [](Record& r) { r.expect.exit_time = r.expect.time.value_or(0); }}});
    GoldenCase without = c;
    without.record.expect.exit_time.reset();
    CHECK(flaw(without) == "");
  }
  CHECK(*hit.record.expect.time < *hit.record.expect.exit_time);
  CHECK_FALSE(golden_case(ball, {{-1, 0.25, 0}, {1, 0, 0}, {}}).record.expect.exit_time);
  Scene two = ball;
  two.lattices[0].atoms.push_back({{9, 9, 9}, 0.25});
  CHECK_FALSE(golden_case(two, *hit.query).record.expect.exit_time);
  CHECK_FALSE(hit_case().record.expect.exit_time);
}

TEST_CASE("Golden: each kind of tampering with inside, never and an error is named", "[golden]") {
  require_flaws(inside_case(), {{"", [](Record& r) { r.expect.obstacle.cell[0] = 1; }},
                                {"margin", [](Record& r) { r.margin = 17; }},
                                {"condition", [](Record& r) { r.condition = 1; }},
                                {"hits nothing", [](Record& r) { r.expect.time_decimal = "0"; }},
                                {"window", [](Record& r) { r.certificate->windows.clear(); }},
                                {"", [](Record& r) { r.expect = Answer::hit(r.expect.obstacle, 0); }}});
  require_flaws(
      never_case(),
      {{"margin", [](Record& r) { r.margin = 17; }},
       {"condition", [](Record& r) { r.condition = 1; }},
       {"hits nothing", [](Record& r) { r.expect.time_decimal = "5"; }},
       {"", [](Record& r) { r.certificate->rows.clear(); }},
       {"", [](Record& r) { std::swap(r.certificate->rows[0].basis[0], r.certificate->rows[0].basis[1]); }},
       {"", [](Record& r) { r.expect = Answer::hit({}, 1); }}});
  require_flaws(golden_case(*golden::set_named("bad-queries"), kSeed, 0),
                {{"no margin", [](Record& r) { r.margin = 17; }},
                 {"no margin", [](Record& r) { r.condition = 17; }},
                 {"no margin", [](Record& r) { r.certificate.emplace(); }},
                 {"hits nothing", [](Record& r) { r.expect.time_decimal = "5"; }},
                 {"not a query", [](Record& r) { r.expect = Answer::never(); }},
                 {"the id", [](Record& r) { r.question += " "; }}});
}

TEST_CASE("Golden: each kind of tampering with acceptable answers is named", "[golden]") {
  const GoldenCase listed = golden_case(kSquare, {{0.25, 0}, {-1, 0.5}, {}});
  REQUIRE(listed.record.acceptable.size() == 1);
  require_flaws(listed, {{"acceptable", [](Record& r) { r.acceptable.clear(); }},
                         {"acceptable", [](Record& r) { r.acceptable[0].ulps = 1; }},
                         {"acceptable", [](Record& r) { r.acceptable[0].answer = Answer::never(); }},
                         {"acceptable", [](Record& r) { r.acceptable[0].answer.obstacle.cell[0] = 1; }},
                         {"acceptable", [](Record& r) { r.acceptable.push_back(r.acceptable[0]); }}});
  require_flaws(hit_case(), {{"acceptable", [](Record& r) { r.tags.push_back(golden::kNeedsJudge); }},
                             {"acceptable", [](Record& r) {
                                r.acceptable.push_back({Answer::never(), 3});
                              }}});
  const GoldenCase endless =
      golden_case(unit_scene(3, 0.25), {{0.25 + 0x1p-53, 0.5, 0.5}, {0, -1, 5e-324}, {}});
  REQUIRE(golden::needs_judge(endless.record));
  Scene beside_row = unit_scene(3, 0.4);  // a layer, and a row that the flight runs along for ever
  beside_row.lattices.resize(2, beside_row.lattices[0]);
  beside_row.lattices[0].rank = 2, beside_row.lattices[0].vectors[2] = {};
  beside_row.lattices[1].rank = 1, beside_row.lattices[1].vectors = {Vec{0, 0, 1}};
  beside_row.lattices[1].atoms[0].radius = 0.01;
  CHECK(golden::needs_judge(golden_case(beside_row, {{7e15, 7e15, 7e15}, {0, 0, -1}, {}}).record));
  require_flaws(endless, {{"acceptable", [](Record& r) { std::erase(r.tags, golden::kNeedsJudge); }}});
}

TEST_CASE("Golden: all of a record's question is what its id is made from", "[golden]") {
  const Folder folder;
  const std::string good = set_of({golden_case(kSquare, {{0.5, 0.125}, {1, 0.03125}, {}})});
  REQUIRE(read_all(folder.write("set", good)).size() == 1);
  const auto refused = [&](const std::string& text, const char* why = "the keys of a record stand") {
    CHECK_THROWS_WITH(read_all(folder.write("set", text)), Catch::Contains(std::string("set:3: ") + why));
  };
  const std::string from = R"("from":{"lattice":0,"atom":0,"cell":[9,9]})";
  refused(good.substr(0, good.size() - 2) + "," + from + "}\n");
  refused(good.substr(0, good.size() - 2) + ",\"x\":[0.5,0.25]}\n", "the key \"x\" comes twice");
  refused(good.substr(0, good.size() - 2) + ",\"v\":[1,0]}\n", "the key \"v\" comes twice");
  refused(replaced(good, "\"x\":[0.5,0.125],\"v\":[1,0.03125],\"expect\"", "\"expect\""));
  refused(replaced(good, "{\"id\"", "{" + from + ",\"id\""));
  refused(replaced(good, "\"x\":[0.5,0.125],\"v\":[1,0.03125],", ""));
  // The question ends where these words stand first: so they do not stand within it.
  const std::string more = R"("x":[0.5,0.125],"y":{"a":[1],"expect":{"outcome":"never"}},"v":[1,0.03125])";
  const std::string odd = replaced(good, R"("x":[0.5,0.125],"v":[1,0.03125])", more);
  refused(odd);
}
