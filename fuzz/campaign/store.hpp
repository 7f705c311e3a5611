// Where campaigns are kept: one SQLite file, written ahead while a campaign writes it, so that whoever is
// killed loses at most what was not yet committed, and never the file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.hpp"
#include "runs/database.hpp"

namespace lorentz::fuzz {

/// All that the findings of a campaign depend on, in words. Two campaigns with the same manifest are one.
struct CampaignManifest {
  static constexpr const char* kMerged = "merged";

  std::string version, engine;
  std::string targets;  ///< names, with commas between them
  std::uint64_t seed = 0;
  std::string options;        ///< what else was chosen
  std::uint64_t keep = 3;     ///< as in Plan
  std::string shard = "0/1";  ///< i/N; kMerged for shards that did not all come equally far

  friend bool operator==(const CampaignManifest&, const CampaignManifest&) = default;
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

/// Used by one thread. Every function throws FileError if the file does not do what it should.
class Store {
 public:
  using Access = runs::Access;

  /// Told, once each, of findings in the file that cannot be read.
  using OnLeftOut = std::function<void(const std::string& message)>;

  /// The path ":memory:" is a store that goes with this object. A file must have the tables of a store, and
  /// nothing else; what it has of views and triggers never runs.
  Store(const std::string& path, Access access, OnLeftOut on_left_out = {});
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  const std::string& path() const;
  std::vector<Campaign> campaigns() const;

  /// The id of the campaign with this manifest, which is added if there is none.
  std::int64_t open_campaign(const CampaignManifest& manifest);

  /// A tally that was never put is empty.
  TargetTally tally(std::int64_t campaign, std::string_view target) const;
  /// Those that can be read, and have no flaw (flaw_of); the others are left out.
  std::vector<Stored> findings() const;
  /// False if findings() left some out.
  bool is_whole() const;

  /// Writes become durable together, by commit().
  void put(std::int64_t campaign, std::string_view target, const TargetTally& tally);
  void put(std::int64_t campaign, const Finding& finding);
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A campaign's journal in a store. Commits every half second.
class StoreJournal final : public Journal {
 public:
  StoreJournal(Store& store, std::int64_t campaign);
  ~StoreJournal() override;
  void record(const cases::Target& target, const TargetTally& tally,
              const std::vector<Finding>& kept) override;
  void tick() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Puts the campaigns of some shards together in an empty store. If the shards are all there and equally far,
/// the result is what one run would have stored, and can be gone on with. Throws InputError, naming the
/// stores, if they are not shards of the same campaigns, or one is named twice.
void merge(const std::vector<std::string>& paths, Store& into);

/// The library that stores are kept by, and its version.
std::string store_libraries();

}  // namespace lorentz::fuzz
