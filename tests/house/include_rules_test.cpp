// Who may see whom: one table of all rooms, from the ground up. Engine and oracle share the problem statement
// and nothing else, so that a bug in one cannot hide in the other. The linker keeps most of this; the test
// keeps the rest (headers that need no linking), and that the table is all there is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = LORENTZ_SOURCE_DIR;
using Names = std::vector<std::string>;

/// A folder with sources, a room of the house. Besides its own headers and the standard library its files may
/// include ..
struct Room {
  std::string folder;
  Names open_doors;  ///< .. the public headers, <lorentz/..>, of these rooms,
  Names inside;      ///< .. any header of these,
  Names libraries;   ///< .. and headers that begin like this; with the one file that may, after a blank.
};

// A room may name those above it in the table only: there is no arrow upward.
const std::vector<Room> kHouse{
    {"src/problem", {}, {}, {}},
    {"src/exchange",
     {"src/problem"},
     {"src/problem"},
     {"simdjson.h exchange_json.cpp", "toml++/ exchange_scene_file.cpp", "fcntl.h input_file.cpp",
      "poll.h input_file.cpp", "sys/stat.h input_file.cpp", "unistd.h input_file.cpp"}},
    {"src/engines/base", {"src/problem"}, {}, {}},
    {"src/engines/classical", {"src/problem", "src/engines/base"}, {"src/engines/base"}, {}},
    {"src/engines/published", {"src/problem", "src/engines/base"}, {}, {"Eigen/ published_bravais.cpp"}},
    {"src/engines/reduction", {"src/problem", "src/engines/base"}, {"src/engines/base"}, {}},
    {"src/engines/batch",
     {"src/problem", "src/engines/base", "src/engines/reduction"},
     {"src/engines/base", "src/engines/reduction"},
     {"hwy/"}},
    {"src/engines/gpu",
     {"src/problem", "src/engines/base", "src/engines/reduction", "src/engines/batch"},
     {"src/engines/base", "src/engines/reduction", "src/engines/batch"},
     {"dlfcn.h driver.cpp", "math.h device.hpp", "stdlib.h device.hpp", "string.h device.hpp"}},
    {"src/engines",
     {"src/problem", "src/engines/base", "src/engines/reduction"},
     {"src/engines/base", "src/engines/classical", "src/engines/published"},
     {}},
    {"src/trajectory",
     {"src/problem", "src/engines/base", "src/engines/reduction"},
     {"src/engines/base"},
     {}},
    {"src/trajectory/batch", {"src/problem", "src/engines/batch", "src/trajectory"}, {"src/trajectory"}, {}},
    // The oracle: of src the problem alone.
    {"oracle/integers", {"src/problem"}, {}, {"gmp.h z.hpp"}},
    {"oracle/exact", {"src/problem"}, {"oracle/integers"}, {}},
    {"oracle/first_hit", {"src/problem"}, {"oracle/integers", "oracle/exact"}, {}},
    {"oracle/contacts", {"src/problem"}, {"oracle/integers", "oracle/exact"}, {}},
    {"oracle/horizon", {"src/problem", "oracle/contacts"}, {"oracle/integers", "oracle/exact"}, {}},
    {"oracle/margin", {"src/problem"}, {"oracle/integers", "oracle/exact", "oracle/first_hit"}, {}},
    {"oracle/surroundings", {"src/problem"}, {"oracle/integers", "oracle/exact"}, {}},
    {"oracle/certificate/check", {"src/problem"}, {"oracle/integers"}, {}},
    {"oracle/certificate",
     {"src/problem", "oracle/certificate/check"},
     {"oracle/integers", "oracle/exact"},
     {}},
    {"oracle", {"src/problem"}, {"oracle/integers", "oracle/exact", "oracle/first_hit"}, {}},
    {"oracle/itinerary",
     {"src/problem"},
     {"oracle/integers", "oracle/exact", "oracle/first_hit"},
     {"arb.h ball.hpp", "flint/ ball.hpp", "flint/ ball.cpp"}},
    {"oracle/walk", {"src/problem"}, {}, {"CGAL/ walk.cpp"}},
    {"oracle/certified", {"src/problem", "src/engines/base", "src/engines/reduction", "oracle"}, {}, {}},
    {"oracle/certified_batch",
     {"src/problem", "src/engines/reduction", "src/engines/batch", "oracle", "oracle/certified"},
     {"src/engines/gpu"},
     {}},
    // From here on the oracle is seen by its public headers, and its libraries not at all; but for
    // fuzz/campaign, which adds with its integers.
    {"question/cases", {"src/problem", "oracle", "oracle/certified"}, {}, {"Random123/ random.cpp"}},
    {"fuzz/families", {"src/problem", "oracle", "oracle/contacts"}, {"question/cases"}, {}},
    {"question/starts",
     {"src/problem", "src/engines/batch", "oracle", "oracle/certified"},
     {"src/problem", "src/exchange", "question/cases"},
     {"hwy/ candidates_lanes.cpp", "Random123/ candidates_lanes.cpp"}},
    // Theory knows problems and what the oracle says of scenes, and nothing of who flies.
    {"statistics/theory",
     {"src/problem", "oracle/contacts", "oracle/horizon"},
     {"src/problem", "question/starts"},
     {"boost/math/ fit.cpp"}},
    {"question/precisions",
     {"src/problem", "src/engines/base"},
     {"src/engines/base", "src/engines/published"},
     {"boost/multiprecision/ big_number.hpp"}},
    // The process that a foreign library is loaded in: the formats, and the interface in C.
    {"question/library_host",
     {"src/problem", "src/exchange"},
     {"src/problem", "src/exchange"},
     {"dlfcn.h main.cpp", "fcntl.h main.cpp", "poll.h main.cpp", "pthread.h main.cpp", "signal.h main.cpp",
      "unistd.h main.cpp"}},
    {"question",
     {"src/problem", "src/exchange", "src/engines/base", "src/engines/reduction", "src/engines/batch",
      "oracle", "oracle/contacts", "oracle/margin", "oracle/walk", "oracle/certified",
      "oracle/certified_batch", "question/library_host"},
     {"src/problem", "src/exchange", "src/engines/published", "src/engines/gpu", "question/cases",
      "question/library_host", "question/precisions"},
     {"fmt/", "fcntl.h library_program.cpp", "fcntl.h process.cpp", "poll.h command_engine.cpp",
      "poll.h introduction.cpp", "signal.h process.cpp", "spawn.h process.cpp", "sys/resource.h process.cpp",
      "sys/mman.h library_program.cpp", "sys/types.h process.hpp", "sys/wait.h process.cpp",
      "unistd.h library_program.cpp", "unistd.h process.cpp"}},
    {"report/files",
     {"src/problem", "src/exchange", "oracle/contacts", "oracle/itinerary"},
     {"src/problem", "src/exchange"},
     {"fmt/", "fcntl.h signals.cpp", "fcntl.h whole_file.cpp", "signal.h signals.cpp",
      "sys/stat.h whole_file.cpp", "unistd.h signals.cpp", "unistd.h whole_file.cpp"}},
    {"report/pictures", {"src/problem", "oracle/margin", "oracle/surroundings"}, {"src/problem"}, {"fmt/"}},
    {"report",
     {"src/problem", "src/exchange", "src/engines/batch", "oracle/horizon", "oracle/margin"},
     {"src/problem", "src/exchange", "report/files", "question"},
     {"fmt/", "boost/math/ share.cpp", "sys/utsname.h manifest.cpp"}},
    {"report/runs",
     {"src/problem", "src/exchange"},
     {"src/problem", "src/exchange", "report/files"},
     {"fmt/", "boost/mpi.hpp world_mpi.cpp", "boost/serialization/ world_mpi.cpp", "fcntl.h lock_file.cpp",
      "sqlite3.h sqlite.hpp", "sys/file.h lock_file.cpp", "sys/stat.h database.cpp",
      "sys/stat.h lock_file.cpp", "unistd.h lock_file.cpp"}},
    {"statistics/gpu", {}, {"src/engines/gpu", "question/starts"}, {}},
    {"statistics/flights",
     {"src/problem", "src/exchange", "src/engines/batch", "oracle/certified_batch"},
     {"src/problem", "src/exchange", "question", "report/runs", "question/starts", "statistics/theory",
      "report/files", "report", "question/cases", "src/engines/gpu", "statistics/gpu"},
     {"fmt/", "boost/icl/ account.hpp"}},
    {"statistics/chaos",
     {"src/problem", "src/engines/base", "src/engines/reduction", "src/engines/batch", "src/trajectory",
      "src/trajectory/batch"},
     {"src/problem", "src/exchange", "question/starts", "statistics/theory", "report"},
     {"fmt/"}},
    {"statistics/rival",
     {"src/problem", "src/trajectory", "oracle", "oracle/itinerary"},
     {"src/problem", "src/exchange", "question"},
     {}},
    {"judge/golden",
     {"src/problem", "oracle", "oracle/contacts", "oracle/margin", "oracle/walk", "oracle/certificate",
      "oracle/certificate/check"},
     {"src/problem", "src/exchange", "question/cases", "fuzz/families", "question", "report/files"},
     {"fmt/", "sha2.h record.cpp"}},
    {"fuzz/campaign",
     {"src/problem", "src/exchange", "src/engines/base", "oracle", "oracle/contacts", "oracle/margin"},
     {"src/problem", "src/exchange", "src/engines/base", "oracle/integers", "question/cases", "fuzz/families",
      "question", "report/runs"},
     {}},
    {"judge",
     {"src/problem", "src/exchange", "oracle/margin"},
     {"src/problem", "src/exchange", "question/cases", "fuzz/families", "question/starts", "question",
      "judge/golden", "fuzz/campaign", "statistics/theory", "report/files", "report/pictures", "report"},
     {"fmt/"}},
    // No families: what a harness tries comes from its bytes alone.
    {"tests/harness",
     {"src/problem", "src/exchange", "src/engines/reduction", "oracle", "oracle/contacts", "oracle/margin",
      "oracle/certificate", "oracle/certificate/check", "oracle/certified"},
     {"src/problem", "judge/golden"},
     {"sys/mman.h input_file.hpp", "sys/mman.h input_file.cpp", "unistd.h input_file.cpp"}},
    {"tests/digests",
     {"src/problem", "src/engines/base", "src/engines/reduction", "src/engines/batch", "src/trajectory",
      "src/trajectory/batch"},
     {"question/cases", "question/starts"},
     {"catch2/ digests_test.cpp"}},
    {"cli",
     {"src/problem", "src/exchange", "src/engines/base", "src/engines/batch", "src/trajectory", "oracle",
      "oracle/exact", "oracle/contacts", "oracle/horizon", "oracle/itinerary", "oracle/margin",
      "oracle/walk"},
     {"src/problem", "src/exchange", "question/cases", "fuzz/families", "question", "judge/golden",
      "statistics/flights", "question/starts", "statistics/theory", "statistics/chaos", "statistics/rival",
      "fuzz/campaign", "judge", "report/pictures", "report", "report/runs", "report/files"},
     {"CLI/", "fmt/", "signal.h interrupt.hpp", "unistd.h fuzz.cpp", "unistd.h output.cpp",
      "unistd.h progress.hpp", "unistd.h query_stream.cpp"}},
    {"python",
     {"src/problem", "src/exchange", "src/trajectory", "src/trajectory/batch", "oracle", "oracle/exact",
      "oracle/contacts", "oracle/horizon", "oracle/itinerary", "oracle/margin", "oracle/certificate",
      "oracle/certificate/check", "oracle/certified_batch"},
     {"src/problem", "src/engines/gpu", "question", "judge/golden", "statistics/chaos", "statistics/flights",
      "statistics/rival", "question/starts", "judge", "report", "report/files"},
     {"pybind11/"}},
    {"tests/bench",
     {"src/problem", "src/exchange", "src/engines/base", "src/engines/reduction", "src/engines/batch",
      "src/trajectory/batch", "oracle", "oracle/certified", "oracle/certified_batch"},
     {"src/engines/published", "question/cases", "fuzz/families", "question/starts", "question",
      "fuzz/campaign"},
     {"fmt/", "benchmark/ first_hit_benchmark.cpp"}},
};

