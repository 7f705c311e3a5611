// The golden sets' queries, asked in batches: scene by scene, all together.
#include <catch2/catch.hpp>

#include <filesystem>

#include <lorentz/certified_batch.hpp>
#include "judge/golden/reader.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace fs = std::filesystem;

namespace {

struct Counts {
  long queries = 0, certain = 0, scenes = 0;
};

// What batches say of one scene's queries, held against single flights and against what the records expect.
void check(const Scene& scene, const QueryTable& table, const std::vector<Answer>& expected, Counts& counts) {
  ++counts.scenes;
  FlightTable flights;
  flights.resize(table.size());
  if (!Reduction::beyond(scene))
    for (const std::string& instructions : Batch::instruction_sets()) {
      const Batch batch(scene, instructions);
      for (const auto time : {Batch::Time::close, Batch::Time::rounded}) {
        batch.fly(table.columns(), flights.columns(), time);
        for (std::size_t i = 0; i < table.size(); ++i) {
          const Flight one = batch.one_at_a_time().fly(table[i], HUGE_VAL, time), many = flights[i];
          INFO(instructions << '\n' << stream(scene, table[i]));
          REQUIRE(same(answer_of(one), answer_of(many)));
          REQUIRE((one.stage == many.stage && one.time_is_rounded == many.time_is_rounded));
        }
      }
    }
  std::vector<std::size_t> uncertain{table.size()};  // as of another table
  oracle::CertifiedBatch(scene).first_hits(table.columns(), flights.columns(), uncertain);
  std::size_t next = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    ++counts.queries;
    if (next < uncertain.size() && uncertain[next] == i) {
      ++next;
      continue;
    }
    ++counts.certain;
    INFO(stream(scene, table[i]));
    REQUIRE(same(answer_of(flights[i]), expected[i]));
  }
  REQUIRE(next == uncertain.size());
}

Counts check_set(const std::string& path) {
  Counts counts;
  golden::Reader reader(path);
  QueryTable table;
  std::vector<Answer> expected;
  std::optional<Scene> scene;
  std::size_t number = 0;
  const auto finish = [&] {
    if (scene && table.size() > 0) check(*scene, table, expected, counts);
    table.clear(), expected.clear();
  };
  for (golden::ReadRecord record; reader.next(record);) {
    if (!scene || reader.scene_number() != number) {
      finish();
      scene = reader.scene(), number = reader.scene_number();
    }
    if (!record.query || !table.push_back(*record.query)) continue;
    expected.push_back(record.record.expect);
    expected.back().time_decimal.clear();
  }
  finish();
  return counts;
}

}  // namespace

TEST_CASE("The golden sets in batches, to the bit", "[golden][batch]") {
  Counts all;
  for (const auto& file : fs::directory_iterator(fs::path(LORENTZ_SOURCE_DIR) / "data" / "golden")) {
    if (file.path().extension() != ".ndjson") continue;
    const Counts counts = check_set(file.path());
    all.queries += counts.queries, all.certain += counts.certain, all.scenes += counts.scenes;
  }
  CHECK(all.queries > 10'000);
  CHECK(all.certain > 0.3 * all.queries);
  CHECK(all.scenes > 100);
}
