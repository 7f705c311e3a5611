// The oracle says the same in other words, and so do the engines that claim to be exact.
#include "tests/fuzz/rewording_support.hpp"

#include <cmath>
#include <deque>
#include <filesystem>
#include <set>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/scene_check.hpp>
#include "fuzz/campaign/rewording_steps.hpp"
#include "fuzz/campaign/time_limit.hpp"
#include "fuzz/families/family.hpp"
#include "judge/golden/reader.hpp"
#include "question/cases/drawn_flights.hpp"

using namespace lorentz;
using namespace lorentz::test;
using cases::Random;
using fuzz::Reworded;
using fuzz::Rewording;

namespace {

constexpr std::uint64_t kSeed = 1301;

enum class Who { oracle, engines };

// One question in the words of one of some reworded scenes.
void require_same_in(RewordedScene& in_words, Random& random, const Query& query, const Answer& exact,
                     Who who, Tally& tally) {
  const auto reworded = in_words.rewording.reword(random, query);
  if (!reworded) {
    ++tally.met["(no binary64)"];
    return;
  }
  const Scene& other = in_words.rewording.scene();
  INFO("in other words: " << in_words.rewording.words(*reworded) << '\n' << stream(other, reworded->query));
  REQUIRE_FALSE(flaw_of(reworded->query, other));
  tally.see(in_words.rewording.words(*reworded));
  if (query.from) {
    ++tally.met["(from)"];
    REQUIRE(in_words.rewording.back(*reworded->query.from, *reworded) == *query.from);
  }
  const Answer there = in_words.oracle.first_hit(reworded->query);
  require_carried(in_words, *reworded, exact, there, tally);
  if (who == Who::engines) require_exact_engines(in_words, reworded->query, there, tally);
}

// A scene in some other words.
std::deque<RewordedScene> reworded_scenes(Random& random, const Scene& scene, int count) {
  std::deque<RewordedScene> scenes;
  for (int i = 0; i < count; ++i) {
    Rewording rewording(random, scene);
    INFO(rewording.words({}) << '\n' << stream(rewording.scene(), {}));
    REQUIRE_FALSE(flaw_of(rewording.scene()));
    REQUIRE_FALSE(oracle::dependence_in(rewording.scene()));
    scenes.emplace_back(std::move(rewording));
  }
  return scenes;
}

// The cases of a target, each in two of four other words for its scene.
void require_same_in_other_words(const cases::Target& target, std::uint64_t seed, std::uint64_t count,
                                 Who who, Tally& tally) {
  std::deque<RewordedScene> scenes;
  std::optional<oracle::Oracle> oracle;
  std::optional<Scene> scene;
  for (std::uint64_t index = 0; index < count; ++index) {
    const cases::Case one = target.make(seed, index);
    Random random(seed, target.name(), index, cases::Use::rewordings);
    INFO(target.name() << ' ' << index << ", seed " << seed << '\n' << stream(one.scene, one.query));
    if (!scene || *scene != one.scene) {
      scene = one.scene;
      oracle.emplace(*scene);
      scenes = reworded_scenes(random, *scene, 4);
    }
    const Answer exact = oracle->first_hit(one.query);
    INFO("exact: " << line(exact, one.scene.dimension));
    for (const std::uint64_t i : {index % 4, (index + 1) % 4})
      require_same_in(scenes[i], random, one.query, exact, who, tally);
  }
}

// Each record of a golden set in two of three other words for its scene.
void require_same_in_other_words(const std::string& path, Tally& tally) {
  golden::Reader reader(path);
  golden::ReadRecord read;
  std::deque<RewordedScene> scenes;
  std::size_t scene_number = ~std::size_t{0};
  for (std::uint64_t index = 0; reader.next(read); ++index) {
    if (!read.query) continue;
    Random random(kSeed, reader.header().name, index, cases::Use::rewordings);
    if (scene_number != reader.scene_number()) scenes = reworded_scenes(random, reader.scene(), 3);
    scene_number = reader.scene_number();
    INFO(path << ':' << read.line << ", seed " << kSeed);
    ++tally.met["(records)"];
    for (const std::uint64_t i : {index % 3, (index + 1) % 3})
      require_same_in(scenes[i], random, *read.query, read.record.expect, Who::engines, tally);
  }
}

// Every length of a scene, in its order.
std::vector<double> numbers_of(const Scene& scene) {
  std::vector<double> all;
  const auto add = [&](const Vec& a) { all.insert(all.end(), a.begin(), a.end()); };
  for (const Lattice& lattice : scene.lattices) {
    for (const Vec& vector : lattice.vectors) add(vector);
    for (const Atom& atom : lattice.atoms) {
      add(atom.position);
      all.push_back(atom.radius);
      for (const Vec& axis : atom.semiaxes) add(axis);
    }
  }
  return all;
}

std::size_t atoms_of(const Scene& scene) {
  std::size_t all = 0;
  for (const Lattice& lattice : scene.lattices) all += lattice.atoms.size();
  return all;
}

// The largest number of the cells whose vectors are the new ones, in the old words.
std::int64_t largest_entry(const fuzz::RewordingStep& step, const Scene& before, const Scene& after) {
  std::int64_t most = 0;
  for (int l = 0; l < static_cast<int>(before.lattices.size()); ++l)
    for (int k = 0; before.lattices[l] != after.lattices[l] && k < before.dimension; ++k) {
      ObstacleId id{l, 0, {}};
      id.cell[k] = 1;
      step.back(id);
      for (const Integer& entry : id.cell) most = std::max(most, std::abs(entry.int64()));
    }
  return most;
}

bool renames(const fuzz::RewordingStep& step, const Scene& scene) {
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
      ObstacleId id{l, a, {}};
      step.there(id);
      if (id.lattice != l || id.atom != a) return true;
    }
  return false;
}