/// Whose a public header is; one in C by the name of its file.
const std::map<std::string, std::string> kPublic{
    {"problem", "src/problem"},
    {"version", "src/problem"},
    {"vec", "src/problem"},
    {"scene", "src/problem"},
    {"obstacle", "src/problem"},
    {"query", "src/problem"},
    {"answer", "src/problem"},
    {"claim", "src/problem"},
    {"errors", "src/problem"},
    {"pimpl", "src/problem"},
    {"rational", "src/problem"},
    {"geometry", "src/problem"},
    {"exchange", "src/exchange"},
    {"line_reader", "src/exchange"},
    {"engine", "src/engines/base"},
    {"engine.h", "question/library_host"},
    {"lorentz.h", "question"},
    {"engine_base", "src/engines/base"},
    {"environment", "src/engines/base"},
    {"collision", "src/engines/base"},
    {"flight", "src/engines/reduction"},
    {"reduction", "src/engines/reduction"},
    {"trajectory", "src/trajectory"},
    {"trajectory_batch", "src/trajectory/batch"},
    {"continued_fraction", "oracle/exact"},
    {"scene_check", "oracle/contacts"},
    {"horizon", "oracle/horizon"},
    {"margin", "oracle/margin"},
    {"verdict", "oracle/margin"},
    {"surroundings", "oracle/surroundings"},
    {"certificate", "oracle/certificate/check"},
    {"certificate_check", "oracle/certificate/check"},
    {"prover", "oracle/certificate"},
    {"oracle", "oracle"},
    {"itinerary", "oracle/itinerary"},
    {"walk", "oracle/walk"},
    {"certified", "oracle/certified"},
    {"batch", "src/engines/batch"},
    {"certified_batch", "oracle/certified_batch"},
};

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Room* room_named(const std::string& folder) {
  for (const Room& room : kHouse)
    if (room.folder == folder) return &room;
  return nullptr;
}

