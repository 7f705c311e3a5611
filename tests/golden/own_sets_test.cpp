// lorentz golden make: sets of one's own; and the smoke set.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

#include "judge/golden/index.hpp"
#include "judge/golden/maker.hpp"
#include "judge/golden/sets.hpp"
#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

TEST_CASE("The smoke set: in turn one of each tag of each set, that needs no judge", "[golden][own_sets]") {
  // Six tags besides needs-judge, of which some come first after hundreds of records.
  const std::string ties = golden::find_set("ties");
  const std::string text = golden::smoke_of({ties, ties}, 6, {.name = "few"});
  CHECK(text.starts_with(R"({"golden":{"format":2,"name":"few")"));
  CHECK_THAT(text, Catch::Contains(R"("count":6,)") && !Catch::Contains("needs-judge"));
  const std::string records = text.substr(text.find("{\"id\""));
  for (const char* tag :
       {"identical-atoms", "within-ulps", "mirrored", "overlapping-neighbours", "superposed", "shared-point"})
    CHECK_THAT(records, Catch::Contains(tag));
  // Each record once, and no more than there are.
  const std::string whole = golden::smoke_of({ties, ties}, 1'000'000, {.name = "all"});
  const Folder folder;
  golden::Reader all(folder.write("all", whole));
  std::set<std::string> ids;
  for (golden::ReadRecord read; all.next(read);) CHECK(ids.insert(read.record.id).second);
  CHECK((ids.size() == all.header().count && ids.size() > 300 && ids.size() < 640));
}

TEST_CASE("golden make: tags of each query, but those that the program gives itself", "[golden][own_sets]") {
  const Folder folder;
  const std::string scene = stream(unit_scene(2, 0.1), {{0.5, 0.3, 0}, {1, 0.3, 0}, {}});
  const std::string first = scene.substr(0, scene.find('\n') + 1);
  const auto made = [&](const std::string& lines) {
    return folder.lorentz("golden make --queries " + folder.write("queries", first + lines));
  };
  const Run run = made(R"({"x":[0.5,0.3],"v":[1,0.3],"tags":["alpha","grazing","needs-judge","mine"]}
{"tags":["beta","alpha"],"x":[0.5,0.4],"v":[1,0.3]}
{"x":[0.5,0.6],"v":[1,0.3]}
{"x":[0.5,0.3],"v":[1,0.3],"tags":["late"]}
{"x":[")"
                       "\x7f\u202e"
                       R"("],"v":[0,0],"tags":["gamma"]}
)");
  CHECK(run.status == 2);  // an invalid query
  for (const char* tags : {R"("tags":["alpha","mine","late","plain"])", R"("tags":["beta","alpha","plain"])",
                           R"("tags":["plain"])", R"("tags":["gamma","invalid"])"})
    CHECK_THAT(run.out, Catch::Contains(tags));
  CHECK_THAT(run.out, Catch::Contains(R"("beta":"given by the key tags of a query")"));
  CHECK_THAT(run.err, Catch::Contains("1 questions come more than once"));
  CHECK(folder.lorentz("golden verify " + folder.write("set", run.out)).status == 0);
  for (const char* bad : {R"("A b")", R"(7)", R"("")"}) {
    const Run refused = made(R"({"id":9,"x":[0.5,0.3],"v":[1,0.3],"tags":[)" + std::string(bad) + "]}\n");
    CHECK((refused.status == 2 && refused.out.empty()));
    CHECK_THAT(refused.err, Catch::Contains("query 9: tags: "));
  }
  CHECK(made(R"({"x":[0.5,0.3],"v":[1,0.3],"tags":"alpha"})").status == 2);
}

TEST_CASE("golden make --all leaves an index and sums of others as they are", "[golden][own_sets]") {
  const Folder folder;
  fs::create_directory(folder.file("sets"));
  for (const char* name : {"index.json", "SHA256SUMS"}) {
    folder.write(std::string("sets/") + name, "{\"mine\":1}");
    const Run run = folder.lorentz("golden make --all " + folder.file("sets"));
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, std::string(name) + ": was not written by this command"));
    CHECK(folder.read(std::string("sets/") + name) == "{\"mine\":1}");
    CHECK_FALSE(fs::exists(folder.file("sets/smoke")));
    fs::remove(folder.file(std::string("sets/") + name));
  }
}