// What one step says that it did, it did: decided by the numbers before and after. Returns its first word.
std::string require_effect(const fuzz::RewordingStep& step, const Scene& before, const Scene& after) {
  const std::string words = step.words, first = words.substr(0, words.find(' '));
  const auto power = words.find("2^");
  const long exponent = power == std::string::npos ? 0 : std::stol(words.substr(power + 2));
  const int dimension = before.dimension;
  const Vec start{1, 2, dimension == 3 ? 4.0 : 0}, velocity{8, 16, dimension == 3 ? 32.0 : 0};
  Vec x = start, v = velocity;
  const bool can = step.reword(x, v);
  const std::vector<double> old_numbers = numbers_of(before), numbers = numbers_of(after);
  if (first == "basis" || first == "superlattice") {
    REQUIRE(std::ilogb(static_cast<double>(largest_entry(step, before, after))) == exponent);
    const std::size_t cells = first == "basis" ? 1 : std::stoul(words.substr(words.find(" of ") + 4));
    REQUIRE((before != after && (cells > 1) == (first == "superlattice")));
    std::size_t expected = 0;
    for (std::size_t l = 0; l < before.lattices.size(); ++l)
      expected += before.lattices[l].atoms.size() * (before.lattices[l] == after.lattices[l] ? 1 : cells);
    REQUIRE(atoms_of(after) == expected);
  } else if (first == "axes") {
    REQUIRE((x != start && v != velocity));
    for (const Vec& a : {x, v}) REQUIRE(length(a) == length(a[0] * a[0] < 64 ? start : velocity));
  } else if (first == "scene") {
    Vec by{}, none{};
    REQUIRE((step.reword(by, none) && by != Vec{} && none == Vec{} && v == velocity));
    for (std::size_t l = 0; l < before.lattices.size(); ++l)
      for (std::size_t a = 0; a < before.lattices[l].atoms.size(); ++a)
        REQUIRE(after.lattices[l].atoms[a].position == sum(before.lattices[l].atoms[a].position, by));
  } else if (first == "lengths") {
    REQUIRE((exponent != 0 && step.time_exponent == exponent && v == velocity));
    if (can) REQUIRE(x[0] == std::ldexp(start[0], static_cast<int>(exponent)));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      REQUIRE(numbers[i] == std::ldexp(old_numbers[i], static_cast<int>(exponent)));
  } else if (first == "plane") {
    REQUIRE((dimension == 2 && after.dimension == 3));
  } else if (first == "semiaxes") {
    REQUIRE((after != before && atoms_of(after) == atoms_of(before)));
  } else {
    REQUIRE((first == "order" && renames(step, before)));
  }
  return first;
}

Tally in_golden_sets() {
  Tally tally;
  for (const auto& file : std::filesystem::directory_iterator(LORENTZ_SOURCE_DIR "/data/golden"))
    if (file.path().extension() == ".ndjson") require_same_in_other_words(file.path(), tally);
  return tally;
}

}  // namespace

