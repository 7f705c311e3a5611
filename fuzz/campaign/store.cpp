#include "fuzz/campaign/store.hpp"

#include <charconv>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "fuzz/campaign/stint.hpp"
#include "report/runs/database.hpp"
#include "src/exchange/json_piece.hpp"

namespace lorentz::fuzz {

using namespace cases;
using runs::BadValue;
using runs::Statement;

namespace {

// Rows are read and written in the order of these columns; a file with others is refused.
constexpr const char* kSchema = R"sql(
  CREATE TABLE campaign (
    id INTEGER PRIMARY KEY, version TEXT NOT NULL, engine TEXT NOT NULL, targets TEXT NOT NULL,
    seed TEXT NOT NULL, options TEXT NOT NULL, keep INTEGER NOT NULL, shard TEXT NOT NULL,
    UNIQUE (version, engine, targets, seed, options, keep, shard));
  CREATE TABLE account (
    campaign INTEGER NOT NULL, target TEXT NOT NULL, next INTEGER NOT NULL, cases INTEGER NOT NULL,
    mutants INTEGER NOT NULL, reworded INTEGER NOT NULL, counts TEXT NOT NULL,
    binary64 INTEGER NOT NULL, double_double INTEGER NOT NULL, exact INTEGER NOT NULL,
    margin REAL, margin_index INTEGER NOT NULL,
    PRIMARY KEY (campaign, target)) WITHOUT ROWID;
  CREATE TABLE sort (
    campaign INTEGER NOT NULL, target TEXT NOT NULL, sort TEXT NOT NULL, number INTEGER NOT NULL,
    PRIMARY KEY (campaign, target, sort)) WITHOUT ROWID;
  CREATE TABLE finding (
    campaign INTEGER NOT NULL, target TEXT NOT NULL, place INTEGER NOT NULL, step INTEGER NOT NULL,
    words TEXT NOT NULL, kind TEXT NOT NULL, sort TEXT NOT NULL, cause TEXT NOT NULL,
    scene TEXT NOT NULL, query TEXT NOT NULL, given TEXT NOT NULL, exact TEXT NOT NULL,
    departs REAL NOT NULL, margin REAL, shrunk_scene TEXT NOT NULL, shrunk_query TEXT NOT NULL,
    shrunk_given TEXT NOT NULL, shrunk_exact TEXT NOT NULL, shrunk_departs REAL NOT NULL, shrunk_margin REAL,
    shrinking INTEGER NOT NULL, bits INTEGER NOT NULL, complexity INTEGER NOT NULL, tries INTEGER NOT NULL,
    PRIMARY KEY (campaign, target, place, step, words)) WITHOUT ROWID;
)sql";

const runs::FileKind& kind() {
  static const runs::FileKind kind{
      "store of lorentz fuzz", 0x6c6f667a,  // "lofz"
      5, kSchema,                           // format 4 had a finding's numbers behind its texts
      "another process is running a campaign on this store; wait for it, stop it, or use another store "
      "(shards have one each, `lorentz fuzz merge` joins them)"};
  return kind;
}

}  // namespace

std::string Stored::label() const {
  return std::to_string(campaign) + '/' + label_of(finding);
}

Store::Store(const std::string& path, Access access, OnLeftOut on_left_out)
    : database_(path, access, kind()), on_left_out_(std::move(on_left_out)) {}

// A finding that cannot be read does not affect the others.
void Store::leave_out(const std::string& label, const std::string& why) const {
  if (left_out_.insert(label).second && on_left_out_)
    on_left_out_(path() + ": the finding " + label + " is left out: " + why);
}

namespace {

std::uint64_t seed_in(const std::string& text, const std::string& path) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size())
    throw FileError(path + ": a campaign has a seed that is not a number; take a copy from before");
  return seed;
}

}  // namespace

std::vector<Campaign> Store::campaigns() const {
  Statement all(database_.connection(), "SELECT * FROM campaign ORDER BY id");
  std::vector<Campaign> campaigns;
  while (all.step()) {
    Campaign one;
    one.id = all.integer();
    one.manifest.version = all.text();
    one.manifest.engine = all.text();
    one.manifest.targets = all.text();
    one.manifest.seed = seed_in(all.text(), path());
    one.manifest.options = all.text();
    one.manifest.keep = all.count();
    one.manifest.shard = all.text();
    campaigns.push_back(std::move(one));
  }
  return campaigns;
}

std::int64_t Store::open_campaign(const CampaignManifest& manifest) {
  for (const Campaign& campaign : campaigns())
    if (campaign.manifest == manifest) return campaign.id;
  database_.begin();
  Statement(database_.connection(), "INSERT INTO campaign VALUES (NULL, ?, ?, ?, ?, ?, ?, ?)")
      .bind(manifest.version)
      .bind(manifest.engine)
      .bind(manifest.targets)
      .bind(std::to_string(manifest.seed))
      .bind(manifest.options)
      .bind(manifest.keep)
      .bind(manifest.shard)
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
  const std::uint64_t replies = tally.cases + tally.variants + tally.reworded;
  return tally.counts.all() == replies && sum(tally.stages) <= replies && tally.margin > 0;
}

}  // namespace

