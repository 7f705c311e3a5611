// A campaign asks an engine about cases of several targets and variants of some of them. The oracle judges
// the answers, and wrong ones are shrunk. The findings depend on the plan and on how far each target went,
// but not on the number of threads, nor on how often the campaign was stopped and continued.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "fuzz/campaign/finding.hpp"
#include "fuzz/families/family.hpp"

namespace lorentz::fuzz {

using question::Answerer;
using question::MakeAnswerer;

/// The scenes that a campaign keeps to: those that an engine can do.
struct Scope {
  enum class Scenes {
    any,
    lattice,  ///< one crystal lattice, with one ball
    unit,     ///< the same, square or cubic with spacing 1, the ball at the origin (is_unit_scene)
    ball      ///< one ball, which is not repeated
  };
  Scenes scenes = Scenes::any;
  int dimension = 0;  ///< 2 or 3; 0: both

  bool admits(const Scene& scene) const;
  friend bool operator==(const Scope&, const Scope&) = default;
  bool is_all() const { return scenes == Scenes::any && dimension == 0; }
  /// Whether some of the first scenes of a target are within the scope.
  bool meets(const cases::Target& target, std::uint64_t seed) const;
};

/// All that findings depend on, except the engine.
struct Plan {
  std::vector<const cases::Target*> targets;
  Scope scope;  ///< cases beyond it, and other words that lead there, are left out; shrinking stays within
  std::uint64_t seed = 0;
  Sought sought;
  std::uint64_t keep = 3;     ///< findings of each sort and target that are kept and shrunk; all are counted
  std::uint64_t mutate = 32;  ///< a climb starts from one in `mutate` cases; 0: from none
  std::uint64_t reword =
      1;             ///< one in `reword` cases, with its variants, is also asked in other words; 0: none
  Claim claim = {};  ///< of the engine: cases consist of its numbers, and answers are judged by it
};

/// How far a target is, and what the campaign met on the way.
struct TargetTally {
  std::uint64_t next = 0;  ///< the first index that is not done
  std::uint64_t cases = 0, variants = 0;
  std::uint64_t outside = 0;                                ///< not asked: outside of the engine's domain
  std::uint64_t reworded = 0;                               ///< of both, asked in other words and answered
  question::Counts counts;                                  ///< replies to all of these, by Kind
  std::array<std::uint64_t, 3> stages{};                    ///< the same, by Stage, if the reply names it
  std::map<std::string, std::uint64_t> sorts;               ///< findings met, by sort, kept or not
  double margin = std::numeric_limits<double>::infinity();  ///< the smallest above 0 that a climb reached,
  std::uint64_t margin_index = 0;                           ///< from this case

  friend auto members_of(TargetTally& self) {
    return std::tie(self.next, self.cases, self.variants, self.outside, self.reworded, self.counts,
                    self.stages, self.sorts, self.margin, self.margin_index);
  }

  /// Adds what another stint of indices met, except `next`, which the caller sets.
  void add(const TargetTally& other);
};

/// Receives a campaign's results. Called by one thread.
class Journal {
 public:
  virtual ~Journal() = default;

  /// The tally of a target after more of its work, and the findings kept from that work. A finding comes when
  /// it is found, and again when it is shrunk.
  virtual void record(const cases::Target& target, const TargetTally& tally,
                      const std::vector<Finding>& kept) = 0;

  /// Called several times a second, also when nothing was done.
  virtual void tick() = 0;

  /// Called once, when nothing more is recorded, before the threads are waited for.
  virtual void ended() {}
};

/// When to stop: at a number of cases of each target, after a time for all, or both; or at a finding.
struct Bounds {
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< indices
  double seconds = std::numeric_limits<double>::infinity();
  unsigned jobs = 1;
  bool first = false;                       ///< also stop as soon as a finding is recorded
  const std::atomic<bool>* stop = nullptr;  ///< set by the caller to stop early

  bool limits_time() const { return seconds < std::numeric_limits<double>::infinity(); }
};

class Ranks;

/// Continues from the tallies (one for each target of the plan), which it updates, and from those of the known
/// findings that are not fully shrunk. Each target gets the same time of the threads, shrinking included.
/// Work that is unfinished when the time is up is dropped, and answers that are due are not waited for: at
/// most the few cases, or the one finding, that each thread was at. The next run goes on from these cases.
/// Returns whether an engine failed. With `ranks` (this is rank 0) other processes help.
bool run(const Plan& plan, const Bounds& bounds, const MakeAnswerer& make_answerer,
         std::vector<TargetTally>& tallies, Journal& journal, Ranks* ranks = nullptr,
         const std::vector<Finding>& known = {});

}  // namespace lorentz::fuzz