TEST_CASE("Rewording: the oracle says the same in other words", "[fuzz][rewording]") {
  Tally tally;
  for (const cases::Target& target : cases::targets())
    require_same_in_other_words(target, kSeed, 512, Who::oracle, tally);
  tally.print("the oracle in other words, all targets, 512 cases each, seed " + std::to_string(kSeed));
  // A generator that rots is seen.
  for (const char* word : {"basis", "superlattice", "axes", "scene moved", "lengths", "plane in space",
                           "semiaxes", "order", "start moved", "start moved and rounded", "velocity"}) {
    INFO(word);
    CHECK(tally.met[word] > 1400);  // 1 789 seen at least
  }
  CHECK(tally.met["(carried over)"] > 17'000);  // 22 235 seen
  CHECK(tally.met["(ties)"] > 570);             // 720 seen
  CHECK(tally.met["(from)"] > 1900);            // 2 435 seen
  CHECK(tally.farthest["basis"] >= 40);         // 40 seen
  CHECK(tally.farthest["start moved"] >= 50);   // 50 seen
  CHECK(tally.farthest["lengths"] > 1600);      // 2 054 seen
  CHECK(tally.nearest["lengths"] < -950);
  CHECK(tally.farthest["velocity"] > 1000);  // 1 023 seen
  CHECK(tally.nearest["velocity"] < -1000);
}

TEST_CASE("Rewording: each step that is counted changes what it says", "[fuzz][rewording]") {
  constexpr std::pair<const char*, fuzz::DrawStep> kSteps[] = {
      {"basis", fuzz::draw_basis},    {"superlattice", fuzz::draw_superlattice},
      {"axes", fuzz::draw_axes},      {"scene", fuzz::draw_moved_scene},
      {"lengths", fuzz::draw_scaled}, {"plane", fuzz::draw_plane_in_space},
      {"order", fuzz::draw_order},    {"semiaxes", fuzz::draw_ellipsoids}};
  std::map<std::string, int> met, none;
  int middling = 0;
  int second_at_origin = 0;
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t index = 0; index < 8 * 64; index += 64) {
      const Scene scene = target.make(kSeed, index).scene;
      Random random(kSeed, target.name(), index, cases::Use::rewordings);
      for (const auto& [name, draw] : kSteps)
        for (int tries = 0; tries < 4; ++tries) {
          Scene after = scene;
          const auto step = draw(random, after);
          INFO("seed " << kSeed << ", " << target.name() << ' ' << index << ": "
                       << (step ? step->words : name) << '\n'
                       << stream(scene, {}) << stream(after, {}));
          if (step && std::string(name) == "lengths")
            middling += std::abs(step->time_exponent) > 16 && std::abs(step->time_exponent) < 400;
          if (step && std::string(name) == "scene" && scene.lattices.size() > 1)
            second_at_origin += after.lattices[1].atoms[0].position == Vec{};
          if (step)
            REQUIRE(require_effect(*step, scene, after) == name);
          else
            REQUIRE(after == scene);
          ++(step ? met : none)[name];
        }
    }
  for (const auto& [name, draw] : kSteps) {
    INFO(name << ": " << met[name] << " and none " << none[name]);
    CHECK(met[name] > 130);  // 175 seen at least
  }
  CHECK(middling > 90);         // 117 seen
  CHECK(second_at_origin > 0);  // 2 seen
  // Those that may draw what changes nothing did so, and did not count it.
  for (const char* name : {"axes", "scene", "semiaxes", "order"}) CHECK(none[name] > 20);
}

TEST_CASE("Rewording: a sum is a binary64 value, or none", "[fuzz][rewording]") {
  CHECK(fuzz::to_binary64(1, 1023) == 0x1p1023);
  CHECK(fuzz::to_binary64(oracle::Z((1UL << 53) - 1), 971) == std::numeric_limits<double>::max());
  CHECK(fuzz::to_binary64(4, 1021) == 0x1p1023);
  CHECK_FALSE(fuzz::to_binary64(1, 1024));
  CHECK(fuzz::to_binary64(1, -1074) == 0x1p-1074);
  CHECK_FALSE(fuzz::to_binary64(3, -1075));
  CHECK_FALSE(fuzz::to_binary64(oracle::Z((1UL << 53) + 1), 0));
}

TEST_CASE("Rewording: a start that is said to be moved is, and a velocity", "[fuzz][rewording]") {
  std::map<std::string, int> met;
  std::set<int> speeds;  // those near 1, as powers of two
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t index = 0; index < 32 * 16; index += 16) {
      const cases::Case one = target.make(kSeed, index);
      Random random(kSeed, target.name(), index, cases::Use::rewordings);
      const Rewording rewording(random, one.scene);
      if (!rewording.words({}).empty()) continue;  // else the steps have changed the start as well
      for (int tries = 0; tries < 8; ++tries) {
        const auto reworded = rewording.reword(random, one.query);
        REQUIRE(reworded);
        const std::string words = rewording.words(*reworded);
        INFO("seed " << kSeed << ", " << target.name() << ' ' << index << ": " << words << '\n'
                     << stream(one.scene, one.query) << stream(one.scene, reworded->query));
        const bool moved = words.find("start moved") != std::string::npos,
                   rounded = words.find("rounded") != std::string::npos,
                   sped = words.find("velocity") != std::string::npos;
        REQUIRE(moved == (reworded->query.x != one.query.x));
        REQUIRE(rounded == reworded->rounded);
        REQUIRE(sped == (reworded->query.v != one.query.v));
        for (int i = 0; i < 3; ++i)
          REQUIRE(reworded->query.v[i] == std::ldexp(one.query.v[i], reworded->speed));
        if (std::abs(reworded->speed) <= 8) speeds.insert(reworded->speed);
        for (const std::int64_t k : reworded->periods) {
          REQUIRE(std::abs(k) <= std::int64_t{1} << 50);
          met["back"] += k < 0 && (-k & (-k - 1)) != 0;  // and by no power of two
        }
        met["moved"] += moved, met["rounded"] += rounded, met["sped"] += sped, ++met["asked"];
      }
    }
  INFO(met["asked"] << ' ' << met["moved"] << ' ' << met["rounded"] << ' ' << met["sped"]);
  CHECK(met["moved"] > 100);
  CHECK(met["back"] > 30);
  CHECK(met["rounded"] > 20);
  CHECK(met["sped"] > 100);
  CHECK(speeds.size() == 17);
}

