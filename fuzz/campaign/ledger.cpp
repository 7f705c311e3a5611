#include "fuzz/campaign/ledger.hpp"

#include <algorithm>
#include <chrono>

namespace lorentz::fuzz {
namespace {

// How many batches of a target may be under way for each thread.
constexpr std::size_t kAhead = 64;

// What a case is taken to cost before the first of its target is done, in seconds.
constexpr double kUsual = 0.025;

// Batches of cheap cases are made longer, as long as they take no longer than this: handing out and recording
// is to cost nothing to speak of, and going home in the middle of a batch is to lose little. Far away there
// is the way there and back.
constexpr double kSecondsOfBatch = 0.002, kSecondsFarAway = 0.05;
constexpr std::uint64_t kMostCases = 1024;

}  // namespace

Ledger::Ledger(const Plan& plan, const Bounds& bounds, std::size_t threads, std::vector<TargetTally>& tallies,
               Journal& journal)
    : plan_(plan),
      count_(bounds.count),
      first_(bounds.first),
      most_ahead_(kAhead * threads),
      tallies_(tallies),
      journal_(journal) {
  for (const TargetTally& tally : tallies) {
    tracks_.emplace_back().tally = tally;
    tracks_.back().handed_out = tally.next;
  }
}

// ---- handing out

// Of the targets that have work, the one that had the least time, counting what is in work as usual.
Ledger::Track* Ledger::next_track() {
  Track* next = nullptr;
  double least = 0;
  for (Track& track : tracks_) {
    if (track.handed_out >= count_ || track.in_work >= most_ahead_) continue;
    const double usual = track.cases ? track.seconds / static_cast<double>(track.cases) : kUsual;
    const double time = track.seconds + usual * static_cast<double>(track.pending);
    if (!next || time < least) next = &track, least = time;
  }
  return next;
}

bool Ledger::all_handed_out() const {
  return std::all_of(tracks_.begin(), tracks_.end(),
                     [&](const Track& track) { return track.handed_out >= count_; });
}

// Ends on a multiple of its length, so that batches share a scene where cases do.
Assignment Ledger::assign(Track& track, std::uint64_t batch_size, double seconds) {
  const std::uint64_t begin = track.handed_out;
  const double each = track.cases ? track.seconds / static_cast<double>(track.cases) : kUsual;
  std::uint64_t cases = batch_size;
  while (2 * cases <= kMostCases && 2 * static_cast<double>(cases) * each <= seconds) cases *= 2;
  track.handed_out = std::min((begin / cases + 1) * cases, count_);
  ++track.in_work;
  track.pending += track.handed_out - begin;
  return {{static_cast<std::size_t>(&track - tracks_.data()), begin, track.handed_out}, track.tally.sorts};
}

std::optional<Assignment> Ledger::take(std::uint64_t batch_size) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stop_) return std::nullopt;
    if (Track* track = next_track()) return assign(*track, batch_size, kSecondsOfBatch);
    if (all_handed_out()) return std::nullopt;
    changed_.wait_for(lock, std::chrono::milliseconds(50));
  }
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
  Track& track = tracks_[done.batch.target];
  const std::uint64_t cases = done.batch.end - done.batch.begin;
  track.seconds += done.seconds;
  track.cases += cases;
  track.pending -= cases;
  if (done.result) track.ready.emplace(done.batch.begin, std::pair(done.batch, std::move(*done.result)));
  changed_.notify_all();
}

void Ledger::subject_failed() {
  subject_failed_ = true;
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
  bool complete = true;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    std::vector<Finding> kept;
    const std::uint64_t before = track.tally.next;
    for (auto first = track.ready.begin(); first != track.ready.end() && first->first == track.tally.next;
         first = track.ready.begin()) {
      if (first_ && found_) break;
      record(track, first->second.first, first->second.second, kept);
      track.ready.erase(first);
    }
    if (track.tally.next != before) journal_.record(*plan_.targets[t], track.tally, kept);
    tallies_[t] = track.tally;
    complete &= track.tally.next >= count_;
  }
  return !complete && !stop_;
}

// Only now it is certain how many findings of each sort come before.
void Ledger::record(Track& track, const Batch& batch, BatchResult& result, std::vector<Finding>& kept) {
  for (BatchResult::Kept& one : result.kept)
    if (track.tally.sorts[one.finding.sort] + one.ordinal <= plan_.keep)
      kept.push_back(std::move(one.finding));
  track.tally.add(result.met);
  track.tally.next = batch.end;
  --track.in_work;
  found_ |= !result.met.sorts.empty();
  if (first_ && found_) stop_ = true;
}

}  // namespace lorentz::fuzz
