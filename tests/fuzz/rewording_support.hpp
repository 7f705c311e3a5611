// Scenes in other words, and the exact engines in these.
#pragma once

#include <catch2/catch.hpp>

#include <iostream>

#include <lorentz/certified.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/verdict.hpp>
#include "fuzz/campaign/examiner.hpp"
#include "fuzz/campaign/rewording.hpp"
#include "tests/support/support.hpp"

namespace lorentz::test {

inline bool names_obstacle(const Answer& answer) {
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
struct RewordedScene {
  explicit RewordedScene(fuzz::Rewording&& one)
      : rewording(std::move(one)), oracle(rewording.scene()), certified(rewording.scene()) {
    if (!Reduction::beyond(rewording.scene())) reduction.emplace(rewording.scene());
  }
  fuzz::Rewording rewording;
  oracle::Oracle oracle;
  oracle::Certified certified;
  std::optional<Reduction> reduction;
  std::optional<oracle::Judge> judge;
};

// What was said in the new words, `there`, is what the oracle said in the old: to the bit of the time, and
// the same obstacle, or one that is entered at that very time.
inline void require_carried(RewordedScene& scene, const fuzz::Reworded& reworded, const Answer& exact,
                            const Answer& there, Tally& tally) {
  INFO("there: " << line(there, scene.rewording.scene().dimension));
  if (reworded.rounded) return;  // another question
  REQUIRE(there.outcome == exact.outcome);
  const auto carried = scene.rewording.carried(exact, reworded);
  ++tally.met[carried ? "(carried over)" : "(time lost)"];
  if (carried) REQUIRE(there.time == carried->time);
  if (!names_obstacle(exact)) return;
  if (scene.rewording.back(there.obstacle, reworded) == exact.obstacle) return;
  ++tally.met["(ties)"];
  if (!scene.judge) scene.judge.emplace(scene.rewording.scene());
  const Answer other = exact.outcome == Outcome::hit
                           ? Answer::hit(scene.rewording.there(exact.obstacle, reworded), *there.time)
                           : Answer::inside(scene.rewording.there(exact.obstacle, reworded));
  REQUIRE(fuzz::is_tie(*scene.judge, reworded.query, there, other));
}

// The engines that claim to be exact say what the oracle says, in its words.
inline void require_exact_engines(const RewordedScene& scene, const Query& query, const Answer& there,
                                  Tally& tally) {
  const Answer certified = scene.certified.first_hit(query);
  INFO("certified: " << line(certified, scene.rewording.scene().dimension));
  REQUIRE(certified.outcome == there.outcome);
  REQUIRE(certified.time == there.time);
  if (names_obstacle(there)) REQUIRE(certified.obstacle == there.obstacle);
  if (!scene.reduction) return;
  const Answer reduction = answer_of(scene.reduction->fly(query));
  INFO("reduction: " << line(reduction, scene.rewording.scene().dimension));
  ++tally.met[reduction.outcome == Outcome::undecided ? "(reduction: undecided)" : "(reduction: decided)"];
  if (reduction.outcome == Outcome::undecided) return;
  REQUIRE(reduction.outcome == there.outcome);
  if (names_obstacle(there)) REQUIRE(reduction.obstacle == there.obstacle);
}

}  // namespace lorentz::test
