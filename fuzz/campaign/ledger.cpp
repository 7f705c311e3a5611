#include "fuzz/campaign/ledger.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace lorentz::fuzz {
namespace {

// Number of a target's stints that may be under way for each thread.
constexpr std::size_t kAhead = 64;

// Assumed seconds for a case, and for shrinking, before the first of its target is done.
constexpr double kUsual = 0.025, kUsualShrinking = 0.1;

// Stints of cheap cases are made longer, as long as they take no longer than this. Then handing out and
// recording cost next to nothing, and a stop in the middle of a stint loses little. For another process
// (kSecondsFarAway) the way there and back counts, too. An answerer that takes many cases at once gets as
// many as take no longer than kSecondsOfMany, because another program's answers are awaited once per stint.
constexpr double kSecondsOfBatch = 0.002, kSecondsFarAway = 0.05, kSecondsOfMany = 0.25;
constexpr std::uint64_t kMostCasesAhead = 1024;

// The largest shares of a target's time that go into shrinking, while there are cases: kShareOfWrong if the
// next finding is wrong in some way, kShareOfOthers otherwise.
constexpr double kShareOfWrong = 0.5, kShareOfOthers = 0.25;

// If the time of a campaign is limited, so is the time for one finding: to this share of the time of its
// target, so that no target falls behind for long, and to this number of seconds.
constexpr double kShareOfOne = 0.125, kMostSecondsOfOne = 10;

double most_shrinking(const Plan& plan, const Bounds& bounds, std::size_t threads) {
  if (!bounds.limits_time()) return std::numeric_limits<double>::infinity();
  const double of_target =
      bounds.seconds * static_cast<double>(threads) / static_cast<double>(plan.targets.size());
  return std::min(kShareOfOne * of_target, kMostSecondsOfOne);
}

bool is_wrong(int rank) {
  return rank < rank_of(name_of(Kind::undecided).words);
}

}  // namespace

Ledger::Ledger(const Plan& plan, const Bounds& bounds, std::size_t threads, std::vector<TargetTally>& tallies,
               Journal& journal, const std::vector<Finding>& unshrunk)
    : plan_(plan),
      count_(bounds.count),
      first_(bounds.first),
      most_ahead_(kAhead * threads),
      most_shrinking_(most_shrinking(plan, bounds, threads)),
      tallies_(tallies),
      journal_(journal) {
  for (std::size_t t = 0; t < tallies.size(); ++t) {
    Track& track = tracks_.emplace_back();
    track.tally = tallies[t];
    track.handed_out = tallies[t].next;
    for (const Finding& one : unshrunk) {
      // Shrinking that was cut short would be cut short again, unless the time is unlimited.
      const bool is_due =
          one.shrinking == Shrinking::due || (one.shrinking == Shrinking::cut_short && !bounds.limits_time());
      if (is_due && one.target == plan.targets[t]->name()) track.due.emplace(rank_of(one.kind), one);
    }
  }
}

// ---- handing out

bool Ledger::has_cases(const Track& track) const {
  return !is_closing_ && track.handed_out < count_ && track.in_work < most_ahead_;
}

double Ledger::usual_shrinking(const Track& track) const {
  return track.shrinkings ? track.shrinking_seconds / static_cast<double>(track.shrinkings)
                          : std::min(kUsualShrinking, most_shrinking_);
}

// The time that the target had, and will have had when all that is under way is back.
double Ledger::time_of(const Track& track) const {
  return track.seconds + track.usual.value_or(kUsual) * static_cast<double>(track.pending) +
         usual_shrinking(track) * static_cast<double>(track.in_shrinking);
}

// The target with the least time among those that have work.
Ledger::Track* Ledger::next_track() {
  Track* next = nullptr;
  for (Track& track : tracks_) {
    if (!has_cases(track) && track.due.empty()) continue;
    if (!next || time_of(track) < time_of(*next)) next = &track;
  }
  return next;
}

bool Ledger::shrinks_next(const Track& track) const {
  if (track.due.empty() || !has_cases(track)) return !track.due.empty();
  const double spent =
      track.shrinking_seconds + usual_shrinking(track) * static_cast<double>(track.in_shrinking);
  const double share = is_wrong(track.due.begin()->first) ? kShareOfWrong : kShareOfOthers;
  return spent <= share * time_of(track);
}

Assignment Ledger::assign(Track& track, std::uint64_t batch_size, double seconds) {
  return shrinks_next(track) ? assign_shrinking(track) : assign_cases(track, batch_size, seconds);
}

Assignment Ledger::assign_shrinking(Track& track) {
  Assignment one{{static_cast<std::size_t>(&track - tracks_.data()), 0, 0}};
  const auto first = track.due.begin();
  one.due = std::move(first->second);
  one.most_seconds = most_shrinking_;
  track.due.erase(first);
  ++track.in_shrinking;
  return one;
}

