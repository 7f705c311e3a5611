#include "campaign.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <tuple>

#include "stint.hpp"

namespace lorentz::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

// How often work is recorded, and how many stints of a target may be under way for each thread meanwhile.
constexpr std::chrono::milliseconds kPause{5};
constexpr std::size_t kAhead = 64;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A target in a running campaign.
struct Track {
  Account account;                                               // of what is recorded
  std::uint64_t handed_out = 0;                                  // the first index that nobody has
  std::size_t in_work = 0;                                       // stints handed out and not recorded
  double seconds = 0;                                            // of all threads
  std::uint64_t stints = 0;                                      // that took them
  std::map<std::uint64_t, std::pair<Stint, StintResult>> ready;  // by first index: done, not recorded
};

class Crew {
 public:
  Crew(const Plan& plan, const Bounds& bounds, const MakeSubject& make_subject,
       std::vector<Account>& accounts, Journal& journal)
      : plan_(plan), bounds_(bounds), make_subject_(make_subject), accounts_(accounts), journal_(journal) {
    for (const Account& account : accounts) {
      tracks_.emplace_back().account = account;
      tracks_.back().handed_out = account.next;
    }
  }

  bool run() {
    const auto start = Clock::now();
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < bounds_.jobs; ++i) threads.emplace_back([this] { work(); });
    try {
      for (bool more = true; more;) {
        more = record_what_is_ready();
        journal_.tick();
        if (seconds_since(start) >= bounds_.seconds || (bounds_.stop && *bounds_.stop)) stop_ = true;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    record_what_is_ready();  // what came in while the threads were told to stop
    journal_.tick();
    return subject_failed_;
  }

 private:
  // ---- the threads

  void work() {
    try {
      StintWorker worker(plan_, make_subject_, stop_);
      for (;;) {
        const auto stint = next_stint(worker.batch());
        if (!stint) break;
        const auto start = Clock::now();
        auto result = worker.work(*stint, known_of(*stint));
        hand_in(*stint, std::move(result), seconds_since(start));
      }
      const std::lock_guard lock(mutex_);
      subject_failed_ |= worker.subject_failed();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
    changed_.notify_all();
  }

  // Of the targets that have work, the one that had the least time, counting what is in work as usual.
  Track* next_track() {
    const std::size_t most = kAhead * bounds_.jobs;
    Track* next = nullptr;
    double least = 0;
    for (Track& track : tracks_) {
      if (track.handed_out >= bounds_.count || track.in_work >= most) continue;
      const double usual = track.stints ? track.seconds / static_cast<double>(track.stints) : 0.1;
      const double time = track.seconds + usual * static_cast<double>(track.in_work);
      if (!next || time < least) next = &track, least = time;
    }
    return next;
  }

  std::optional<Stint> next_stint(std::uint64_t batch) {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (stop_) return std::nullopt;
      if (Track* track = next_track()) {
        const std::uint64_t begin = track->handed_out, rounded = (begin / batch + 1) * batch;
        track->handed_out = std::min(rounded, bounds_.count);
        ++track->in_work;
        return Stint{static_cast<std::size_t>(track - tracks_.data()), begin, track->handed_out};
      }
      if (all_handed_out()) return std::nullopt;
      changed_.wait_for(lock, std::chrono::milliseconds(50));
    }
  }

  bool all_handed_out() const {
    return std::all_of(tracks_.begin(), tracks_.end(),
                       [&](const Track& track) { return track.handed_out >= bounds_.count; });
  }

  std::map<std::string, std::uint64_t> known_of(const Stint& stint) {
    const std::lock_guard lock(mutex_);
    return tracks_[stint.target].account.sorts;
  }

  void hand_in(const Stint& stint, std::optional<StintResult> result, double seconds) {
    const std::lock_guard lock(mutex_);
    Track& track = tracks_[stint.target];
    track.seconds += seconds;
    ++track.stints;
    if (result) track.ready.emplace(stint.begin, std::pair(stint, std::move(*result)));
    changed_.notify_all();
  }

  // ---- the record

  // Waits a little. Each target's stints are recorded in the order of their indices. Returns whether there
  // may be more.
  bool record_what_is_ready() {
    if (!stop_) std::this_thread::sleep_for(kPause);
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    bool complete = true;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      Track& track = tracks_[t];
      std::vector<Finding> kept;
      const std::uint64_t before = track.account.next;
      for (auto first = track.ready.begin(); first != track.ready.end() && first->first == track.account.next;
           first = track.ready.begin()) {
        if (bounds_.first && found_) break;
        record(track, first->second.first, first->second.second, kept);
        track.ready.erase(first);
      }
      if (track.account.next != before) journal_.record(*plan_.targets[t], track.account, kept);
      accounts_[t] = track.account;
      complete &= track.account.next >= bounds_.count;
    }
    return !complete && !stop_;
  }

  // Only now it is certain how many findings of each sort come before.
  void record(Track& track, const Stint& stint, StintResult& result, std::vector<Finding>& kept) {
    for (StintResult::Kept& one : result.kept)
      if (track.account.sorts[one.finding.sort] + one.ordinal <= plan_.keep)
        kept.push_back(std::move(one.finding));
    track.account.add(result.met);
    track.account.next = stint.end;
    --track.in_work;
    found_ |= !result.met.sorts.empty();
    if (bounds_.first && found_) stop_ = true;
  }

  const Plan& plan_;
  const Bounds& bounds_;
  const MakeSubject& make_subject_;
  std::vector<Account>& accounts_;
  Journal& journal_;
  std::vector<Track> tracks_;
  std::atomic<bool> stop_ = false;
  bool subject_failed_ = false;
  bool found_ = false;  // a finding is recorded
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace

void Account::add(const Account& other) {
  cases += other.cases;
  mutants += other.mutants;
  for (std::size_t k = 0; k < kinds.size(); ++k) kinds[k] += other.kinds[k];
  for (const auto& [sort, number] : other.sorts) sorts[sort] += number;
  if (std::tie(other.margin, other.margin_index) < std::tie(margin, margin_index))
    margin = other.margin, margin_index = other.margin_index;
}

bool run(const Plan& plan, const Bounds& bounds, const MakeSubject& make_subject,
         std::vector<Account>& accounts, Journal& journal) {
  return Crew(plan, bounds, make_subject, accounts, journal).run();
}

}  // namespace lorentz::fuzz