bool is_source(const fs::path& file) {
  return file.extension() == ".cpp" || file.extension() == ".hpp" || file.extension() == ".h";
}

std::vector<fs::path> sources(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kRoot / folder))
    if (is_source(entry.path())) files.push_back(entry.path());
  return files;
}

struct Include {
  std::string name;
  bool quoted;
};

std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> names;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, kInclude)) names.push_back({match[2], match[1] == "\""});
  return names;
}

std::string name_of(const fs::path& public_header) {
  return public_header.extension() == ".h" ? public_header.filename() : public_header.stem();
}

// The name of a public header in <lorentz/NAME.hpp> or <lorentz/NAME.h>, or nothing.
std::string public_name(const Include& include) {
  static const std::regex kName(R"(lorentz/[a-z_0-9]+\.h(pp)?)");
  return !include.quoted && std::regex_match(include.name, kName) ? name_of(include.name) : "";
}

bool may_use(const Room& room, const std::string& file, const std::string& name) {
  for (const std::string& rule : room.libraries) {
    const std::size_t blank = rule.find(' ');
    if (!name.starts_with(rule.substr(0, blank))) continue;
    if (blank == std::string::npos || rule.substr(blank + 1) == file) return true;
  }
  return name.find_first_of("/.") == std::string::npos || name == "stdint.h";  // the standard library
}