// One case until the time for a case is known. Ends on a multiple of its length, so that stints share a scene
// where cases do.
Assignment Ledger::assign_cases(Track& track, std::uint64_t batch_size, double seconds) {
  const std::uint64_t begin = track.handed_out;
  std::uint64_t cases = 1;
  const auto double_until = [&](std::uint64_t most, double most_seconds) {
    while (track.usual && 2 * cases <= most && 2 * static_cast<double>(cases) * *track.usual <= most_seconds)
      cases *= 2;
  };
  double_until(batch_size, kSecondsOfMany);
  double_until(kMostCasesAhead, seconds);
  track.handed_out = std::min((begin / cases + 1) * cases, count_);
  ++track.in_work;
  track.pending += track.handed_out - begin;
  return {{static_cast<std::size_t>(&track - tracks_.data()), begin, track.handed_out}, track.tally.sorts};
}

std::optional<Assignment> Ledger::take(std::uint64_t batch_size) {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    if (Track* track = next_track()) return assign(*track, batch_size, kSecondsOfBatch);
    changed_.wait_for(lock, std::chrono::milliseconds(50));
  }
  return std::nullopt;
}

std::vector<Assignment> Ledger::take_some(std::size_t most, std::uint64_t batch_size) {
  const std::lock_guard lock(mutex_);
  std::vector<Assignment> some;
  while (some.size() < most && !stop_) {
    Track* track = next_track();
    if (!track) break;
    some.push_back(assign(*track, batch_size, kSecondsFarAway));
  }
  return some;
}

// ---- taking back

void Ledger::hand_in(Done done) {
  const std::lock_guard lock(mutex_);
  Track& track = tracks_[done.stint.target];
  track.seconds += done.seconds;
  if (done.answerer_failed && (done.result || done.shrunk)) answerer_failed_ = true;
  if (const std::uint64_t cases = done.stint.end - done.stint.begin) {
    const double each = done.seconds / static_cast<double>(cases);
    track.usual = track.usual ? (*track.usual + each) / 2 : each;
    track.pending -= cases;
    if (done.result) track.ready.emplace(done.stint.begin, std::pair(done.stint, std::move(*done.result)));
  } else {
    track.shrinking_seconds += done.seconds;
    ++track.shrinkings;
    --track.in_shrinking;
    if (done.shrunk) track.shrunk.push_back(std::move(*done.shrunk));
  }
  changed_.notify_all();
}

void Ledger::fail(std::exception_ptr failure) {
  {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  stop_all();
}

void Ledger::stop_all() {
  stop_ = true;
  changed_.notify_all();
}

// ---- recording

bool Ledger::record() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  bool has_new = false;
  for (std::size_t t = 0; t < tracks_.size(); ++t) has_new |= record(t);
  if (has_new) changed_.notify_all();
  const bool complete =
      std::all_of(tracks_.begin(), tracks_.end(), [&](const Track& track) { return is_complete(track); });
  return !complete && !stop_;
}

bool Ledger::is_complete(const Track& track) const {
  return (is_closing_ || track.tally.next >= count_) && track.due.empty() && track.in_shrinking == 0;
}

// Returns whether there is a new finding to shrink.
bool Ledger::record(std::size_t target) {
  Track& track = tracks_[target];
  std::vector<Finding> news = std::exchange(track.shrunk, {});
  const std::size_t due_before = track.due.size();
  const std::uint64_t before = track.tally.next;
  for (auto first = track.ready.begin(); first != track.ready.end() && first->first == track.tally.next;
       first = track.ready.begin()) {
    if (is_closing_) break;
    record(track, first->second.first, first->second.second, news);
    track.ready.erase(first);
  }
  if (track.tally.next != before || !news.empty()) journal_.record(*plan_.targets[target], track.tally, news);
  tallies_[target] = track.tally;
  return track.due.size() != due_before;
}

// Only now is it certain how many findings of each sort come before.
void Ledger::record(Track& track, const Stint& stint, StintResult& result, std::vector<Finding>& kept) {
  for (StintResult::Kept& one : result.kept) {
    if (track.tally.sorts[one.finding.sort] + one.ordinal > plan_.keep) continue;
    if (one.finding.shrinking == Shrinking::due) track.due.emplace(rank_of(one.finding.kind), one.finding);
    kept.push_back(std::move(one.finding));
  }
  track.tally.add(result.met);
  track.tally.next = stint.end;
  --track.in_work;
  is_closing_ |= first_ && !result.met.sorts.empty();
}

}  // namespace lorentz::fuzz
