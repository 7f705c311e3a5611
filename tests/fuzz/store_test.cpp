// The store: what goes in comes out, one writer at a time, and no other file is taken for one.
#include "fuzz/campaign/store.hpp"

#include <sqlite3.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include <lorentz/errors.hpp>
#include "tests/fuzz/campaign_support.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Store;

namespace {

fuzz::CampaignManifest manifest(const std::string& options = "options") {
  return {
      "1.2", "an engine", {"leaving", "scale"}, ~std::uint64_t{0}, options, {NumberFormat::binary32, 0.5}};
}

fuzz::Finding finding() {
  fuzz::Finding f;
  f.target = "leaving";
  f.index = 12345678901;
  f.step = 7;
  f.kind = "wrong";
  f.sort = "wrong, 2D";
  f.cause = "a cause";
  const std::string scene =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]}})";
  f.text = {scene,
            R"({"id":"query '\"","x":[0.5,0.25],"v":[1,0]})",
            R"({"id":"query '\"","outcome":"error","message":"given\n"})",
            R"({"id":"query '\"","outcome":"never"})",
            std::numeric_limits<double>::infinity(),
            0x1.23456789abcdep-300};
  f.shrunk = {scene,
              R"({"id":"q","x":[0.5,0],"v":[1,0]})",
              R"({"id":"q","outcome":"never"})",
              R"({"id":"q","outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.25})",
              12.5,
              {}};
  f.shrinking = fuzz::Shrinking::cut_short;
  f.bits = 12;
  f.complexity = 3210;
  f.tries = 99;
  return f;
}

std::set<std::string> names_in(const Folder& folder) {
  std::set<std::string> names;
  for (const auto& one : fs::directory_iterator(folder.file(""))) names.insert(one.path().filename());
  return names;
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("What is put in a store comes out of it", "[fuzz][store]") {
  const Folder folder;
  fuzz::TargetTally tally;
  tally.next = 1ull << 60;
  tally.cases = 85;  // with the variants as many as there are counts
  tally.variants = 6;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(question::Count::missing); ++k)
    tally.counts[static_cast<question::Count>(k)] = k * k;
  tally.sorts = {{"one", 1}, {"two", 2}};
  tally.margin = 4.9e-324;
  tally.margin_index = 17;
  {
    Store store(folder.file("store"), Store::Access::write);
    CHECK(store.open_campaign(manifest()) == 1);
    CHECK(store.open_campaign(manifest("others")) == 2);
    CHECK(store.open_campaign(manifest()) == 1);
    store.put(2, "leaving", tally);
    store.put(2, finding());
    store.commit();
  }
  const Store store(folder.file("store"), Store::Access::read);
  REQUIRE(store.campaigns().size() == 2);
  CHECK(store.campaigns()[1].manifest == manifest("others"));
  CHECK(text_of(store.tally(2, "leaving")) == text_of(tally));
  CHECK(text_of(store.tally(2, "scale")) == text_of(fuzz::TargetTally{}));
  CHECK(text_of(store.tally(1, "leaving")) == text_of(fuzz::TargetTally{}));
  REQUIRE(store.findings().size() == 1);
  CHECK(text_of(store.findings()[0]) == text_of(fuzz::Stored{2, finding()}));
  CHECK(store.findings()[0].label() == "2/leaving/12345678901.7");
}

TEST_CASE("What was not committed is not there, readers see what was", "[fuzz][store]") {
  const Folder folder;
  Store store(folder.file("store"), Store::Access::write);
  store.open_campaign(manifest());
  store.put(1, finding());
  CHECK(Store(folder.file("store"), Store::Access::read).findings().empty());
  store.commit();
  CHECK(Store(folder.file("store"), Store::Access::read).findings().size() == 1);
}

TEST_CASE("Two writers are refused, with what to do, also another process", "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("store");
  {
    const Store store(path, Store::Access::write);
    CHECK(contains(message_of([&] { Store other(path, Store::Access::write); }),
                   "another process is running a campaign"));
    const Run run = folder.lorentz("fuzz --count 1 --store " + path);
    CHECK(run.status == 3);
    CHECK(contains(run.err, path + ": another process is running a campaign on this store"));
    CHECK(folder.lorentz("fuzz show --store " + path).status == 0);
  }
  CHECK(folder.lorentz("fuzz -t grazing --count 1 --store " + path).status == 0);
  CHECK(names_in(folder) == std::set<std::string>{"err", "out", "store"});
}

TEST_CASE("A store without a writer is one file, and stays as it is when it is read", "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("store");
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
    store.put(1, finding());
    store.commit();
    CHECK(names_in(folder) == std::set<std::string>{"store", "store-shm", "store-wal", "store.lock"});
  }
  CHECK(names_in(folder) == std::set<std::string>{"store"});
  const std::string before = folder.read("store");
  CHECK(before.substr(18, 2) == "\1\1");  // SQLite: not to be written ahead
  CHECK(Store(path, Store::Access::read).findings().size() == 1);
  CHECK(folder.read("store") == before);
  CHECK(names_in(folder) == std::set<std::string>{"store"});
}