bool may_include(const Room& room, const std::string& file, const Include& include) {
  if (const std::string name = public_name(include); !name.empty()) {
    const auto owner = kPublic.find(name);
    return owner != kPublic.end() &&
           (owner->second == room.folder || contains(room.open_doors, owner->second) ||
            contains(room.inside, owner->second));
  }
  if (!include.quoted) return may_use(room, file, include.name);
  const std::string folder = fs::path(include.name).parent_path();
  return folder == room.folder || contains(room.inside, folder);
}

}  // namespace

TEST_CASE("Each room sees what the table says, and its libraries", "[house]") {
  std::size_t files = 0;
  for (const Room& room : kHouse) {
    REQUIRE(fs::exists(kRoot / room.folder));
    for (const fs::path& file : sources(room.folder))
      for (const Include& include : includes_of(file)) {
        INFO(file << " includes " << include.name);
        CHECK(may_include(room, file.filename(), include));
        ++files;
      }
  }
  CHECK(files > 1200);  // 1 470 seen
}

TEST_CASE("The table names rooms above only, each once, and all that have sources", "[house]") {
  std::set<std::string> above;
  for (const Room& room : kHouse) {
    for (const Names& names : {room.open_doors, room.inside})
      for (const std::string& name : names) {
        INFO(room.folder << " sees " << name);
        CHECK(above.contains(name));
      }
    INFO(room.folder);
    CHECK(above.insert(room.folder).second);
  }
  for (const char* floor :
       {"src", "oracle", "question", "report", "statistics", "fuzz", "judge", "cli", "python", "tests/bench"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / floor)) {
      const std::string folder = fs::relative(entry.path().parent_path(), kRoot);
      if (!is_source(entry.path()) || folder.starts_with("oracle/proof"))
        continue;  // which writes claims for Coq
      INFO(entry.path());
      CHECK(above.contains(folder));
    }
}

