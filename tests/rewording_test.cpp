// The oracle says the same in other words.
#include "rewording.hpp"

#include <catch2/catch.hpp>

#include <iostream>

#include "family_list.hpp"
#include "oracle.hpp"
#include "parts.hpp"
#include "scene_check.hpp"
#include "support.hpp"
#include "target.hpp"
#include "tie.hpp"
#include "verdict.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Random;
using fuzz::Reworded;
using fuzz::Rewording;

namespace {

constexpr std::uint64_t kSeed = 1301;

bool names_obstacle(const Answer& answer) {
  return answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
}

// How often each relation was met, the farthest it went, and what came of the questions.
struct Tally {
  std::map<std::string, std::uint64_t> met;
  std::map<std::string, long> farthest, nearest;

  // "basis 2^37, axes": a word, and the exponent behind it if there is one.
  void see(const std::string& words) {
    for (std::size_t begin = 0; begin < words.size();) {
      const std::size_t end = std::min(words.find(", ", begin), words.size());
      std::string word = words.substr(begin, end - begin);
      if (const auto power = word.find(" 2^"); power != std::string::npos) {
        const long exponent = std::stol(word.substr(power + 3));
        if (word.ends_with("rounded")) word.insert(power, " and rounded");
        word.resize(word.find(" 2^"));
        word = word.substr(0, word.find(" of "));
        farthest[word] = std::max(farthest[word], exponent);
        nearest[word] = std::min(nearest[word], exponent);
      }
      ++met[word];
      begin = end + 2;
    }
  }
  void print(const std::string& heading) const {
    std::cout << heading << '\n';
    for (const auto& [word, count] : met) {
      std::cout << "  " << word << ": " << count;
      if (farthest.contains(word)) std::cout << ", 2^" << nearest.at(word) << " to 2^" << farthest.at(word);
      std::cout << '\n';
    }
  }
};

// One scene in other words, with the oracle for them.
struct Room {
  explicit Room(Rewording&& one) : rewording(std::move(one)), oracle(rewording.scene()) {}
  Rewording rewording;
  oracle::Oracle oracle;
  std::optional<oracle::Judge> judge;
};

// What the oracle says in the new words is what it said in the old: to the bit of the time, and the same
// obstacle, or one that is entered at that very time.
void require_same(Room& room, const Reworded& reworded, const Answer& exact, Tally& tally) {
  const Answer there = room.oracle.first_hit(reworded.query);
  INFO("there: " << line(there, room.rewording.scene().dimension));
  if (reworded.rounded) return;  // another question
  REQUIRE(there.outcome == exact.outcome);
  const auto carried = room.rewording.carried(exact, reworded);
  ++tally.met[carried ? "(carried over)" : "(time lost)"];
  if (carried) REQUIRE(there.time == carried->time);
  if (!names_obstacle(exact)) return;
  if (room.rewording.back(there.obstacle, reworded) == exact.obstacle) return;
  ++tally.met["(ties)"];
  if (!room.judge) room.judge.emplace(room.rewording.scene());
  const Answer other = exact.outcome == Outcome::hit
                           ? Answer::hit(room.rewording.there(exact.obstacle, reworded), *there.time)
                           : Answer::inside(room.rewording.there(exact.obstacle, reworded));
  REQUIRE(fuzz::is_tie(room.rewording.scene(), *room.judge, reworded.query, there, other));
}

// The cases of a target, each in two other words.
void require_same_in_other_words(const fuzz::Target& target, std::uint64_t count, Tally& tally) {
  std::vector<Room> rooms;
  std::optional<oracle::Oracle> oracle;
  std::optional<Scene> scene;
  for (std::uint64_t index = 0; index < count; ++index) {
    const fuzz::Case one = target.make(kSeed, index);
    Random random(kSeed, target.name(), index, fuzz::Use::rewordings);
    if (!scene || !fuzz::same(*scene, one.scene)) {
      scene = one.scene;
      oracle.emplace(*scene);
      rooms.clear();
      for (int i = 0; i < 4; ++i) {
        Rewording rewording(random, *scene);
        INFO(target.name() << ' ' << index << ", seed " << kSeed << ": " << rewording.words({}));
        INFO(stream(*scene, one.query) << stream(rewording.scene(), one.query));
        REQUIRE_FALSE(flaw_of(rewording.scene()));
        REQUIRE_FALSE(oracle::dependence_in(rewording.scene()));
        rooms.emplace_back(std::move(rewording));
      }
    }
    const Answer exact = oracle->first_hit(one.query);
    for (const std::uint64_t i : {index % 4, (index + 1) % 4}) {
      const auto reworded = rooms[i].rewording.reword(random, one.query);
      if (!reworded) {
        ++tally.met["(no binary64)"];
        continue;
      }
      const Scene& other = rooms[i].rewording.scene();
      INFO(target.name() << ' ' << index << ", seed " << kSeed << ": "
                         << rooms[i].rewording.words(*reworded));
      INFO(stream(one.scene, one.query) << stream(other, reworded->query));
      INFO("here:  " << line(exact, one.scene.dimension));
      REQUIRE_FALSE(flaw_of(reworded->query, other));
      tally.see(rooms[i].rewording.words(*reworded));
      if (one.query.from) {
        ++tally.met["(from)"];
        REQUIRE(rooms[i].rewording.back(*reworded->query.from, *reworded) == *one.query.from);
      }
      require_same(rooms[i], *reworded, exact, tally);
    }
  }
}

}  // namespace

TEST_CASE("Rewording: the oracle says the same in other words") {
  Tally tally;
  for (const fuzz::Target& target : fuzz::targets()) require_same_in_other_words(target, 512, tally);
  tally.print("the oracle in other words, 20 targets, 512 cases each, seed " + std::to_string(kSeed));
  // A generator that rots is seen.
  for (const char* word : {"basis", "superlattice", "axes", "scene moved", "lengths", "plane in space",
                           "semiaxes", "order", "start moved", "start moved and rounded", "velocity"}) {
    INFO(word);
    CHECK(tally.met[word] > 200);
  }
  CHECK(tally.met["(carried over)"] > 8000);
  CHECK(tally.met["(ties)"] > 50);
  CHECK(tally.met["(from)"] > 500);
  CHECK(tally.farthest["basis"] >= 40);
  CHECK(tally.farthest["start moved"] >= 50);
  CHECK(tally.farthest["lengths"] > 950);
  CHECK(tally.nearest["lengths"] < -950);
  CHECK(tally.farthest["velocity"] > 1000);
  CHECK(tally.nearest["velocity"] < -1000);
}
