// lorentz golden: make, list, check, verify, explain, as its users call them.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

const std::string kCommitted = std::string(LORENTZ_SOURCE_DIR) + "/data/golden/";

// An id and its record in a text of records: the first that holds all these words.
std::string record_with(const std::string& text, std::initializer_list<const char*> words) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    bool all = line.starts_with("{\"id\"");
    for (const char* word : words) all &= contains(line, word);
    if (all) return line;
  }
  throw std::logic_error("no such record");
}

std::string id_in(const std::string& record) {
  return between(record, "{\"id\":\"", "\"");
}

std::string committed(const Folder& folder, const std::string& name) {
  fs::copy_file(kCommitted + name + ".ndjson", folder.file(name + ".ndjson"));
  return folder.read(name + ".ndjson");
}

std::size_t line_of(const std::string& text, const std::string& record) {
  return lines(text.substr(0, text.find(record))) + 1;
}

int python_check(const Folder& folder, const std::string& files) {
  const std::string command = LORENTZ_PYTHON " " LORENTZ_SOURCE_DIR "/data/check.py " + files + " >" +
                              folder.file("py.out") + " 2>&1";
  return WEXITSTATUS(std::system(command.c_str()));
}

}  // namespace

TEST_CASE("golden make: to a file and to standard output, with one thread and several, the same",
          "[golden][golden_command]") {
  const Folder folder;
  const std::string order = "golden make --set ties --count 150 --seed 5";
  const Run out = folder.lorentz(order);
  CHECK(out.status == 0);
  CHECK(lines(out.out) > 151);
  CHECK(contains(out.err, "ties: 150 records (seed 5)"));
  const Run file = folder.lorentz(order + " --jobs 3 -o " + folder.file("set"));
  CHECK(file.status == 0);
  CHECK(file.out.empty());
  CHECK((folder.read("set") == out.out));
  CHECK((folder.lorentz(order + " --jobs 5").out == out.out));
  CHECK((folder.lorentz("golden make --set ties --count 150").out != out.out));
  // What the header says made it makes it.
  const std::string generator = between(out.out, "\"generator\":\"lorentz ", "\"");
  CHECK((folder.lorentz(generator).out == out.out));
  const std::string given = folder.write("given", R"({"id":1,"x":[0.5,0.5],"v":[1,0.25]})"
                                                  "\n");
  const std::string make = "cd " + folder.file("") + " && " LORENTZ_PROGRAM " ",
                    line = "golden make --queries " + given + " --scene square --radius 0.3 -o mine.ndjson";
  CHECK(folder.run(make + line).status == 0);
  const std::string mine = folder.read("mine.ndjson"), its = between(mine, "\"generator\":\"lorentz ", "\"");
  CHECK(its == line);
  fs::remove(folder.file("mine.ndjson"));
  CHECK(folder.run(make + its).status == 0);
  CHECK(folder.read("mine.ndjson") == mine);
  CHECK(folder.lorentz("golden verify " + folder.file("set")).status == 0);
  CHECK(python_check(folder, folder.file("set")) == 0);
}

TEST_CASE("golden make: the committed sets are what it makes", "[golden][golden_command]") {
  const Folder folder;
  // The last four draw starts at the edges of obstacles, in steps of ulps.
  for (const std::string set : {"ties", "crystals", "ellipsoids", "rows-and-layers", "superpositions"}) {
    INFO(set);
    CHECK(folder.lorentz("golden make --set " + set + " --jobs 2 -o " + folder.file(set)).status == 0);
    CHECK((folder.read(set) == committed(folder, set)));
  }
  CHECK((folder.lorentz("golden make --set bad-queries").out == committed(folder, "bad-queries")));
  for (const golden::Set& set : golden::sets()) {
    if (set.precision == NumberFormat::binary64 || !set.is_committed) continue;
    INFO(set.name);
    // By the command in its header, whatever the number of threads.
    const std::string text = committed(folder, set.name);
    const std::string command = between(text, "\"generator\":\"lorentz ", "\"");
    CHECK(contains(command, "--precision binary32"));
    CHECK((folder.lorentz(command + " --jobs 2").out == text));
  }
  CHECK(contains(folder.lorentz("golden make --set bad-queries --count 1000").err,
                 "there are 115 records, not 1000"));
}

TEST_CASE("golden make: proofs of long flights need no large stack", "[golden][golden_command]") {
#ifdef __SANITIZE_ADDRESS__
  const std::string kilobytes = "1024";  // its frames are wide
#else
  const std::string kilobytes = "128";
#endif
  const std::string make = LORENTZ_PROGRAM " golden make --set long-flight --count 10";
  const Run run = Folder().run("ulimit -s " + kilobytes + "; " + make);
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(contains(run.err, "all 10 answers agreed by their checked certificates"));
}