std::string door_of(const std::string& folder) {
  return folder.substr(0, folder.find('/'));
}

// A line for each folder at the top that the table has: what it uses. Folders stand above all that they use.
std::string picture() {
  std::vector<std::string> doors, drawn;
  std::map<std::string, std::set<std::string>> used;
  for (const Room& room : kHouse) {
    const std::string door = door_of(room.folder);
    if (std::ranges::count(doors, door) == 0) doors.push_back(door);
    for (const Names& names : {room.open_doors, room.inside})
      for (const std::string& name : names)
        if (door_of(name) != door) used[door].insert(door_of(name));
  }
  std::string text;
  while (!doors.empty()) {
    const auto next = std::ranges::find_if(doors, [&](const std::string& door) {
      return std::ranges::all_of(used[door],
                                 [&](const std::string& one) { return std::ranges::count(drawn, one) > 0; });
    });
    if (next == doors.end()) return "a circle among " + doors.front() + " and others";
    std::string line = *next + std::string(12 - next->size(), ' ');
    for (auto one = drawn.rbegin(); one != drawn.rend(); ++one)
      if (used[*next].contains(*one)) line += (line.ends_with(' ') ? "uses " : ", ") + *one;
    line.erase(line.find_last_not_of(' ') + 1);
    text = line + '\n' + text;
    drawn.push_back(*next);
    doors.erase(next);
  }
  return text;
}

TEST_CASE("The picture in CONTRIBUTING is drawn from the table, and no arrow points up", "[house]") {
  std::ifstream in(kRoot / "CONTRIBUTING.md");
  std::stringstream text;
  text << in.rdbuf();
  const std::string drawn = picture();
  INFO(drawn);
  CHECK(text.str().find("```\n" + drawn + "```\n") != std::string::npos);
}

TEST_CASE("At most fourteen folders at the top", "[house]") {
  std::string doors;
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (entry.is_directory() && !name.starts_with('.') && !name.starts_with("build")) doors += name + ' ';
  }
  INFO(doors << "\n(what git does not know: git clean -ndX)");
  CHECK(std::ranges::count(doors, ' ') <= 14);
}

TEST_CASE("Public headers show their room's open doors and the standard library", "[house]") {
  std::size_t headers = 0;
  for (const fs::path& file : sources("include/lorentz")) {
    INFO(file);
    const auto owner = kPublic.find(name_of(file));
    REQUIRE(owner != kPublic.end());
    Room outside = *room_named(owner->second);
    outside.inside.clear();
    outside.libraries.clear();
    for (const Include& include : includes_of(file)) {
      INFO("includes " << include.name);
      CHECK_FALSE(include.quoted);
      CHECK(may_include(outside, file.filename(), include));
    }
    ++headers;
  }
  CHECK(headers == kPublic.size());
}

