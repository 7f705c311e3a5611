// Merges shards: tallies add up, and the first findings of each sort are kept, as one run would have kept
// them.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include <lorentz/errors.hpp>
#include "fuzz/campaign/store.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::fuzz {
namespace {

struct Shard {
  std::string path;
  std::vector<Campaign> campaigns;
  std::vector<Stored> findings;
};

std::string number_of_shards(const std::string& shard) {
  const auto slash = shard.find('/');
  return slash == std::string::npos ? "" : shard.substr(slash + 1);
}

// The difference between the manifests of two stores that should be shards of one campaign, or nothing.
std::string difference(const CampaignManifest& a, const CampaignManifest& b) {
  if (a.version != b.version) return "version " + a.version + " and " + b.version;
  if (a.engine != b.engine) return "engine " + a.engine + " and " + b.engine;
  if (a.targets != b.targets) return "targets " + a.targets + " and " + b.targets;
  if (a.seed != b.seed) return "seed " + std::to_string(a.seed) + " and " + std::to_string(b.seed);
  if (a.options != b.options || a.keep != b.keep) return "options " + a.options + " and " + b.options;
  if (number_of_shards(a.shard) != number_of_shards(b.shard) || number_of_shards(a.shard).empty())
    return "shard " + a.shard + " and " + b.shard;
  return {};
}

// Finds a store that is named twice, by whatever names: links count.
void check_names(const std::vector<std::string>& paths) {
  std::error_code error;
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::filesystem::equivalent(paths[i], paths[j], error))
        throw InputError(paths[i] == paths[j] ? paths[i] + ": is given twice"
                                              : paths[j] + " and " + paths[i] + " are the same store");
}

void check_all(const std::vector<Shard>& shards) {
  const Shard& first = shards.front();
  if (first.campaigns.empty()) throw InputError(first.path + ": holds no campaign");
  for (const Shard& other : shards) {
    if (other.campaigns.size() != first.campaigns.size())
      throw InputError(first.path + " and " + other.path + " hold different campaigns (" +
                       std::to_string(first.campaigns.size()) + " and " +
                       std::to_string(other.campaigns.size()) + " of them)");
    for (std::size_t c = 0; c < first.campaigns.size(); ++c)
      if (const auto what = difference(first.campaigns[c].manifest, other.campaigns[c].manifest);
          !what.empty())
        throw InputError(first.path + " and " + other.path + " are not shards of one campaign: " + what);
  }
  for (std::size_t c = 0; c < first.campaigns.size(); ++c) {
    std::map<std::string, std::string> seen;
    for (const Shard& shard : shards) {
      const auto [other, is_new] = seen.emplace(shard.campaigns[c].manifest.shard, shard.path);
      if (!is_new)
        throw InputError(other->second + " and " + shard.path + " are the same shard, " + other->first);
    }
  }
}

// The findings of campaign number c, of all shards, that one run would have kept.
std::vector<Finding> kept_of(const std::vector<Shard>& shards, std::size_t c) {
  std::vector<Finding> all, kept;
  for (const Shard& shard : shards)
    for (const Stored& one : shard.findings)
      if (one.campaign == shard.campaigns[c].id) all.push_back(one.finding);
  std::sort(all.begin(), all.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.target, a.index, a.step, a.words) < std::tie(b.target, b.index, b.step, b.words);
  });
  std::map<std::pair<std::string, std::string>, std::uint64_t> number;
  for (Finding& one : all)
    if (++number[{one.target, one.sort}] <= shards.front().campaigns[c].manifest.keep)
      kept.push_back(std::move(one));
  return kept;
}

}  // namespace

void merge(const std::vector<std::string>& paths, Store& into) {
  check_names(paths);
  if (!into.campaigns().empty()) throw InputError(into.path() + ": is not empty; merge into a new store");
  std::vector<Shard> shards;
  std::vector<std::unique_ptr<Store>> stores;
  for (const std::string& path : paths) {
    stores.push_back(std::make_unique<Store>(path, Store::Access::settled,
                                             [](const std::string& message) { throw FileError(message); }));
    shards.push_back({path, stores.back()->campaigns(), stores.back()->findings()});
  }
  check_all(shards);
  for (std::size_t c = 0; c < shards.front().campaigns.size(); ++c) {
    CampaignManifest manifest = shards.front().campaigns[c].manifest;
    bool even = std::to_string(shards.size()) == number_of_shards(manifest.shard);
    std::map<std::string, TargetTally> sums;
    for (const std::string& target : items_of(manifest.targets, "targets")) {
      TargetTally& sum = sums[target];
      for (std::size_t s = 0; s < shards.size(); ++s) {
        const TargetTally one = stores[s]->tally(shards[s].campaigns[c].id, target);
        if (s > 0) even &= one.next == sum.next;
        sum.next = s == 0 ? one.next : std::min(sum.next, one.next);
        sum.add(one);
      }
    }
    manifest.shard = even ? "0/1" : CampaignManifest::kMerged;
    const std::int64_t id = into.open_campaign(manifest);
    for (const auto& [target, sum] : sums) into.put(id, target, sum);
    for (const Finding& finding : kept_of(shards, c)) into.put(id, finding);
  }
  into.commit();
}

}  // namespace lorentz::fuzz
