// The subcommands about scenes, `scene` and `horizon`, as their users call them.
#include <catch2/catch.hpp>

#include <pty.h>
#include <unistd.h>

#include <lorentz/exchange.hpp>

#include "tests/support/command_line.hpp"

using namespace lorentz::test;

namespace {

// Whether tags open and close in pairs, and nothing else of XML's grammar is broken that these pictures could
// break.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos || xml.find('<', at + 1) < end) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    const std::string name = tag.substr(0, tag.find_first_of(" \n"));
    if (tag[0] == '?' || tag.back() == '/') continue;
    if (tag[0] != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    }
  }
  return open.empty() && !contains(xml, "nan") && !contains(xml, "inf");
}

}  // namespace

TEST_CASE("scene show without a scene: the catalogue", "[cli][scene_command]") {
  const Folder folder;
  const Run table = folder.lorentz("scene show");
  CHECK(table.status == 0);
  CHECK(lines(table.out) >= 28);
  CHECK(contains(table.out, "Face-centred cubic"));
  // A broken file is named, and the others are listed.
  fs::create_directory(folder.file("scenes"));
  folder.write("scenes/good.toml",
               "# Good.\ndimension = 2\nlattices = [{vectors = [[1, 0], [0, 1]], atoms = [{position = "
               "[0, 0], radius = 0.1}]}]\n");
  folder.write("scenes/bad.toml", "dimension = 4\n");
  const std::string command = "LORENTZ_DATA=" + folder.file("") + " " + LORENTZ_PROGRAM + " scene show >" +
                              folder.file("o") + " 2>" + folder.file("e");
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 2);
  CHECK(contains(folder.read("o"), "1  Good."));
  CHECK(contains(folder.read("e"), "bad.toml: dimension"));
}