TEST_CASE("golden make: all sets, and their sums", "[golden][golden_command][long]") {
  const Folder folder;
  CHECK(folder.lorentz("golden make --all " + folder.file("new/all") + " --jobs 2").status == 0);
  const std::string diff = "diff -r -x schema.json -x itineraries -x answers -x SHA256SUMS " +
                           folder.file("new/all") + " " + kCommitted;
  CHECK(std::system(diff.c_str()) == 0);
  CHECK(std::system(("cd " + folder.file("new/all") + " && sha256sum --quiet -c SHA256SUMS").c_str()) == 0);
  CHECK(lines(folder.read("new/all/SHA256SUMS")) == 35);
}

TEST_CASE("golden make: bad usage, and folders that cannot be written", "[golden][golden_command]") {
  const Folder folder;
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const Run run = folder.lorentz("golden make " + arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, word));
    CHECK(run.out.empty());
  };
  refused("", "--set");
  refused("--set nonsense", "generic-2d");
  for (const char* count : {"0", "-1", "1.5", "x", "1e13"})
    refused(std::string("--set ties --count ") + count, "--count");
  for (const char* seed : {"-1", "x", "1.5", "18446744073709551616"})
    refused(std::string("--set ties --seed ") + seed, "--seed");
  for (const char* jobs : {"0", "-1", "5000"}) refused(std::string("--set ties --jobs ") + jobs, "--jobs");
  refused("--set ties --all " + folder.file("all"), "--all");
  refused("--precision binary32 --all " + folder.file("all"), "--all");
  refused("-o set --all " + folder.file("all"), "-o");
  refused("--set bad-queries --precision binary32", "the set bad-queries is of binary64 only");
  refused("--set ties-binary32 --precision binary64", "the set ties-binary32 is of binary32 only");
  refused("--set ties --precision binary16", "--precision");
  CHECK_FALSE(fs::exists(folder.file("all")));
  for (const char* place : {"/no/such/folder/set", "/proc/set"}) {
    const Run run = folder.lorentz(std::string("golden make --set ties --count 32 -o ") + place);
    CHECK(run.status == 3);
    CHECK(contains(run.err, place));
  }
  CHECK(folder.lorentz("golden make --all /proc/no").status == 3);
  CHECK(folder.lorentz("golden nonsense").status == 2);
  CHECK(folder.lorentz("golden").status == 2);
}

TEST_CASE("golden list: every set with its records, also as JSON", "[golden][golden_command]") {
  const Folder folder;
  const Run table = folder.lorentz("golden list"), json = folder.lorentz("golden list --json");
  CHECK(table.status == 0);
  CHECK(json.status == 0);
  for (const golden::Set& set : golden::sets()) {
    CHECK(contains(table.out, set.name + " "));
    CHECK(contains(json.out, "{\"name\":\"" + set.name + "\",\"committed\":" +
                                 (set.name == "bad-queries"                 ? "115,"
                                  : set.precision == NumberFormat::binary64 ? "640,"
                                  : set.is_committed                        ? "200,"
                                                                            : "0,")));
  }
  CHECK(json.out.starts_with("{\"sets\":["));
  CHECK(json.out.ends_with("]}\n"));
  const std::string validate = LORENTZ_PYTHON " -m json.tool " + folder.file("out") + " >/dev/null";
  CHECK(std::system(validate.c_str()) == 0);
}

TEST_CASE("golden verify: good sets, tampered ones, garbage, and none", "[golden][golden_command]") {
  const Folder folder;
  CHECK(folder.lorentz("golden verify ties never bad-queries --walk").status == 0);
  CHECK(contains(folder.lorentz("golden verify bad-queries").out, "115 records, all verified"));
  const std::string text = committed(folder, "ties");
  const auto verified = [&](const std::string& changed) {
    return folder.lorentz("golden verify " + folder.write("t", changed));
  };
  const std::string record = record_with(text, {"\"outcome\":\"hit\""});
  const std::string place = folder.file("t:") + std::to_string(line_of(text, record)) + ": ";
  const auto refuted = [&](const std::string& changed, const std::string& where, const std::string& why) {
    const Run run = verified(changed);
    INFO(run.err);
    CHECK(run.status == 1);
    CHECK(run.err.starts_with("lorentz: " + where));
    CHECK(contains(run.err, why));
    CHECK(contains(run.out, "REFUTED"));
  };
  const std::string margin = "\"margin\":" + between(record, "\"margin\":", ",") + ",";
  const std::string condition = "\"condition\":" + between(record, "\"condition\":", ",") + ",";
  refuted(replaced(text, record, replaced(record, margin, "\"margin\":3.125,")), place, "margin");
  refuted(replaced(text, record, replaced(record, condition, "\"condition\":3.125,")), place, "condition");
  refuted(replaced(text, record, replaced(record, "\"tags\":[\"", "\"tags\":[\"unknown\",\"")), place,
          "unknown");
  refuted(replaced(text, record, replaced(record, id_in(record), "0123456789abcdef")), place, "the id");
  refuted(replaced(text, record, replaced(record, "\"windows\":[{", "\"windows\":[],\"old\":[{")), place, "");
  refuted(replaced(text, record, record + "\n" + record), folder.file("t:"), "came before");
  refuted(replaced(text, record + "\n", ""), folder.file("t:1: "), "640 records, there are 639");
  refuted(replaced(text, "{\"scene\":{", "{\"scene\": {"), folder.file("t:3: "), "the id");
  // A time that is false by an ulp, in a notation of 20 digits and more.
  const std::string time = between(record, "\"expect\":{", "}");
  const double right = std::stod(time.substr(time.find("\"time\":") + 7));
  char digits[512];
  std::snprintf(digits, sizeof digits, "\"time\":%.25f", std::nextafter(right, 2 * right));
  const std::string exact = "\"time\":" + time.substr(time.find("\"time\":") + 7);
  refuted(replaced(text, record, replaced(record, exact, digits)), place, "time");
  std::snprintf(digits, sizeof digits, "\"time\":%.60f", right);
  CHECK(verified(replaced(text, record, replaced(record, exact, digits))).status == 0);
  // Twenty complaints are enough.
  const Run many = verified(replaced(text, "\"tags\":{\"", "\"tags\":{\"no-"));
  CHECK(many.status == 1);
  CHECK(lines(many.err) == 21);
  CHECK(contains(many.err, " more\n"));
  for (const char* garbage : {"garbage\n", "", "{\"golden\":3}\n", "{\"golden\":{\"format\":9}}\n"}) {
    INFO(garbage);
    CHECK(verified(garbage).status == 2);
  }
  CHECK(verified(replaced(text, record, "garbage")).status == 2);
  CHECK(verified(text.substr(0, text.size() - 20)).status == 2);
  const Run missing = folder.lorentz("golden verify /no/such/file");
  CHECK(missing.status == 3);
  CHECK(contains(missing.err, "/no/such/file"));
  CHECK(contains(missing.err, "generic-2d"));
}

