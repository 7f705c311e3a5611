#include "fuzz/campaign/store.hpp"

#include <numeric>

#include "fuzz/campaign/stint.hpp"
#include "src/exchange/json_piece.hpp"

namespace lorentz::fuzz {

using namespace cases;
using runs::BadValue;
using runs::Statement;

namespace {

// Campaigns, tallies and findings are pieces of JSON (src/exchange/json_piece.hpp).
constexpr const char* kSchema = R"sql(
  CREATE TABLE campaign (id INTEGER PRIMARY KEY, manifest TEXT NOT NULL UNIQUE);
  CREATE TABLE tally (
    campaign INTEGER NOT NULL, target TEXT NOT NULL, tally TEXT NOT NULL,
    PRIMARY KEY (campaign, target)) WITHOUT ROWID;
  CREATE TABLE finding (
    campaign INTEGER NOT NULL, target TEXT NOT NULL, place INTEGER NOT NULL, step INTEGER NOT NULL,
    words TEXT NOT NULL, finding TEXT NOT NULL,
    PRIMARY KEY (campaign, target, place, step, words)) WITHOUT ROWID;
)sql";

const runs::FileKind& kind() {
  static const runs::FileKind kind{
      "store of lorentz fuzz", 0x6c6f667a,  // "lofz"
      6, kSchema,                           // format 5 had a column for each number
      "another process is running a campaign on this store; wait for it, stop it, or use another store"};
  return kind;
}

}  // namespace

std::string Stored::label() const {
  return std::to_string(campaign) + '/' + label_of(finding);
}

Store::Store(const std::string& path, Access access) : database_(path, access, kind()) {}

namespace {

// Reads the piece in the next column of a row.
template <class T>
T read_from(Statement& row, const std::string& what) {
  const std::string piece = row.text();
  T value;
  try {
    json::read_piece(piece, value);
  } catch (const InputError& error) {
    throw BadValue(what + error.what());
  }
  return value;
}

}  // namespace

std::vector<Campaign> Store::campaigns() const {
  Statement all(database_.connection(), "SELECT id, manifest FROM campaign ORDER BY id");
  std::vector<Campaign> campaigns;
  while (all.step()) {
    const std::int64_t id = all.integer();
    campaigns.push_back({id, read_from<CampaignManifest>(all, path() + ": a campaign ")});
  }
  return campaigns;
}

std::int64_t Store::open_campaign(const CampaignManifest& manifest) {
  for (const Campaign& campaign : campaigns())
    if (campaign.manifest == manifest) return campaign.id;
  database_.begin();
  Statement(database_.connection(), "INSERT INTO campaign VALUES (NULL, ?)")
      .bind(json::piece_of(manifest))
      .done();
  const std::int64_t id = sqlite3_last_insert_rowid(database_.connection().handle());
  commit();
  return id;
}

namespace {

// Do the counts fit together, as a campaign makes them?
bool fits(const TargetTally& tally) {
  const auto sum = [](const auto& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
  };
  constexpr std::uint64_t kMostCases = std::uint64_t{1} << 60;  // sums of all of them are below 2^63
  for (const std::uint64_t number : {tally.cases, tally.variants, tally.reworded})
    if (number > kMostCases) return false;
  const std::uint64_t replies = tally.cases + tally.variants + tally.reworded;
  return tally.counts.all() == replies && sum(tally.stages) <= replies && tally.margin > 0;
}

}  // namespace

TargetTally Store::tally(std::int64_t campaign, std::string_view target) const {
  Statement row(database_.connection(), "SELECT tally FROM tally WHERE campaign = ? AND target = ?");
  row.bind(campaign).bind(target);
  if (!row.step()) return {};
  const std::string its = path() + ": the counts of " + std::string(target) + ' ';
  auto tally = read_from<TargetTally>(row, its);
  if (!fits(tally))
    throw FileError(its +
                    "do not fit together: the store was changed; take a copy from before, or name another");
  return tally;
}

std::vector<Stored> Store::findings() const {
  Statement row(database_.connection(),
                "SELECT campaign, finding FROM finding ORDER BY campaign, target, place, step, words");
  std::vector<Stored> all;
  while (row.step()) {
    const std::int64_t campaign = row.integer();
    all.push_back({campaign, read_from<Finding>(row, path() + ": a finding ")});
    if (const std::string flaw = flaw_of(all.back().finding); !flaw.empty())
      throw BadValue(path() + ": the finding " + all.back().label() + " has " + flaw +
                     ": the store was changed; take a copy from before, or name another");
  }
  return all;
}

void Store::put(std::int64_t campaign, std::string_view target, const TargetTally& tally) {
  database_.begin();
  Statement(database_.connection(), "INSERT OR REPLACE INTO tally VALUES (?, ?, ?)")
      .bind(campaign)
      .bind(target)
      .bind(json::piece_of(tally))
      .done();
}

void Store::put(std::int64_t campaign, const Finding& finding) {
  database_.begin();
  Statement(database_.connection(), "INSERT OR REPLACE INTO finding VALUES (?, ?, ?, ?, ?, ?)")
      .bind(campaign)
      .bind(finding.target)
      .bind(finding.index)
      .bind(finding.step)
      .bind(finding.words)
      .bind(json::piece_of(finding))
      .done();
}

// ---- a campaign's journal

StoreJournal::~StoreJournal() {
  try {
    write();
  } catch (const FileError&) {  // another error ends the program already, or the last half second is lost
  }
}

void StoreJournal::record(const Target& target, const TargetTally& tally, const std::vector<Finding>& kept) {
  unwritten_[target.name()] = tally;
  findings_.insert(findings_.end(), kept.begin(), kept.end());
}

void StoreJournal::tick() {
  constexpr std::chrono::milliseconds kBetweenCommits{500};
  if (JournalClock::now() - last_commit_ >= kBetweenCommits) write();
}

void StoreJournal::write() {
  for (const auto& [target, tally] : unwritten_) store_.put(campaign_, target, tally);
  for (const Finding& finding : findings_) store_.put(campaign_, finding);
  unwritten_.clear();
  findings_.clear();
  store_.commit();
  last_commit_ = JournalClock::now();
}

std::string store_libraries() {
  return std::string("SQLite ") + sqlite3_libversion();
}

}  // namespace lorentz::fuzz
