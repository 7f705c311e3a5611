// Who may include whom (CONTRIBUTING.md): engine and oracle share the problem statement and nothing else, so
// that a bug in one cannot hide in the other.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = LORENTZ_SOURCE_DIR;

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> names;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, kInclude)) names.push_back(match[1]);
  return names;
}

// The harnesses are below fuzz/, but have rules of their own.
constexpr const char* kHarness = "fuzz/harness";

std::vector<fs::path> sources(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const fs::path& file = entry.path();
    if (folder == "fuzz" && file.parent_path() == kRoot / kHarness) continue;
    if (file.extension() == ".cpp" || file.extension() == ".hpp") files.push_back(file);
  }
  return files;
}

bool starts_with_any(const std::string& name, std::initializer_list<const char*> prefixes) {
  for (const char* prefix : prefixes)
    if (name.starts_with(prefix)) return true;
  return false;
}

std::set<std::string> own_headers(const char* folder) {
  std::set<std::string> names;
  for (const fs::path& file : sources(folder))
    if (file.extension() == ".hpp") names.insert(file.filename());
  return names;
}

}  // namespace

TEST_CASE("src sees no big numbers, no oracle, no program") {
  const auto oracle = own_headers("oracle"), cli = own_headers("cli"), fuzz = own_headers("fuzz");
  REQUIRE(sources("src").size() > 8);
  for (const fs::path& file : sources("src"))
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      CHECK_FALSE(starts_with_any(name, {"gmp", "mpfr", "mpfi", "boost/", "CGAL/", "../oracle", "../cli"}));
      CHECK_FALSE(oracle.contains(name));
      CHECK_FALSE(cli.contains(name));
      CHECK_FALSE(fuzz.contains(name));
      // Only the exchange library may use more than the standard library.
      if (!file.filename().string().starts_with("exchange"))
        CHECK_FALSE(starts_with_any(name, {"simdjson", "toml++", "fmt/"}));
      // Eigen stays inside one engine's source files, so that the engines' users need no more than these.
      if (!file.filename().string().starts_with("published") || file.extension() != ".cpp")
        CHECK_FALSE(starts_with_any(name, {"Eigen/", "eigen3/", "unsupported/Eigen"}));
    }
}

TEST_CASE("src beside the exchange and published*.cpp uses the standard library only") {
  const auto own = own_headers("src");
  for (const fs::path& file : sources("src")) {
    const std::string source = file.filename();
    if (source.starts_with("exchange") || source == "line_reader.cpp") continue;
    if (source.starts_with("published") && file.extension() == ".cpp") continue;
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      CHECK((own.contains(name) || name.find_first_of("/.") == std::string::npos));
    }
  }
}

TEST_CASE("The published algorithm's own headers are private to it") {
  for (const char* folder : {"src", "oracle", "cli", "fuzz", "bench"})
    for (const fs::path& file : sources(folder)) {
      if (file.filename().string().starts_with("published")) continue;
      for (const std::string& name : includes_of(file)) {
        INFO(file << " includes " << name);
        CHECK_FALSE(starts_with_any(name, {"published_", "Eigen/"}));
      }
    }
}

TEST_CASE("oracle sees of src the problem only, but for escalate, which sees the engine") {
  const auto cli = own_headers("cli"), fuzz = own_headers("fuzz");
  REQUIRE(sources("oracle").size() > 15);
  auto src = own_headers("src");
  src.erase("problem.hpp");
  for (const fs::path& file : sources("oracle"))
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      CHECK_FALSE(cli.contains(name));
      CHECK_FALSE(fuzz.contains(name));
      if (file.stem() == "escalate" && (name == "../src/flight.hpp" || name == "../src/reduction.hpp"))
        continue;
      if (file.stem() != "escalate") CHECK(name != "escalate.hpp");
      CHECK_FALSE(src.contains(fs::path(name).filename()));
      CHECK((!name.starts_with("../") || name == "../src/problem.hpp"));
    }
}