TEST_CASE("scene show: contacts, filling and mean free path, or why there are none", "[cli][scene_command]") {
  const Folder folder;
  const Run fcc = folder.lorentz("scene show fcc");
  CHECK(fcc.status == 0);
  CHECK(fcc.err.empty());
  for (const char* part :
       {"cell volume  0.25", "sphere of radius 0.28", "none touch, none overlap",
        "filling        0.3678092903 of space", "horizon",
        "mean free path 0.6416854364 between hits: 4 (1 - filling) / (surface per volume "})
    CHECK(contains(fcc.out, part));
  // (2, 0) touches and (1, 0) overlaps: the warning is of the worse.
  CHECK(contains(folder.lorentz("horizon square --radius 1").err, "overlap their own translates"));
  CHECK(contains(fcc.out, "infinite: 4 normals of planar channels"));
  CHECK(contains(folder.lorentz("scene show cesium-chloride").out, "infinite: 25 directions of cylindrical"));
  CHECK(contains(folder.lorentz("scene show triangular").out, "finite: every path ends"));
  const std::string two =
      folder
          .lorentz("scene show " + folder.write("two.toml",
                                                "dimension = 2\nlattices = [{vectors = [[1, 0], [0, 1]], "
                                                "atoms = [{position = [0, 0], radius = 0.125}, "
                                                "{position = [0.5, 0.25], radius = 0.25}]}]\n"))
          .out;
  CHECK(contains(two, "disc of radius 0.125 at (0, 0)"));
  CHECK(contains(two, "disc of radius 0.25 at (0.5, 0.25)"));
  const Run touching = folder.lorentz("scene show square --radius 0.5");
  CHECK(contains(touching.out, "0 overlap, 2 touch"));
  CHECK(contains(touching.out, "atom 0 touches atom 0 of cell (1, 0)"));
  CHECK(contains(touching.out, "0.2146018366"));
  const Run overlapping = folder.lorentz("scene show overlapping");
  CHECK(contains(overlapping.out, "atom 0 overlaps atom 1 of cell (0, 0)"));
  CHECK(contains(overlapping.out, "not given, for obstacles overlap"));
  CHECK(contains(folder.lorentz("scene show square --radius 1e9").out, "and 990 more"));
  CHECK(contains(folder.lorentz("scene show superposition-pi-5").out, "of two lattices overlap"));
  CHECK(contains(
      folder
          .lorentz("scene show " + folder.write("row.toml",
                                                "dimension = 3\nlattices = [{vectors = [[1, 0, 0]], atoms = "
                                                "[{position = [0, 0, 0], radius = 0.6}]}]\n"))
          .out,
      "of cell (1)\n"));
  const Run json = folder.lorentz("scene show square --radius 0.5 --json");
  CHECK(contains(json.out,
                 R"("contacts":{"count":2,"complete":true,"first":[{"lattice":0,"atom":0,"other_lattice":0,)"
                 R"("other_atom":0,"cell":[0,1],"kind":"touch"})"));
  CHECK(contains(json.out, R"("scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]])"));
  CHECK(contains(folder.lorentz("scene show overlapping --json").out, R"("filling":null)"));

  // Discs and ellipses on lines that are far apart: 2 pairs overlap and 3 touch.
  const std::string file = folder.write("pairs.toml", R"(dimension = 2
[[lattices]]
vectors = [[64, 0], [0, 64]]
atoms = [{ position = [0, 0], radius = 1 }, { position = [2, 0], radius = 1 },
         { position = [20, 0], radius = 1 }, { position = [21.5, 0], radius = 1 },
         { position = [0, 20], semiaxes = [[2, 0], [0, 1]] }, { position = [4, 20], semiaxes = [[2, 0], [0, 1]] },
         { position = [20, 20], semiaxes = [[2, 0], [0, 1]] }, { position = [20, 21.75], semiaxes = [[2, 0], [0, 1]] },
         { position = [0, 40], semiaxes = [[2, 0], [0, 1]] }, { position = [0, 42.5], radius = 1.5 }]
)");
  const Run pairs = folder.lorentz("scene show " + file);
  INFO(pairs.out << pairs.err);
  CHECK(contains(pairs.out, "2 overlap, 3 touch"));
  for (const char* part :
       {"atom 0 touches atom 1 of", "atom 2 overlaps atom 3 of", "atom 4 touches atom 5 of",
        "atom 6 overlaps atom 7 of", "atom 8 touches atom 9 of"})
    CHECK(contains(pairs.out, part));
  const Run counted = folder.lorentz("scene show " + file + " --json");
  CHECK(contains(counted.out, R"("contacts":{"count":5,"complete":true)"));
  CHECK(contains(counted.out, R"("other_atom":3,"cell":[0,0],"kind":"overlap"})"));

  const Run mistyped = folder.lorentz("scene show fccc");
  CHECK(mistyped.status == 2);
  CHECK(contains(mistyped.err, "diamond, "));
  CHECK(folder.lorentz("scene show nowhere/fcc").status == 3);
  CHECK(folder.lorentz("scene show fcc.toml").status == 3);
  CHECK(folder.lorentz("scene").status == 2);
  CHECK(folder.lorentz("scene show --radius 0.1").status == 2);
  CHECK(folder.lorentz("scene show ellipse --radius 0.1").status == 2);
  const Run paint = folder.lorentz("scene paint square");
  CHECK(paint.status == 2);
  CHECK(contains(paint.err, "no subcommand is called \"paint\"; there are show, draw"));
  for (const char* help : {"scene --help", "scene show --help", "scene draw --help"})
    CHECK(contains(folder.lorentz(help).out, "Example:"));
}

TEST_CASE("Flights and exponents refuse scenes that are not crystals", "[cli][scene_command]") {
  const Folder folder;
  for (const char* command : {"flights --count 100", "lyapunov", "diffusion"}) {
    const Run run = folder.lorentz(std::string(command) + " --scene layer");
    INFO(command << run.err);
    CHECK((run.status == 2 && run.out.empty()));
    CHECK(contains(run.err, "in crystals only; layer has lattices that repeat in fewer directions"));
  }
}

