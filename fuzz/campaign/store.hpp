// The store of campaigns: one SQLite file, with write-ahead logging while a campaign writes it. A campaign
// that is killed loses at most what was not yet committed, and never the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <lorentz/verdict.hpp>
#include "fuzz/campaign/campaign.hpp"
#include "report/runs/database.hpp"

namespace lorentz {

// For pieces of stores (src/exchange/json_piece.hpp).
inline auto members_of(Domain::Range& self) {
  return std::tie(self.low, self.high);
}
inline auto members_of(Domain& self) {
  return std::tie(self.speed, self.coordinates, self.radius, self.flight, self.dimension_2, self.dimension_3,
                  self.balls, self.ellipsoids, self.limits);
}

}  // namespace lorentz

namespace lorentz::fuzz {

/// All that the findings of a campaign depend on. Two campaigns with the same manifest are one.
struct CampaignManifest {
  std::string version, engine;
  std::vector<std::string> targets;
  std::uint64_t seed = 0;
  std::string options;  ///< the other options, in words
  Claim claim;          ///< by which answers are judged; also in the words

  /// The tolerance, which the words of the options begin with: "ulps 4, ..".
  double ulps() const {
    double k = oracle::kDefaultUlps;
    std::sscanf(options.c_str(), "ulps %lf", &k);
    return k;
  }

  friend bool operator==(const CampaignManifest&, const CampaignManifest&) = default;
  friend auto members_of(CampaignManifest& self) {
    return std::tie(self.version, self.engine, self.targets, self.seed, self.options, self.claim.precision,
                    self.claim.time_tolerance, self.claim.inside, self.claim.domain);
  }
};

struct Campaign {
  std::int64_t id = 0;
  CampaignManifest manifest;
};

/// A finding, and its campaign's id.
struct Stored {
  std::int64_t campaign;
  Finding finding;
  std::string label() const;  ///< CAMPAIGN/TARGET/INDEX[.STEP]
};

/// Used by one thread. Every function throws FileError if reading or writing the file fails.
class Store {
 public:
  using Access = runs::Access;

  /// The path ":memory:" is a store that ends with this object. A file must have exactly the tables of a
  /// store; its views and triggers never run.
  Store(const std::string& path, Access access);

  const std::string& path() const { return database_.path(); }
  std::vector<Campaign> campaigns() const;

  /// The id of the campaign with this manifest, which is added if it is missing.
  std::int64_t open_campaign(const CampaignManifest& manifest);

  /// The tally that was put last, or an empty one.
  TargetTally tally(std::int64_t campaign, std::string_view target) const;
  /// Throws FileError also for a finding with a flaw (flaw_of).
  std::vector<Stored> findings() const;

  /// Writes become durable together, by commit().
  void put(std::int64_t campaign, std::string_view target, const TargetTally& tally);
  void put(std::int64_t campaign, const Finding& finding);
  void commit() { database_.commit(); }

 private:
  runs::Database database_;
};

/// A campaign's journal in a store. Commits every half second.
class StoreJournal final : public Journal {
 public:
  StoreJournal(Store& store, std::int64_t campaign) : store_(store), campaign_(campaign) {}
  StoreJournal(const StoreJournal&) = delete;
  StoreJournal& operator=(const StoreJournal&) = delete;
  ~StoreJournal() override;
  void record(const cases::Target& target, const TargetTally& tally,
              const std::vector<Finding>& kept) override;
  void tick() override;
  void ended() override { write(); }

 private:
  using JournalClock = std::chrono::steady_clock;
  void write();

  Store& store_;
  const std::int64_t campaign_;
  std::map<std::string_view, TargetTally> unwritten_;  // a row is written once per commit, not at each change
  std::vector<Finding> findings_;
  JournalClock::time_point last_commit_ = JournalClock::now();
};

/// The library that keeps the stores, and its version.
std::string store_libraries();

}  // namespace lorentz::fuzz
