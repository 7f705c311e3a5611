// lorentz golden filter, index, make: sets of one's own, and what belongs beside them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

#include "judge/golden/find_sets.hpp"
#include "judge/golden/selection.hpp"
#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

TEST_CASE("golden filter keeps records as they are", "[golden][own_sets]") {
  const Folder folder;
  const auto made = [&](const std::string& arguments) {
    const Run run = folder.lorentz("golden " + arguments);
    INFO(run.err);
    CHECK(run.status == 0);
    const std::string set = folder.write("made.ndjson", run.out);
    CHECK(folder.lorentz("golden verify " + set).status == 0);
    std::set<std::string> records;
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("{\"id\"")) CHECK(records.insert(line).second);
    return records;
  };
  const std::string smoke = LORENTZ_SOURCE_DIR "/data/golden/smoke/smoke.ndjson";
  const auto ball = made("filter ball-2d"), both = made("filter ball-2d ball-3d " + smoke);
  CHECK(ball.size() == 640);
  CHECK((both.size() > 1280 && both.size() < 1380));  // those of smoke that are in one of them once
  CHECK(std::ranges::includes(both, ball));
  const auto close = made("filter --margin-below 4 ball-2d ball-3d");
  CHECK((close.size() > 20 && std::ranges::includes(both, close)));
  for (const std::string& record : close) {
    double margin = 1e9;
    std::sscanf(between(record, "\"margin\":", ",").c_str(), "%lf", &margin);
    CHECK(margin < 4);
  }
  const auto tangent = made("filter --tag far-origin --without needs-judge ball-2d ball-3d");
  CHECK((!tangent.empty() && tangent.size() < both.size()));
  for (const std::string& record : tangent) CHECK(contains(record, "far-origin"));
  const auto near = made("filter --without far-origin ball-2d ball-3d");
  CHECK(near.size() + made("filter --tag far-origin ball-2d ball-3d").size() == 1280);
  for (const std::string& record : near) CHECK_FALSE(contains(record, "far-origin"));
  CHECK(folder.lorentz("golden filter ball-2d ball-2d-binary32").status == 2);
}

TEST_CASE("A folder of sets: index, schema and sums of all in it, and no other file overwritten",
          "[golden][own_sets]") {
  const Folder folder;
  fs::create_directory(folder.file("sets"));
  const std::string set = folder.lorentz("golden make --set ties --count 9").out;
  folder.write("sets/two.ndjson", set);
  folder.write("sets/one.ndjson", folder.lorentz("golden make --set grazing --count 4").out);
  const std::string campaign = folder.file("campaign");
  folder.lorentz("fuzz -e published -t corridor --count 5 --store " + campaign);
  const std::string index = "fuzz export --store " + campaign + " -o " + folder.file("sets/");
  CHECK(folder.lorentz(index).status == 0);
  CHECK(std::system(("cd " + folder.file("sets") + " && sha256sum --quiet --check SHA256SUMS").c_str()) == 0);
  const std::string sums = folder.read("sets/SHA256SUMS");
  for (const char* name : {"one.ndjson\n", "two.ndjson\n", "index.json\n", "schema.json\n"})
    CHECK_THAT(sums, Catch::Contains(std::string("  ") + name));
  CHECK_THAT(folder.read("sets/index.json"),
             Catch::Contains("\"file\":\"one.ndjson\"") && Catch::Contains("\"count\":9,"));
  // Again, of a set that has changed; a schema of one's own stays.
  folder.write("sets/two.ndjson", folder.lorentz("golden make --set ties --count 8").out);
  folder.write("sets/schema.json", "{}");
  CHECK(folder.lorentz(index).status == 0);
  CHECK_THAT(folder.read("sets/index.json"), Catch::Contains("\"count\":8,"));
  CHECK(folder.read("sets/schema.json") == "{}");
  // What others wrote stays.
  folder.write("sets/index.json", "{\"mine\":1}");
  CHECK(folder.lorentz(index).status == 2);
  CHECK(folder.read("sets/index.json") == "{\"mine\":1}");
  fs::remove(folder.file("sets/index.json"));
  folder.write("sets/SHA256SUMS", "of mine");
  CHECK(folder.lorentz(index).status == 2);
  CHECK(folder.read("sets/SHA256SUMS") == "of mine");
}