TEST_CASE("scene draw: well-formed pictures of the whole catalogue", "[cli][scene_command]") {
  const Folder folder;
  for (const auto& file : fs::directory_iterator(std::string(LORENTZ_SOURCE_DIR) + "/data/scenes")) {
    const Run run = folder.lorentz("scene draw " + file.path().stem().string());
    INFO(file.path() << run.err);
    CHECK(run.status == 0);
    CHECK(is_well_formed(run.out));
    CHECK_FALSE(contains(run.out, "nan"));
    CHECK(contains(run.out, "viewBox=\"0 0 800 "));
    CHECK(run.out.size() < 100'000);
  }
  // 4 x 4 cells around the first hold 4 x 4 discs; one more in the legend.
  CHECK(count_of(folder.lorentz("scene draw square").out, "<circle") == 16 + 1);
  // 2 x 2 x 2 cells have 27 corners.
  CHECK(count_of(folder.lorentz("scene draw cubic").out, "<circle") == 27 + 1);
  // Nothing is repeated where a lattice does not: one ball, three of a row, 3 x 3 of a layer; with the
  // legend.
  for (const auto& [name, count] : {std::pair("ball", 1), std::pair("row", 3), std::pair("layer", 9)}) {
    const std::string out = folder.lorentz(std::string("scene draw ") + name).out;
    INFO(name);
    CHECK(count_of(out, "<circle") + count_of(out, "<ellipse") == static_cast<std::size_t>(count) + 1);
    CHECK_FALSE(contains(out, "cell"));
  }
  CHECK(folder.lorentz("scene draw square -o " + folder.file("p.svg")).out.empty());
  CHECK(is_well_formed(folder.read("p.svg")));
  CHECK(folder.lorentz("scene draw square -o /nowhere/p.svg").status == 3);
  CHECK(folder.lorentz("scene draw").status == 2);
  const Run raster = folder.lorentz("scene draw square -o " + folder.file("p.png"));
  CHECK(raster.status == 2);
  CHECK(contains(raster.err, "p.png: pictures are drawn as SVG"));
  CHECK_FALSE(fs::exists(folder.file("p.png")));
  const auto odd = folder.write("a&b<c>.toml",
                                "dimension = 2\nlattices = [{vectors = [[1e-9, 0], [1e9, 1]], atoms = "
                                "[{position = [0, 0], radius = 0.1}]}]\n");
  const Run strange = folder.lorentz("scene draw '" + odd + "'");
  CHECK(strange.status == 0);
  CHECK(is_well_formed(strange.out));
  CHECK(contains(strange.out, "a&amp;b&lt;c&gt;"));
}

TEST_CASE("scene draw: flights end at the exact first hit", "[cli][scene_command]") {
  const Folder folder;
  // From (1/2, 0) to the disc of (1, 0): 1/4 of the cell long.
  const Run hit = folder.lorentz("scene draw --queries " + folder.write("q", kScene + kGood));
  INFO(hit.out << hit.err);
  CHECK(hit.status == 0);
  CHECK(hit.err.empty());
  CHECK(is_well_formed(hit.out));
  CHECK(count_of(hit.out, "stroke=\"#c0182b\" stroke-width=\"2\"") == 1);  // the obstacle that is hit
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0, cell1 = 0, cell2 = 0;
  const auto flight = hit.out.find("stroke=\"#c0182b\" stroke-width=\"1.4\"/>");
  REQUIRE(flight != std::string::npos);
  const auto line = hit.out.rfind("points=\"", flight), cell = hit.out.find("<polygon points=\"");
  REQUIRE(std::sscanf(hit.out.c_str() + line, "points=\"%lf,%lf %lf,%lf", &x1, &y1, &x2, &y2) == 4);
  REQUIRE(std::sscanf(hit.out.c_str() + cell, "<polygon points=\"%lf,%*f %lf", &cell1, &cell2) == 2);
  CHECK(x2 - x1 == Approx((cell2 - cell1) / 4).margin(0.02));
  CHECK(x1 - cell1 == Approx((cell2 - cell1) / 2).margin(0.02));
  CHECK(y1 == y2);
  const Run up =
      folder.lorentz("scene draw --queries " + folder.write("q1", kScene + R"({"x":[0,0.5],"v":[0,1]})"
                                                                           "\n"));
  const auto upwards = up.out.find("stroke=\"#c0182b\" stroke-width=\"1.4\"/>");
  REQUIRE(upwards != std::string::npos);
  REQUIRE(std::sscanf(up.out.c_str() + up.out.rfind("points=\"", upwards), "points=\"%lf,%lf %lf,%lf", &x1,
                      &y1, &x2, &y2) == 4);
  CHECK(x1 == x2);
  CHECK(y2 < y1 - 20);

  const Run never = folder.lorentz("scene draw cubic --queries " +
                                   folder.write("q2", R"({"x":[0.5,0.5,0.5],"v":[0,0,1]})"
                                                      "\n"
                                                      R"({"x":[0.05,0,0],"v":[0,0,1]})"
                                                      "\n"
                                                      R"({"x":[0.5,0.5,0.5],"v":[1,1e-9,0]})"
                                                      "\n"
                                                      R"({"x":[1e6,0.5,0.5],"v":[1,1e-9,0]})"
                                                      "\n"));
  CHECK(never.status == 0);
  CHECK(is_well_formed(never.out));
  CHECK(contains(never.err, "flights left out"));
  // A second scene does not fit into the picture; a bad line is complained of.
  CHECK(contains(folder.lorentz("scene draw --queries " + folder.write("q3", kScene + kGood + kScene)).err,
                 "first scene"));
  CHECK(folder.lorentz("scene draw --queries " + folder.write("q4", kScene + "bad\n" + kGood)).status == 2);
  CHECK(folder.lorentz("scene draw --queries " + folder.write("q5", kGood)).status == 2);
  const std::string limited = folder.write("q6", kScene + R"({"x":[0.5,0],"v":[1,0],"max_time":0.1})");
  CHECK(
      contains(folder.lorentz("scene draw --queries " + limited).err, "1 (nothing is hit before max_time)"));
}

namespace {

// What the program prints if a terminal listens on stdout and stderr.
std::string on_terminal(const std::string& arguments) {
  int terminal = 0;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  REQUIRE(child >= 0);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", (std::string("exec ") + LORENTZ_PROGRAM + " " + arguments).c_str(), nullptr);
    _exit(127);
  }
  std::string out;
  char buffer[4096];
  for (ssize_t size = 0; (size = read(terminal, buffer, sizeof buffer)) > 0;)
    out.append(buffer, static_cast<std::size_t>(size));
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return out;
}

const std::string kSlender =
    "dimension = 3\nlattices = [{vectors = [[1, 0, 0], [0, 1, 0], [0.3, 0.7, 1e-9]], atoms = [{position = "
    "[0, 0, 0], radius = 1e-4}]}]\n";

}  // namespace

