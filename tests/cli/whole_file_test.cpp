// Files that are put in their place when they are whole.
#include "cli/whole_file.hpp"

#include <catch2/catch.hpp>

#include <lorentz/errors.hpp>
#include "tests/support/command_line.hpp"

using namespace lorentz;
using cli::WholeFile;
using test::Folder;

namespace {

std::size_t entries(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.file("")), {}));
}

}  // namespace

TEST_CASE("Until a file is whole the old one stands", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old\n");
  {
    WholeFile file(path);
    file.write("half of the ne");
    CHECK(folder.read("f") == "old\n");
  }  // given up
  CHECK(folder.read("f") == "old\n");
  CHECK(entries(folder) == 1);
  {
    WholeFile file(path);
    file.write("new\n");
    file.commit();
  }
  CHECK(folder.read("f") == "new\n");
  CHECK(entries(folder) == 1);
}

TEST_CASE("A file is put where a link points to, with the permissions of the old one", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old\n"), link = folder.file("link");
  std::filesystem::create_symlink("f", link);
  std::filesystem::permissions(path,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  WholeFile file(link);
  file.write("new\n");
  file.commit();
  CHECK(folder.read("f") == "new\n");
  CHECK(std::filesystem::is_symlink(link));
  CHECK(std::filesystem::status(path).permissions() ==
        (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
}

TEST_CASE("Devices are written as they are, and a full one is a failure", "[cli][whole_file]") {
  WholeFile null("/dev/null");
  null.write("text");
  CHECK_NOTHROW(null.commit());
  WholeFile full("/dev/full");
  full.write("text");
  CHECK_THROWS_AS(full.commit(), FileError);
  CHECK_THROWS_AS(WholeFile("/no/such/folder/f"), FileError);
}

TEST_CASE("compare that is killed leaves the file of disagreements as it was", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("d", "old\n");
  folder.run("timeout -s KILL 0.3 " LORENTZ_PROGRAM " compare --count 100000000 --disagreements " + path);
  CHECK(folder.read("d") == "old\n");
}

TEST_CASE("Two options that name one file are refused, whatever they call it", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old\n"), same = folder.file("./f"), other = folder.file("g");
  std::filesystem::create_symlink(path, folder.file("link"));
  using cli::check_apart;
  CHECK_THROWS_WITH(check_apart({{"--csv", path}, {"--svg", other}, {"--html", path}}),
                    "--csv and --html name the same file: " + path + "; give each its own");
  CHECK_THROWS_AS(check_apart({{"--csv", path}, {"--html", same}}), InputError);
  CHECK_THROWS_AS(check_apart({{"--csv", path}, {"--html", folder.file("link")}}), InputError);
  CHECK_THROWS_AS(check_apart({{"--csv", other}, {"--html", folder.file("./g")}}), InputError);  // none yet
  CHECK_NOTHROW(check_apart({{"--csv", path}, {"--html", other}, {"--svg", {}}, {"--store", {}}}));
  CHECK_NOTHROW(check_apart({{"--csv", "/dev/stderr"}, {"--html", "/dev/stderr"}}));
}