TEST_CASE("A selection is thinned by tags: in turn one of each tag of each set", "[golden][own_sets]") {
  golden::Selection selection;
  golden::Reader ties(golden::find_set("ties"));
  selection.add(ties, [](const golden::Record&) { return true; });
  // Seven tags, of which some come first after hundreds of records.
  selection.thin(7);
  CHECK(selection.size() == 7);
  const std::string text = selection.text({.name = "few"});
  const std::string records = text.substr(text.find("{\"id\""));
  for (const char* tag : {"identical-atoms", "within-ulps", "mirrored", "overlapping-neighbours",
                          "superposed", "needs-judge", "shared-point"})
    CHECK_THAT(records, Catch::Contains(tag));
  selection.thin(1'000'000);
  CHECK(selection.size() == 7);
}

TEST_CASE("A set is written into a folder with what belongs beside it", "[golden][own_sets]") {
  const Folder folder;
  const std::string mine = folder.file("mine/"), store = folder.file("campaign");
  folder.lorentz("fuzz -e published -t corridor --count 5 --store " + store);
  const std::string golden =
      folder.write("golden.ndjson", folder.lorentz("golden make --set ties --count 3").out);
  for (const std::string& command :
       std::vector<std::string>{"fuzz export --store " + store + " -o " + mine,
                                "judge -e published --questions 2 --golden " + mine}) {
    INFO(command);
    CHECK(folder.lorentz(command).status < 2);
    CHECK(std::system(("cd " + mine + " && sha256sum --quiet --check SHA256SUMS").c_str()) == 0);
    CHECK(folder.lorentz("golden verify " + mine).status == 0);
  }
  for (const char* name : {"findings.ndjson", "schema.json"})
    CHECK_THAT(folder.read("mine/SHA256SUMS"), Catch::Contains(std::string("  ") + name));
  // A file is the set alone; a folder with other sums is left as it is, before anything is asked.
  CHECK(folder.lorentz("fuzz export --store " + store + " -o " + folder.file("alone")).status == 0);
  CHECK(folder.lorentz("golden verify " + folder.file("alone")).status == 0);
  fs::create_directory(folder.file("other"));
  folder.write("other/SHA256SUMS", "of mine");
  const Run refused = folder.lorentz("judge -e published --questions 2 --golden " + folder.file("other/"));
  CHECK((refused.status == 2 && refused.out.empty()));
  CHECK(folder.read("other/SHA256SUMS") == "of mine");
  CHECK_FALSE(fs::exists(folder.file("other/findings.ndjson")));
  CHECK(folder.lorentz("fuzz export --store " + store + " -o " + golden + "/").status == 3);
}

TEST_CASE("golden make: tags of each query, but those that the program gives itself", "[golden][own_sets]") {
  const Folder folder;
  const std::string scene = stream(unit_scene(2, 0.1), {{0.5, 0.3, 0}, {1, 0.3, 0}, {}});
  const std::string first = scene.substr(0, scene.find('\n') + 1);
  const auto made = [&](const std::string& lines) {
    return folder.lorentz("golden make --tag mine --queries " + folder.write("queries", first + lines));
  };
  const Run run = made(R"({"x":[0.5,0.3],"v":[1,0.3],"tags":["alpha","grazing","needs-judge","mine"]}
{"tags":["beta","alpha"],"x":[0.5,0.4],"v":[1,0.3]}
{"x":[0.5,0.6],"v":[1,0.3]}
{"x":[0.5,0.3],"v":[1,0.3],"tags":["late"]}
{"x":[0,0],"v":[0,0],"tags":["gamma"]}
)");
  CHECK(run.status == 2);  // an invalid query
  for (const char* tags :
       {R"("tags":["mine","alpha","late","plain"])", R"("tags":["mine","beta","alpha","plain"])",
        R"("tags":["mine","plain"])", R"("tags":["mine","gamma","invalid"])"})
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

TEST_CASE("A folder of sets is looked at before anything is written to it", "[golden][own_sets]") {
  const Folder folder;
  const std::string own = folder.file("own");
  std::filesystem::create_directory(own);
  std::filesystem::copy_file(LORENTZ_SOURCE_DIR "/data/golden/smoke/smoke.ndjson", own + "/smoke.ndjson");
  folder.write("own/zz.ndjson", "{\"x\":[0,0],\"v\":[1,0]}\n");
  const Run run = folder.lorentz("judge -e published --questions 1 --golden " + own + "/");
  INFO(run.err);
  CHECK(run.status == 2);
  CHECK(contains(run.err, "zz.ndjson"));
  for (const char* name : {"/index.json", "/SHA256SUMS", "/schema.json"})
    CHECK_FALSE(std::filesystem::exists(own + name));
}