TEST_CASE("horizon and scene show: a search that is too long is refused before it begins",
          "[cli][scene_command]") {
  const Folder folder;
  const auto slender = folder.write("slender.toml", kSlender);
  const std::string lorentz = std::string("timeout 300 ") + LORENTZ_PROGRAM;
  const Run refused = folder.run(lorentz + " horizon " + slender);
  CHECK(refused.status == 2);
  CHECK(refused.out.empty());
  CHECK(contains(refused.err, "too many planes could leave a channel open; --min-width W restricts"));
  CHECK(folder.run(lorentz + " horizon --min-width 0.1 " + slender).status == 0);
  const Run shown = folder.run(lorentz + " scene show " + slender);
  CHECK(shown.status == 0);
  CHECK(contains(shown.out, "cell volume  1e-09"));
  CHECK(contains(shown.out, "horizon        not searched: too many planes"));

  // Nor is one that would take long.
  const Run left_out = folder.run(lorentz + " scene show square --radius 4.5e-4");
  CHECK(left_out.status == 0);
  CHECK(contains(left_out.out, "mean free path"));
  CHECK(contains(left_out.out, " directions to look along would take long; see `lorentz horizon"));
}

TEST_CASE("scene: cells beyond binary64 are told, and not drawn", "[cli][scene_command]") {
  const Folder folder;
  const auto tiny = folder.write("tiny.toml",
                                 "dimension = 2\nlattices = [{vectors = [[1e-180, 0], [0, 1e-180]], atoms = "
                                 "[{position = [0, 0], radius = 3e-181}]}]\n");
  CHECK(contains(folder.lorentz("scene show " + tiny).out, "cell area    beyond the range of binary64"));
  CHECK(folder.lorentz("scene draw " + tiny).status == 2);
}

TEST_CASE("horizon: a search of seconds is seen on a terminal, and nowhere else", "[cli][scene_command]") {
  const Folder folder;
  const std::string search = "horizon square --radius 0.02";
  CHECK_FALSE(contains(on_terminal(search), "directions ["));  // it is short
  setenv("LORENTZ_PROGRESS_AFTER", "0", 1);
  const std::string seen = on_terminal(search);
  const Run piped = folder.lorentz(search);
  unsetenv("LORENTZ_PROGRESS_AFTER");
  INFO(seen);
  CHECK(contains(seen, "\rdirections ["));
  CHECK(contains(seen, "\r\033[Kinfinite horizon: "));
  CHECK(piped.err.empty());
  CHECK(piped.out.starts_with("infinite horizon: "));
}

