// Batches in other words: the golden sets' queries in other bases, units, axes, orders, as a plane in space
// and with ellipsoids for balls, flown together. Campaigns ask batches the same way, a few of a scene at a
// time.
#include "tests/fuzz/rewording_support.hpp"

#include <deque>
#include <filesystem>

#include <lorentz/certified_batch.hpp>
#include "judge/golden/reader.hpp"
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using cases::Random;
using fuzz::Reworded;

namespace {

constexpr std::uint64_t kSeed = 1304;
constexpr std::uint64_t kWordings = 12;  // of each scene; each record is asked in half of them

std::vector<std::string> lanes() {
  std::vector<std::string> sets = Batch::instruction_sets();
  sets.pop_back();  // "none"
  return sets;
}

// A scene in other words, and all that is asked about in these.
class Gathered {
 public:
  explicit Gathered(fuzz::Rewording&& rewording) : scene_(std::move(rewording)) {}

  void add(Random& random, const Query& query, const Answer& exact, Tally& tally) {
    auto reworded = scene_.rewording.reword(random, query);
    if (!reworded || !table_.push_back(reworded->query)) {
      ++tally.met["(no binary64, or no 64 bits)"];
      return;
    }
    if (scene_.reduction) {
      tally.see(scene_.rewording.words(*reworded));
      tally.met["(from)"] += query.from.has_value();
      add_limited(random, reworded->query);
    }
    asked_.push_back({std::move(*reworded), exact});
  }

  void check(Tally& tally) {
    tally.met[scene_.reduction ? "(queries)" : "(queries beyond the engine)"] += table_.size();
    if (scene_.reduction) {
      for (const std::string& instructions : lanes()) {
        const Batch batch(words(), instructions);
        for (const QueryTable* table : {&table_, &limited_})
          for (const auto time : {Batch::Time::close, Batch::Time::rounded})
            require_single_flights(batch, *table, time, tally);
      }
    }
    require_exact(tally);
  }

 private:
  struct Asked {
    Reworded reworded;
    Answer exact;  // of the question as it was
  };

  const Scene& words() const { return scene_.rewording.scene(); }

  // Around the time that single flights say.
  void add_limited(Random& random, const Query& query) {
    constexpr double kFactors[] = {0.5, 1, 1 + 0x1p-40, 2};
    const Flight flight = scene_.reduction->fly(query);
    if (flight.outcome == Outcome::hit) limited_.push_back(query, flight.time * kFactors[random.below(4)]);
  }

  // To the bit what Reduction says of the same question.
  void require_single_flights(const Batch& batch, const QueryTable& table, Batch::Time time, Tally& tally) {
    flights_.resize(table.size());
    const QueryColumns columns = table.columns();
    tally.met["(left to single flights)"] += batch.fly(columns, flights_.columns(), time);
    tally.met["(flights)"] += table.size();
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double limit = columns.max_time.empty() ? kNoLimit : columns.max_time[i];
      const Flight one = scene_.reduction->fly(table[i], limit, time), many = flights_[i];
      INFO(stream(words(), table[i]) << "limit " << limit << "\none  " << line(answer_of(one), 3) << "many "
                                     << line(answer_of(many), 3));
      REQUIRE(same_bits(one, many));
      REQUIRE(one.time_is_rounded == many.time_is_rounded);
    }
  }

  // What a certified batch is certain of is the record's exact answer, in its words.
  void require_exact(Tally& tally) {
    const oracle::CertifiedBatch batch(words());
    flights_.resize(table_.size());
    std::vector<std::size_t> uncertain;
    batch.first_hits(table_.columns(), flights_.columns(), uncertain);
    std::vector<bool> is_certain(table_.size(), true);
    for (const std::size_t i : uncertain) is_certain[i] = false;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      ++tally.met[is_certain[i] ? "(certain)" : "(uncertain)"];
      if (!is_certain[i]) continue;
      INFO(stream(words(), table_[i]) << "exact, as it was: " << line(asked_[i].exact, 3));
      require_carried(scene_, asked_[i].reworded, asked_[i].exact, answer_of(flights_[i]), tally);
    }
  }

  RewordedScene scene_;
  std::vector<Asked> asked_;
  QueryTable table_, limited_;  // the same without limits, and with limits about their times
  FlightTable flights_;
};

void check_set(const std::string& path, Tally& tally) {
  golden::Reader reader(path);
  golden::ReadRecord read;
  std::deque<Gathered> wordings;
  const auto finish = [&] {
    for (Gathered& one : wordings) one.check(tally);
    wordings.clear();
  };
  std::size_t scene_number = ~std::size_t{0};
  for (std::uint64_t index = 0; reader.next(read); ++index) {
    if (!read.query) continue;
    Random random(kSeed, reader.header().name, index, cases::Use::rewordings);
    if (scene_number != reader.scene_number()) {
      finish();
      for (std::uint64_t i = 0; i < kWordings; ++i)
        wordings.emplace_back(fuzz::Rewording(random, reader.scene()));
    }
    scene_number = reader.scene_number();
    INFO(path << ':' << read.line << ", seed " << kSeed);
    ++tally.met["(records)"];
    for (std::uint64_t i = index % 2; i < kWordings; i += 2)
      wordings[i].add(random, *read.query, read.record.expect, tally);
  }
  finish();
}

}  // namespace

TEST_CASE(
    "Rewording: batches say of every golden record in other words what single flights say, and the truth",
    "[fuzz][rewording][batch]") {
  Tally tally;
  for (const auto& file : std::filesystem::directory_iterator(LORENTZ_SOURCE_DIR "/data/golden"))
    if (file.path().extension() == ".ndjson") check_set(file.path(), tally);
  tally.print("golden records in other words, in batches, seed " + std::to_string(kSeed));
  // A generator that rots is seen.
  CHECK(tally.met["(records)"] > 10'500);  // 10 880 seen
  for (const char* word : {"basis", "superlattice", "axes", "scene moved", "lengths", "plane in space",
                           "semiaxes", "order", "start moved", "start moved and rounded", "velocity"}) {
    INFO(word);
    CHECK(tally.met[word] > 1000);  // 1 319 seen at least
  }
  CHECK(tally.met["(from)"] > 1000);            // 1 343 seen
  CHECK(tally.met["(certain)"] > 13'000);       // 17 238 seen
  CHECK(tally.met["(carried over)"] > 12'000);  // 15 629 seen
  if (!lanes().empty())
    CHECK(tally.met["(flights)"] - tally.met["(left to single flights)"] > 29'000);  // 36 650 seen
}
