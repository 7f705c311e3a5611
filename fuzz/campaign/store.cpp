#include "fuzz/campaign/store.hpp"

#include <algorithm>

#include "fuzz/campaign/stint.hpp"
#include "report/runs/piece_store.hpp"
#include "src/exchange/json_piece.hpp"

namespace lorentz::fuzz {

using namespace cases;
using runs::BadValue;
using runs::Statement;

namespace {

// Campaigns, tallies and findings are pieces of JSON (src/exchange/json_piece.hpp) behind their checks.
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
      7, kSchema,                           // format 6 had no checks
      "another process is running a campaign on this store; wait for it, stop it, or use another store"};
  return kind;
}

}  // namespace

std::string Stored::label() const {
  return std::to_string(campaign) + '/' + label_of(finding);
}

Store::Store(const std::string& path, Access access) : database_(path, access, kind()) {}

namespace {

std::string check_in_front_of(std::string_view piece) {
  return std::to_string(runs::check_of(piece));
}

// The value as a piece, with its check.
template <class T>
std::string checked(const T& value) {
  const std::string piece = json::piece_of(value);
  return check_in_front_of(piece) + piece;
}

// Reads the piece in the next column of a row.
template <class T>
T read_from(Statement& row, const std::string& what) {
  const std::string text = row.text(), piece = text.substr(std::min(text.find('['), text.size()));
  if (text != check_in_front_of(piece) + piece)
    throw BadValue(what + "is damaged: it is not what its checksum was made of" + runs::kRemedy);
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
  Statement(database_.connection(), "INSERT INTO campaign VALUES (NULL, ?)").bind(checked(manifest)).done();
  const std::int64_t id = sqlite3_last_insert_rowid(database_.connection().handle());
  commit();
  return id;
}

TargetTally Store::tally(std::int64_t campaign, std::string_view target) const {
  Statement row(database_.connection(), "SELECT tally FROM tally WHERE campaign = ? AND target = ?");
  row.bind(campaign).bind(target);
  if (!row.step()) return {};
  return read_from<TargetTally>(row, path() + ": the counts of " + std::string(target) + ' ');
}

std::vector<Stored> Store::findings() const {
  Statement row(database_.connection(),
                "SELECT campaign, finding FROM finding ORDER BY campaign, target, place, step, words");
  std::vector<Stored> all;
  while (row.step()) {
    const std::int64_t campaign = row.integer();
    all.push_back({campaign, read_from<Finding>(row, path() + ": a finding ")});
  }
  return all;
}

void Store::put(std::int64_t campaign, std::string_view target, const TargetTally& tally) {
  database_.begin();
  Statement(database_.connection(), "INSERT OR REPLACE INTO tally VALUES (?, ?, ?)")
      .bind(campaign)
      .bind(target)
      .bind(checked(tally))
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
      .bind(checked(finding))
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