TEST_CASE("horizon: the tail, or that there is none", "[cli][scene_command]") {
  const Folder folder;
  CHECK(contains(folder.lorentz("horizon cubic --radius 0.5").out,
                 "in 3 planes\n\nplanes (1 0 0): the obstacles just touch; cylindrical channels in all but"));
  CHECK(contains(folder.lorentz("horizon triangular").out, "tail: none, the free path is bounded\n"));
  CHECK(
      contains(folder.lorentz("horizon overlapping-pockets").out, "tail: none, the free path is bounded\n"));
  CHECK(contains(folder.lorentz("horizon cesium-chloride").out,
                 "tail: P(free path > t) falls faster than 1/t"));
  CHECK(contains(folder.lorentz("horizon square").out, "tail: P(free path > t) ~ C / t"));
  const Run wide = folder.lorentz("horizon square --min-width 0.9");
  CHECK(contains(wide.out, "not with a least width"));
  CHECK_FALSE(contains(wide.out, "tail: none"));
  // A hole of 6e-17 is not a hole of 0.
  CHECK(contains(folder.lorentz("horizon cubic --radius 0.7071067811865475").out, "6.26858e-17"));
}

TEST_CASE("scene draw: window, size, title, legend, channels", "[cli][scene_command]") {
  const Folder folder;
  const std::string scene = folder.write("three & three.toml",
                                         "dimension = 2\nlattices = [{vectors = [[1, 0], [0, 1]], atoms = "
                                         "[{position = [0, 0], radius = 0.3}]}]\n");
  const Run run = folder.lorentz("scene draw '" + scene +
                                 "' --radius 0.2 --window=-0.5,-0.5,2.5,2.5 --size 600x500 --channels 1");
  CHECK(run.status == 0);
  CHECK(is_well_formed(run.out));
  CHECK(contains(run.out, "viewBox=\"0 0 600 "));
  CHECK(contains(run.out, "three &amp; three.toml"));
  CHECK(contains(run.out, "corridor [1 0]: width 0.6"));
  CHECK_FALSE(contains(run.out, "corridor [0 1]"));
  CHECK(count_of(run.out, "<circle") == 9 + 1);
  const std::string tiny = folder.write(  // what is too narrow to be seen depends on the unit
      "tiny.json",
      R"({"dimension":2,"lattices":[{"vectors":[[1e-9,0],[0,1e-9]],"atoms":[{"position":[0,0],"radius":1e-10}]}]})");
  CHECK(contains(folder.lorentz("scene draw " + tiny + " --channels 1").out, "width 8e-10"));
  const Run solid = folder.lorentz("scene draw fcc --channels 1");
  CHECK(solid.status == 2);
  CHECK(
      contains(solid.err, "--channels: is for scenes in the plane; lorentz horizon lists those of this one"));
  CHECK(contains(folder.lorentz("scene draw triangular --channels 1").err,
                 "no channels are drawn: none is known to be open"));
  const Run fine = folder.lorentz("scene draw square --radius 1e-9 --channels 1");
  CHECK(fine.status == 0);
  CHECK(contains(fine.err, "no channels are drawn: too many directions"));
  for (const char* large : {"0,0,1,1e300", "0,0,1e300,1"})
    CHECK(contains(folder.lorentz("scene draw square --window " + std::string(large)).err,
                   "--window: is too large"));
  for (const char* bad : {"square --window 0,0,1", "square --window 1,0,0,1", "square --window 0,0,x,1",
                          "cubic --window 0,0,1,1", "square --size 10", "square --size 300x",
                          "square --size x", "square --size 300x300x3", "square --channels 0"}) {
    INFO(bad);
    CHECK(folder.lorentz(std::string("scene draw ") + bad).status == 2);
  }
  // Nothing of the paper's 89 flights is in a corner.
  const Run paper = folder.lorentz("scene draw --queries " + std::string(LORENTZ_SOURCE_DIR) +
                                   "/data/examples/paper-89-directions.queries.ndjson");
  CHECK(contains(paper.err, "flights that go on beyond the picture: 6"));
  CHECK(count_of(paper.out, "<circle") < 2 * 89 + 300);
}