TEST_CASE("The index of the committed sets is what the program makes of them", "[golden][own_sets]") {
  const std::string folder = LORENTZ_SOURCE_DIR "/data/golden";
  std::stringstream index;
  index << std::ifstream(folder + "/index.json").rdbuf();
  std::vector<std::string> names;  // in its order
  const std::string key = R"("file":")", text = index.str();
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at))
    at += key.size(), names.push_back(text.substr(at, text.find('"', at) - at));
  CHECK(names.size() > 30);
  CHECK(golden::index_of(folder, names) == text);
}

TEST_CASE("Sums are of all files beside a set, but of themselves, and of itineraries", "[golden][own_sets]") {
  const Folder folder;
  fs::create_directories(folder.file("sets/itineraries")), fs::create_directories(folder.file("sets/smoke"));
  folder.write("sets/itineraries/one.json", "1"), folder.write("sets/smoke/two", "2");
  REQUIRE(folder.lorentz("golden make --set ties --count 3 -o " + folder.file("sets/ties.ndjson")).status ==
          0);
  for (int i = 0; i < 2; ++i) golden::write_index(folder.file("sets"), {"ties.ndjson"});
  const std::string sums = folder.read("sets/SHA256SUMS");
  CHECK(std::ranges::count(sums, '\n') == 3);
  for (const char* name : {"  index.json\n", "  smoke/two\n", "  ties.ndjson\n"}) CHECK(contains(sums, name));
  CHECK(folder.run("cd " + folder.file("sets") + " && sha256sum --quiet --check SHA256SUMS").status == 0);
}

TEST_CASE("The index says how numbers are written", "[golden][own_sets]") {
  const Folder folder;
  const std::string scene =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[],"atoms":[{"position":[0,0],"radius":1}]}]}})";
  const auto notations = [&](const std::string& x) {
    const std::string query = "{\"id\":1,\"x\":[" + x + ",3],\"v\":[1,0]}\n";
    fs::remove(folder.file("mine.ndjson"));
    folder.lorentz("golden make --queries " + folder.write("q", scene + "\n" + query) + " -o " +
                   folder.file("mine.ndjson"));
    const std::string index = golden::index_of(folder.file(""), {"mine.ndjson"});
    return index.substr(index.find("\"notations\""), index.find("\"tags\"") - index.find("\"notations\""));
  };
  CHECK_FALSE(contains(notations("-4.5"), "exponent"));
  CHECK(contains(notations("-4.5e30"), "exponent"));
}

TEST_CASE("golden make sees small directions in space, and flights beyond 10^6 cells", "[golden][own_sets]") {
  const Scene cubic = unit_scene(3, 0.1), square = unit_scene(2, 0.1);
  const auto tags = [](const Scene& scene, const Query& query, const char* time) {
    Answer exact = Answer::hit({}, 0);
    exact.time_decimal = time;
    return golden::tags_seen(scene, query, exact, {});
  };
  using Tags = std::vector<std::string>;
  CHECK(tags(cubic, {{0.5, 0.5, 0.5}, {1, 2, 1}, {}}, "1") == Tags{"near-rational"});
  CHECK(tags(cubic, {{0.5, 0.5, 0.5}, {1, 2, 1.0001}, {}}, "1") == Tags{"plain"});
  Scene two = square;  // the direction is a vector of the second lattice
  two.lattices.push_back(two.lattices[0]);
  two.lattices[1].vectors[1] = {0, 1.4142135, 0};
  CHECK(tags(square, {{0.5, 0.5, 0}, {1, 1.4142135, 0}, {}}, "1") == Tags{"plain"});
  CHECK(tags(two, {{0.5, 0.5, 0}, {1, 1.4142135, 0}, {}}, "1") == Tags{"near-rational"});
  CHECK(tags(square, {{0.5, 0.5, 0}, {0, 1, 0}, {}}, "1000000") == Tags{"near-rational", "zero-component"});
  CHECK(tags(square, {{0.5, 0.5, 0}, {0, 1, 0}, {}}, "1000000.1") ==
        Tags{"near-rational", "zero-component", "far"});
}