TEST_CASE("What a killed campaign left is read, and left", "[fuzz][store]") {
  const Folder folder;
  Store store(folder.file("store"), Store::Access::write);
  store.open_campaign(manifest());
  store.put(1, finding());
  store.commit();
  for (const std::string end : {"", "-wal", "-shm"}) fs::copy(store.path() + end, folder.file("left" + end));
  const auto before = names_in(folder);
  const std::string ahead = folder.read("left-wal");
  REQUIRE(ahead.size() > 1000);
  CHECK(Store(folder.file("left"), Store::Access::read).findings().size() == 1);
  CHECK(names_in(folder) == before);
  CHECK(folder.read("left-wal") == ahead);
}

TEST_CASE("A store that is to be written ahead is read without the files for that", "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("a ?#% b");
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
  }
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  CHECK(Store(path, Store::Access::read).campaigns().size() == 1);
  CHECK(names_in(folder) == std::set<std::string>{"a ?#% b"});
}

TEST_CASE("A store is read where nothing may be written", "[fuzz][store]") {
  const Folder folder;
  const std::string inner = folder.file("inner"), path = inner + "/store";
  fs::create_directory(inner);
  const auto is_read = [&] {
    const auto all = fs::perms::all;
    fs::permissions(inner + "/..", fs::perms(0755));
    for (const auto& one : fs::directory_iterator(inner)) fs::permissions(one, fs::perms(0444));
    fs::permissions(inner, fs::perms(0555));
    const uid_t user = geteuid();
    if (user == 0) REQUIRE(seteuid(65534) == 0);  // who may write everywhere would prove nothing
    const std::string message = message_of([&] {
      if (Store(path, Store::Access::read).findings().size() != 1)
        throw std::runtime_error("nothing is in it");
    });
    if (user == 0) REQUIRE(seteuid(user) == 0);
    fs::permissions(inner, all);
    for (const auto& one : fs::directory_iterator(inner)) fs::permissions(one, fs::perms(0644));
    return message;
  };
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
    store.put(1, finding());
    store.commit();
    CHECK(is_read() == "nothing was thrown");  // while a campaign writes
  }
  CHECK(is_read() == "nothing was thrown");
}

TEST_CASE("A file that is not a store leaves nothing beside it", "[fuzz][store]") {
  const Folder folder;
  const std::string text = folder.write("text", "this is no database " + std::string(2000, 'x'));
  CHECK(folder.lorentz("fuzz --count 1 -t grazing --store " + text).status == 3);
  CHECK(folder.lorentz("fuzz show --store " + text).status == 3);
  CHECK(folder.lorentz("fuzz show --store " + folder.file("absent")).status == 3);
  CHECK(names_in(folder) == std::set<std::string>{"err", "out", "text"});
}

TEST_CASE("Files that are not stores are left alone", "[fuzz][store]") {
  const Folder folder;
  const std::string text =
      folder.write("text", "this is no database, however long it may be: " + std::string(2000, 'x'));
  CHECK(contains(message_of([&] { Store store(text, Store::Access::write); }),
                 "is not a store of lorentz, nor any database"));
  const std::string other = folder.file("other");
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(other.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, "CREATE TABLE mine (x)", nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  const std::string before = folder.read("other");
  for (const auto access : {Store::Access::write, Store::Access::read})
    CHECK(contains(message_of([&] { Store store(other, access); }), "is a database, but no store"));
  CHECK(folder.read("other") == before);
  CHECK(
      contains(message_of([&] { Store store(folder.file("absent"), Store::Access::read); }), "No such file"));
  CHECK(contains(message_of([&] { Store store("/no/such/folder/store", Store::Access::write); }),
                 "/no/such/folder"));
}

namespace {

// What another program does to a store.
void change(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  char* why = nullptr;
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &why) != SQLITE_OK) FAIL(sql << ": " << why);
  sqlite3_close(database);
}

}  // namespace

TEST_CASE("A store with other tables, views or triggers is refused, and nothing of it runs",
          "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("store"), copy = folder.file("copy");
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
    store.put(1, finding());
    store.commit();
  }
  for (const char* sql :
       {"CREATE TRIGGER t AFTER INSERT ON finding BEGIN DELETE FROM campaign; END",
        "CREATE VIEW v AS SELECT * FROM finding", "ALTER TABLE tally ADD COLUMN more TEXT",
        "DROP TABLE tally; CREATE VIEW tally AS SELECT 1 campaign, 'leaving' target, 's' tally",
        "CREATE INDEX i ON finding (words)", "CREATE TABLE more (x)"}) {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    change(copy, sql);
    INFO(sql);
    const std::string before = folder.read("copy");
    for (const auto access : {Store::Access::write, Store::Access::read})
      CHECK(contains(message_of([&] { Store store(copy, access); }),
                     "copy: has tables, views or triggers that no"));
    CHECK(folder.read("copy") == before);
  }
}