TEST_CASE("Public headers name no library, not even in comments, and no void*", "[house]") {
  static const std::regex kForeign(R"(\b(gmp|mpfr|mpz|mpq|cgal|boost|simdjson|eigen|sqlite|sha2)|void *\*)",
                                   std::regex::icase);
  for (const fs::path& file : sources("include/lorentz")) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      INFO(file << ": " << line);
      CHECK_FALSE(std::regex_search(line, kForeign));
    }
  }
}

// The targets named lorentz_* in `lorentz_library(NAME .. PUBLIC a b PRIVATE c)`, but its own.
std::set<std::string> linked_by(const fs::path& cmake_lists) {
  std::ifstream in(cmake_lists);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  std::smatch match;
  static const std::regex kCall(R"(lorentz_library\(lorentz_[a-z_]+([^()]*)\))"),
      kTarget(R"(lorentz_[a-z_]+)");
  std::set<std::string> targets;
  if (!std::regex_search(all, match, kCall)) return targets;
  const std::string arguments = match[1];
  for (std::sregex_iterator it(arguments.begin(), arguments.end(), kTarget), end; it != end; ++it)
    targets.insert(it->str());
  return targets;
}

TEST_CASE("What keeps the oracle from the engines is the linker", "[house]") {
  // The folders whose word counts because they share no more than this with those whose answers they check.
  std::map<std::string, std::set<std::string>> may_link{
      {"src/engines/base", {"lorentz_problem"}},
      {"src/engines/batch", {"lorentz_reduction"}},
      {"src/engines/gpu", {}},  // in the library of src/engines/batch
      {"oracle/exact", {"lorentz_problem", "lorentz_integers"}},
      {"oracle/first_hit", {"lorentz_exact"}},
      {"oracle/certificate/check", {"lorentz_problem", "lorentz_integers"}},
      {"oracle/walk", {"lorentz_problem"}}};
  for (const auto& entry : fs::directory_iterator(kRoot / "src/engines"))
    if (entry.is_directory())
      may_link.try_emplace("src/engines/" + entry.path().filename().string(),
                           std::set<std::string>{"lorentz_engine_base"});
  CHECK(may_link.size() >= 9);
  for (const auto& [folder, targets] : may_link) {
    INFO(folder);
    CHECK(linked_by(kRoot / folder / "CMakeLists.txt") == targets);
  }
}

TEST_CASE("The tests of the public headers' promises are there", "[house]") {
  const auto text_of = [](const fs::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  };
  std::string tests;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    if (entry.path().extension() == ".cpp") tests += text_of(entry.path());
  static const std::regex kBreak(R"("\s*\n\s*")"), kQuoted("\"([^\"]+)\""),
      kRow(R"(\| (`(\w+\.hpp)`)? *\| (\d|`(\w+)`) \| (.*) \|)");
  tests = std::regex_replace(tests, kBreak, "");  // a long name, in pieces
  const std::string trust = text_of(kRoot / "docs/trust.md");
  std::istringstream lines(trust.substr(trust.find("| header | promise |")));
  std::string header;
  std::size_t rows = 0, named = 0;
  std::smatch row;
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    if (!line.starts_with("| `") && !line.starts_with("|  |")) continue;
    REQUIRE(std::regex_match(line, row, kRow));
    if (row[1].matched) header = text_of(kRoot / "include/lorentz" / row[2].str());
    const std::string promise = row[4].matched ? row[4].str() + '(' : "///  " + row[3].str() + ". ";
    CHECK(header.find(promise) != std::string::npos);
    const std::string names = row[5];
    for (std::sregex_iterator name(names.begin(), names.end(), kQuoted), end; name != end; ++name, ++named)
      CHECK(tests.find("TEST_CASE(\"" + (*name)[1].str() + '"') != std::string::npos);
    ++rows;
  }
  CHECK(rows > 50);   // 54 seen
  CHECK(named > 70);  // 78 seen
}