TEST_CASE(
    "fuzz sees the problem, the engines and the oracle's public headers, and no library but the standard "
    "one") {
  auto known = own_headers("fuzz");
  REQUIRE(known.size() > 5);
  for (const std::string& name : own_headers("src"))
    if (!starts_with_any(name, {"exchange", "line_reader", "published_"})) known.insert(name);
  for (const char* name : {"oracle.hpp", "escalate.hpp", "scene_check.hpp", "continued_fraction.hpp",
                           "horizon.hpp", "verdict.hpp", "margin.hpp"})
    known.insert(name);
  for (const fs::path& file : sources("fuzz")) {
    const std::string source = file.stem();
    // What is kept of a campaign is kept in the words of the formats, and in SQLite.
    const bool keeps = source == "finding" || source == "store" || source == "store_merge";
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      const bool system = name.starts_with("sys/") || name == "fcntl.h" || name == "unistd.h";
      CHECK((known.contains(name) || name.find_first_of("/.") == std::string::npos ||
             ((source == "finding" || source == "notation") && name == "exchange.hpp") ||
             (source == "store" && system) || (source == "exact_sums" && name == "dyadic.hpp") ||
             (source == "sqlite" && name == "sqlite3.h") ||
             (file.filename() == "ranks_mpi.cpp" && (name == "mpi.h" || name.starts_with("boost/"))) ||
             (file.filename() == "random.cpp" && name == "Random123/philox.h")));
      if (name == "sqlite.hpp") CHECK((keeps && file.extension() == ".cpp"));
    }
  }
}

TEST_CASE("The harnesses see what a program of ours sees, and no library; nobody else sees them") {
  auto known = own_headers(kHarness);
  REQUIRE(known.size() >= 4);
  for (const char* folder : {"src", "oracle", "fuzz", "golden", "cli", "bench"})
    for (const fs::path& file : sources(folder))
      for (const std::string& name : includes_of(file)) {
        INFO(file << " includes " << name);
        CHECK_FALSE(known.contains(fs::path(name).filename()));
      }
  // The formats, which they feed; the engines and the oracle's public headers, which they hold against each
  // other. No families: what a harness tries comes from its bytes alone.
  for (const char* name :
       {"problem.hpp", "reduction.hpp", "line_reader.hpp", "exchange.hpp", "reader.hpp", "oracle.hpp",
        "scene_check.hpp", "verdict.hpp", "escalate.hpp", "prover.hpp", "certificate_check.hpp"})
    known.insert(name);
  for (const fs::path& file : sources(kHarness))
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      const bool system = file.stem() == "input_file" && (name == "sys/mman.h" || name == "unistd.h");
      CHECK((known.contains(name) || name.find_first_of("/.") == std::string::npos || system));
    }
}

TEST_CASE("walk sees the problem, CGAL and the standard library; nobody else sees CGAL") {
  for (const fs::path& file : sources("oracle")) {
    const bool is_walk = file.stem() == "walk";
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      if (!is_walk)
        CHECK_FALSE(name.starts_with("CGAL/"));
      else if (name.find('/') != std::string::npos || name.ends_with(".hpp"))
        CHECK((name.starts_with("CGAL/") || name == "../src/problem.hpp" || name == "walk.hpp"));
      else
        CHECK_FALSE(name.starts_with("gmp"));
    }
  }
}

TEST_CASE("The program, the families and the measurements see none of the oracle's libraries") {
  for (const char* folder : {"cli", "fuzz", kHarness, "bench"})
    for (const fs::path& file : sources(folder))
      for (const std::string& name : includes_of(file)) {
        INFO(file << " includes " << name);
        const bool messages =
            file.stem() == "ranks_mpi" && starts_with_any(name, {"boost/mpi", "boost/serialization/"});
        CHECK((messages || !starts_with_any(name, {"gmp", "mpfr", "boost/", "CGAL/"})));
      }
}

TEST_CASE("The check of certificates shares with the oracle its integers and the problem, nothing else") {
  const std::set<std::string> own{"certificate_check", "certificate_time", "certificate_view"};
  const auto oracle = own_headers("oracle");
  std::size_t files = 0;
  for (const fs::path& file : sources("oracle")) {
    const bool is_check = own.contains(file.stem()) || file.stem() == "certificate";
    files += is_check;
    for (const std::string& name : includes_of(file)) {
      INFO(file << " includes " << name);
      const std::string stem = fs::path(name).stem();
      if (is_check && oracle.contains(fs::path(name).filename()))
        CHECK((name == "integer.hpp" || name == "dyadic.hpp" || name == "certificate.hpp" ||
               own.contains(stem)));
      if (!is_check) CHECK_FALSE(own.contains(stem));
    }
  }
  CHECK(files == 7);
}

TEST_CASE("The oracle's public headers show none of its libraries") {
  for (const char* header : {"oracle.hpp", "walk.hpp", "scene_check.hpp", "continued_fraction.hpp",
                             "verdict.hpp", "horizon.hpp", "certificate.hpp", "certificate_check.hpp"})
    for (const std::string& name : includes_of(kRoot / "oracle" / header)) {
      INFO(header << " includes " << name);
      CHECK((name == "../src/problem.hpp" || name == "certificate.hpp" ||
             name.find_first_of("/.") == std::string::npos));
    }
}