TEST_CASE("scene draw -o: whole or not at all, and over nothing but a picture", "[cli][scene_command]") {
  const Folder folder;
  const auto list = folder.write("queries.ndjson", kScene + kGood);
  const Run refused = folder.lorentz("scene draw square -o " + list);
  CHECK(refused.status == 2);
  CHECK(contains(refused.err, "queries.ndjson: is not an SVG, and is left as it is"));
  CHECK(folder.read("queries.ndjson") == kScene + kGood);
  // A file of blanks holds something, too. One that cannot be read (by others than root) may.
  const auto blanks = folder.write("blanks", "\n \n");
  CHECK(folder.lorentz("scene draw square -o " + blanks).status == 2);
  CHECK(folder.read("blanks") == "\n \n");
  fs::permissions(blanks, fs::perms::owner_write);
  if (!std::ifstream(blanks)) CHECK(folder.lorentz("scene draw square -o " + blanks).status == 3);
  // An empty file, an older picture, a link to it: its mode stays, and nothing else is left in the folder.
  const auto picture = folder.write("p.svg", "");
  CHECK(folder.lorentz("scene draw square -o " + picture).status == 0);
  fs::permissions(picture, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(picture, folder.file("link.svg"));
  CHECK(folder.lorentz("scene draw triangular -o " + folder.file("link.svg")).status == 0);
  CHECK(fs::is_symlink(folder.file("link.svg")));
  CHECK(contains(folder.read("p.svg"), "triangular"));
  CHECK(fs::status(picture).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  std::size_t files = 0;
  for (const auto& file : fs::directory_iterator(folder.file(""))) files += contains(file.path(), "p.svg");
  CHECK(files == 1);
  // No room for the new one, and the old one stands. (A limit of 4 blocks of 512 bytes; the signal is
  // ignored.)
  const std::string before = folder.read("p.svg");
  CHECK(folder
            .run("trap '' XFSZ; ulimit -f 4; exec " + std::string(LORENTZ_PROGRAM) +
                 " scene draw kagome -o " + picture)
            .status == 3);
  CHECK(folder.read("p.svg") == before);
  CHECK(folder.run("ulimit -f 4; exec " + std::string(LORENTZ_PROGRAM) + " scene draw kagome -o " + picture)
            .status != 0);  // killed by the signal
  CHECK(folder.read("p.svg") == before);
  CHECK(folder.lorentz("scene draw square -o /dev/null").status == 0);
}

TEST_CASE("horizon: verdicts, tables, JSON and refusals", "[cli][scene_command]") {
  const Folder folder;
  const Run square = folder.lorentz("horizon square --radius 0.4");
  CHECK(square.status == 0);
  CHECK(square.err.empty());
  CHECK(square.out.starts_with("infinite horizon: 2 corridor directions\n"));
  CHECK(contains(square.out, "\ndirection  width  vector  through\n"));
  CHECK(contains(square.out, "\n[1 0]        0.2     1 0    0 0.5\n"));
  CHECK(contains(folder.lorentz("horizon cubic --radius 0.45").out,
                 "\nplanes   width  normal  through\n"
                 "-------  -----  ------  -------\n"
                 "(1 0 0)    0.1   1 0 0  0.5 0 0\n"));
  CHECK(contains(square.out, "C = 0.0512014"));
  CHECK(folder.lorentz("horizon square --radius 0.5").out.starts_with("finite horizon"));
  CHECK(contains(folder.lorentz("horizon cubic").out,
                 "\n... and 173 more (--json has them)\n"));  // of 193 channels
  CHECK(contains(folder.lorentz("horizon square --radius 0.4 --min-width 0.3").out, "no channel is so wide"));
  const std::string json = folder.lorentz("horizon square --radius 0.4 --json").out;
  CHECK(contains(json, R"("horizon":"infinite","directions":2)"));
  CHECK(contains(
      json,
      R"({"direction":[1,0],"vector":[1,0],"width":0.19999999999999996,"point":[0,0.5],"point_inside":true,"count":1})"));
  const Run small = folder.lorentz("horizon square --radius 1e-9");
  CHECK(small.status == 2);
  CHECK(small.out.empty());
  CHECK(contains(small.err, "--min-width W"));
  CHECK(folder.lorentz("horizon square --radius 1e-9 --min-width 0.2").status == 0);
  CHECK(contains(folder.lorentz("horizon cubic").out, "193 normals of planar channels"));
  CHECK(contains(folder.lorentz("horizon cubic --radius 0.45 --json").out, R"("direction":[1,1,1])"));
  for (const char* bad :
       {"horizon", "horizon square cubic", "horizon square --min-width 0", "horizon square --radius x"}) {
    INFO(bad);
    CHECK(folder.lorentz(bad).status == 2);
  }
  CHECK(folder.lorentz("horizon nowhere").status == 2);
}

TEST_CASE("horizon: of crystals only", "[cli][scene_command]") {
  const Folder folder;
  for (const auto& [bad, why] : {std::pair("horizon ball", "crystals only"),
                                 {"horizon layer", "crystals only"},
                                 {"horizon grating", "crystals only"},
                                 {"horizon impurity", "crystals only"},
                                 {"scene draw grating --channels 3", "crystals only"}}) {
    const Run run = folder.lorentz(bad);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(contains(run.err, why));
  }
  CHECK(contains(folder.lorentz("scene show ball").out, "crystals only"));
}