TEST_CASE("golden verify and check.py find one wrong record planted in a copy of committed sets",
          "[golden][golden_command]") {
  const Folder folder;
  fs::create_directories(folder.file("data/golden"));
  for (const char* set : {"superpositions", "ties", "bad-queries"}) {
    const std::string text = beginning_of_set(folder, set, 100);
    folder.write("data/golden/" + std::string(set) + ".ndjson", text);
  }
  const std::string name = "data/golden/superpositions.ndjson", text = folder.read(name);
  setenv("LORENTZ_DATA", folder.file("data").c_str(), 1);
  CHECK(folder.lorentz("golden verify").status == 0);
  const std::string record = record_with(text, {"\"outcome\":\"hit\"", "\"atom\":0,\"cell\""});
  const std::string answer = between(record, "\"expect\":{", "}");
  const std::string time = between(record, "\"time_decimal\":\"", "\"");
  // Another obstacle; another digit; never.
  const std::string wrong_cell = replaced(record, "\"cell\":[", "\"cell\":[1");
  std::string digit = time;
  digit.back() = digit.back() == '1' ? '2' : '1';
  for (const std::string& planted :
       {wrong_cell, replaced(record, time, digit), replaced(record, answer, "\"outcome\":\"never\"")}) {
    folder.write(name, replaced(text, record, planted));
    const Run run = folder.lorentz("golden verify");
    INFO(planted << "\n" << run.err);
    CHECK(run.status == 1);
    CHECK(contains(
        run.err, "superpositions.ndjson:" + std::to_string(line_of(text, record)) + ": id " + id_in(record)));
    CHECK(lines(run.err) == 1);
    CHECK(python_check(folder, folder.file("data/golden/ties.ndjson ") + folder.file(name)) == 1);
    CHECK(contains(folder.read("py.out"), id_in(record)));
  }
  unsetenv("LORENTZ_DATA");
}

TEST_CASE("golden make: into regular files only", "[golden][golden_command]") {
  const Folder folder;
  REQUIRE(mkfifo(folder.file("pipe").c_str(), 0600) == 0);
  const Run pipe = folder.lorentz("golden make --set ties --count 3 -o " + folder.file("pipe"));
  CHECK(pipe.status == 3);
  CHECK(contains(pipe.err, "is not a regular file"));
  CHECK(std::filesystem::is_fifo(folder.file("pipe")));
  CHECK(folder.lorentz("golden make --set ties --count 3 -o " + folder.file("set")).status == 0);
  CHECK(lines(folder.read("set")) == 5);
}

TEST_CASE("golden make overwrites golden sets, and nothing else", "[golden][golden_command]") {
  const Folder folder;
  const std::string make = "golden make --set ties --count 32 -o ";
  const std::string notes = folder.write("notes.txt", "not to be lost\n");
  const Run refused = folder.lorentz(make + notes);
  CHECK(refused.status == 2);
  CHECK(contains(refused.err, "notes.txt: is not a golden set, and is left as it is"));
  CHECK(folder.read("notes.txt") == "not to be lost\n");
  for (int twice = 0; twice < 2; ++twice) CHECK(folder.lorentz(make + folder.file("set")).status == 0);
  CHECK(folder.lorentz(make + folder.write("empty", "")).status == 0);
}