TEST_CASE("A store with a finding that cannot be read is refused", "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("store"), copy = folder.file("copy");
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
    fuzz::Finding other = finding();
    store.put(1, other);
    other.index = 5;
    store.put(1, other);
    store.commit();
  }
  REQUIRE(Store(path, Store::Access::read).findings().size() == 2);
  for (const std::string& set :
       {std::string("finding = replace(finding, '12,3210,99', '12,3210,98')"),
        std::string("finding = replace(finding, 'a cause', 'a course')"),
        std::string("finding = substr(finding, 2)"), std::string("finding = ''"),
        std::string("finding = 'x'"), std::string("finding = x'00ff'"), std::string("finding = 7")}) {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    change(copy, "UPDATE finding SET " + set + " WHERE place = 5");
    INFO(set);
    CHECK(contains(message_of([&] { Store(copy, Store::Access::read).findings(); }), "copy: "));
    const Run list = folder.lorentz("fuzz show --json --store " + copy);
    CHECK(list.status == 3);
    CHECK(list.out.empty());
    CHECK(contains(list.err, "copy: "));
  }
}

TEST_CASE("What the answers of a finding say may be wrong in any way", "[fuzz][store]") {
  const Folder folder;
  const std::string hit = R"({"id":"q","outcome":"hit","lattice":LATTICE,"atom":0,"cell":[1,0],"time":TIME})";
  for (const auto& [lattice, time] : {std::pair{"0", "-1"}, {"0", "\"inf\""}, {"99", "0.25"}}) {
    const std::string path = folder.file(std::string("store") + lattice + time);
    {
      Store store(path, Store::Access::write);
      store.open_campaign(manifest());
      fuzz::Finding other = finding();
      other.index = 5;
      other.shrunk.given = replaced(replaced(hit, "LATTICE", lattice), "TIME", time);
      store.put(1, other);
      store.commit();
    }
    INFO(lattice << ' ' << time);
    CHECK(folder.lorentz("fuzz show --store '" + path + "'").status == 0);
    CHECK(folder.lorentz("fuzz show 1/leaving/5.7 --svg " + folder.file("svg") + " --store '" + path + "'")
              .status == 0);
  }
}

TEST_CASE("Counts and campaigns that no campaign came to are refused", "[fuzz][store]") {
  const Folder folder;
  const std::string path = folder.file("store"), copy = folder.file("copy");
  fuzz::TargetTally tally;
  tally.next = tally.cases = tally.counts[question::Count::agree] = 7;
  tally.sorts = {{"a sort", 2}};
  {
    Store store(path, Store::Access::write);
    store.open_campaign(manifest());
    store.put(1, "leaving", tally);
    store.commit();
  }
  for (const std::string& sql :
       {std::string("UPDATE tally SET tally = replace(tally, '[7,7,0,0,', '[7,8,0,0,')"),
        std::string("UPDATE tally SET tally = '[[1]]'"), std::string("UPDATE tally SET tally = 'x'"),
        std::string("UPDATE tally SET tally = x'00'"),
        std::string("UPDATE campaign SET manifest = replace(manifest, '18446744073709551615', '-1')"),
        std::string("UPDATE campaign SET manifest = '[]'"),
        std::string("UPDATE campaign SET manifest = x'00'")}) {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    change(copy, sql);
    const Run list = folder.lorentz("fuzz show --json --store " + copy);
    INFO(sql << '\n' << list.out << list.err);
    CHECK(list.status == 3);
    CHECK(contains(list.err, "copy: "));
  }
}

TEST_CASE("Whatever an engine answered is kept so that it can be read", "[fuzz][store]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0, 0}, {1, 0, 0}, {}};
  const double inf = std::numeric_limits<double>::infinity();
  fuzz::Examined examined;
  examined.exact = Answer::never();
  const auto kept = [&] {
    fuzz::Finding f = finding();
    f.text = f.shrunk = fuzz::text_of("1/leaving/5", scene, query, examined);
    INFO(f.text.given);
    return fuzz::case_in(f.text).given;
  };
  for (const double time : {-1.0, -0.0, -5e-324, -inf, inf, std::nan(""), -1e308}) {
    examined.given = Answer::hit({0, 0, {Integer(1), Integer(0), Integer(0)}}, time);
    const auto again = kept().time;
    CHECK(again.has_value() == (time > -inf));
    if (again) CHECK(*again == time);
  }
  const auto huge = Integer::from_decimal("-" + std::string(2499, '7'));
  examined.given = Answer::hit({99, 99, {*huge, *huge, Integer(0)}}, 1);
  CHECK(kept().obstacle == examined.given.obstacle);
  for (const std::string& message :
       {std::string("quotes \" and \\, lines\nand\ttabs"), std::string("\0\x1b[2J\x7f", 6),
        std::string("caf\xc3\xa9"), std::string(100'000, 'x')}) {
    examined.given = Answer::error(message);
    CHECK(kept().message == message);
  }
  examined.given = Answer::error("half a caf\xc3");
  CHECK(kept().message == "half a caf\xef\xbf\xbd");
}