TEST_CASE("Rewording: what cannot be said otherwise is left as it is", "[fuzz][rewording]") {
  const Scene scene = unit_scene(2, 0.25);
  Answer timeless = Answer::hit({}, 1);
  timeless.time.reset();
  for (std::uint64_t index = 0; index < 64; ++index) {
    Random random(kSeed, "left alone", index);
    const Rewording rewording(random, scene);
    for (const Answer& none : {Answer::undecided(), Answer::later(), Answer::error("no"), timeless})
      CHECK_FALSE(rewording.carried(none, {}));
    // From the smallest number to the largest there is no other unit.
    const auto reworded = rewording.reword(random, {{0, 0}, {0x1.8p1023, 0x1p-1074}, {}});
    if (reworded) CHECK(reworded->speed == 0);
  }
}

TEST_CASE("Rewording: a limit's answer follows from the rounded time, but at the time itself",
          "[fuzz][rewording]") {
  constexpr std::uint64_t kOther = 1303;
  std::map<fuzz::LimitAt::Side, int> met, later;
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t index = 0; index < 64; ++index) {
      const cases::Case one = target.make(kOther, index);
      const oracle::Oracle& oracle = cases::oracle_of(one.scene);
      const Answer exact = oracle.first_hit(one.query);
      Random random(kOther, target.name(), index, cases::Use::rewordings);
      const fuzz::LimitAt limit = fuzz::drawn_limit(random, exact);
      const auto at = limit.place;
      if (at == fuzz::LimitAt::none) continue;
      CHECK(fuzz::limit_in("basis 2^3, " + fuzz::words_of(limit)) == limit);
      oracle::Request request;
      request.max_time = fuzz::limit_of(limit, exact);
      CHECK(*request.max_time > 0);
      const bool is_later = oracle.first_hit(one.query, request).outcome == Outcome::later;
      ++met[at];
      later[at] += is_later;
      INFO("seed " << kOther << ", " << target.name() << ' ' << index << ": " << fuzz::words_of(limit));
      if (exact.outcome != Outcome::hit)
        CHECK(is_later == (exact.outcome == Outcome::never));
      else if (*request.max_time != *exact.time)
        CHECK(is_later ==
              (at == fuzz::LimitAt::below || at == fuzz::LimitAt::half || at == fuzz::LimitAt::before));
    }
  for (const auto at : {fuzz::LimitAt::below, fuzz::LimitAt::above, fuzz::LimitAt::half, fuzz::LimitAt::twice,
                        fuzz::LimitAt::before, fuzz::LimitAt::after})
    CHECK(met[at] > 100);
  CHECK(later[fuzz::LimitAt::time] > 190);                             // 239 seen
  CHECK(met[fuzz::LimitAt::time] - later[fuzz::LimitAt::time] > 135);  // 171 seen
}

TEST_CASE("Rewording: every golden record holds in other words", "[fuzz][rewording]") {
  Tally tally = in_golden_sets();
  tally.print("golden records in other words, seed " + std::to_string(kSeed));
  CHECK(tally.met["(records)"] > 10'500);  // 10 880 seen
}

TEST_CASE("Rewording: a million questions in other words to certified and reduction",
          "[fuzz][rewording][long]") {
  constexpr std::uint64_t kOther = 1302;
  Tally tally;
  for (const cases::Target& target : cases::targets())
    require_same_in_other_words(target, kOther, 1'500'000 / cases::targets().size(), Who::engines, tally);
  tally.print("certified and reduction in other words, seed " + std::to_string(kOther));
  CHECK(tally.met["(reduction: decided)"] + tally.met["(reduction: undecided)"] > 1'000'000);
}