TargetTally Store::tally(std::int64_t campaign, std::string_view target) const {
  constexpr std::uint64_t kMostCases = std::uint64_t{1} << 60;  // sums of all of them are below 2^63
  TargetTally tally;
  Statement row(
      database_.connection(),
      "SELECT next, cases, mutants, reworded, counts, binary64, double_double, exact, margin, margin_index "
      "FROM account WHERE campaign = ? AND target = ?");
  row.bind(campaign).bind(target);
  if (!row.step()) return tally;
  tally.next = row.count();
  for (std::uint64_t* number : {&tally.cases, &tally.variants, &tally.reworded})
    *number = row.count(kMostCases);
  try {
    json::read_piece(row.text(), tally.counts);
  } catch (const InputError& error) {
    throw FileError(path() + ": the counts of " + std::string(target) + ": " + error.what());
  }
  for (std::uint64_t& number : tally.stages) number = row.count(kMostCases);
  tally.margin = row.real_or_null().value_or(tally.margin);
  tally.margin_index = row.count();
  if (!fits(tally))
    throw FileError(path() + ": the counts of " + std::string(target) +
                    " do not fit together: the store was changed; take a copy from before, or name another");
  Statement sorts(database_.connection(), "SELECT sort, number FROM sort WHERE campaign = ? AND target = ?");
  sorts.bind(campaign).bind(target);
  while (sorts.step()) {
    std::string sort = sorts.text();
    tally.sorts.emplace(std::move(sort), sorts.count(kMostCases));
  }
  return tally;
}

namespace {

// The columns of a finding are its members, one after the other, and those of its texts.
template <class T>
void from_row(Statement& row, T& member) {
  if constexpr (requires { members_of(member); })
    std::apply([&](auto&... each) { (from_row(row, each), ...); }, members_of(member));
  else if constexpr (std::is_same_v<T, std::string>)
    member = row.text();
  else if constexpr (std::is_same_v<T, double>)
    member = row.real();
  else if constexpr (std::is_same_v<T, std::optional<double>>)
    member = row.real_or_null();
  else if constexpr (std::is_same_v<T, Shrinking>)
    member = static_cast<Shrinking>(row.count(static_cast<std::uint64_t>(Shrinking::done)));
  else if constexpr (std::is_same_v<T, int>)
    member = row.small();
  else
    member = static_cast<T>(row.count());
}
template <class T>
void to_row(Statement& row, T& member) {
  if constexpr (requires { members_of(member); })
    std::apply([&](auto&... each) { (to_row(row, each), ...); }, members_of(member));
  else if constexpr (std::is_same_v<T, Shrinking>)
    row.bind(static_cast<int>(member));
  else
    row.bind(member);
}

}  // namespace

std::vector<Stored> Store::findings() const {
  Statement row(database_.connection(),
                "SELECT * FROM finding ORDER BY campaign, target, place, step, words");
  std::vector<Stored> all;
  for (std::uint64_t number = 1; row.step(); ++number) {
    std::string label = "in row " + std::to_string(number);
    try {
      Stored one{row.integer(), {}};
      from_row(row, one.finding);
      label = one.label();
      if (const std::string flaw = flaw_of(one.finding); !flaw.empty()) throw BadValue("it has " + flaw);
      all.push_back(std::move(one));
    } catch (const BadValue& error) {
      leave_out(label, error.what());
    }
  }
  return all;
}

void Store::put(std::int64_t campaign, std::string_view target, const TargetTally& tally) {
  database_.begin();
  Statement row(database_.connection(),
                "INSERT OR REPLACE INTO account VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(campaign).bind(target);
  for (const std::uint64_t number : {tally.next, tally.cases, tally.variants, tally.reworded})
    row.bind(number);
  row.bind(json::piece_of(tally.counts));
  for (const std::uint64_t number : tally.stages) row.bind(number);
  row.bind(std::isfinite(tally.margin) ? std::optional(tally.margin) : std::nullopt)
      .bind(tally.margin_index)
      .done();
  Statement sort(database_.connection(), "INSERT OR REPLACE INTO sort VALUES (?, ?, ?, ?)");
  for (const auto& [name, number] : tally.sorts)
    sort.bind(campaign).bind(target).bind(name).bind(number).done();
}

void Store::put(std::int64_t campaign, const Finding& finding) {
  database_.begin();
  Statement row(database_.connection(),
                "INSERT OR REPLACE INTO finding VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                "?, ?, ?, ?, ?, ?, ?)");
  row.bind(campaign);
  to_row(row, const_cast<Finding&>(finding));
  row.done();
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
