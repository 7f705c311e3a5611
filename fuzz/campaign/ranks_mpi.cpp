// Ranks by MPI. The only messages are a report from a rank and orders in return. Both sides poll for them and
// sleep in between, because a wait inside MPI keeps a processor busy.
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "fuzz/campaign/ledger.hpp"
#include "fuzz/campaign/ranks.hpp"
#include "runs/world_mpi.hpp"

// Boost.Serialization looks for it beside the type.
namespace lorentz::question {

template <class Archive>
void serialize(Archive& archive, Counts& counts, unsigned) {
  for (const CountName& name : kCountNames) archive& counts[name.count];
}

}  // namespace lorentz::question

namespace lorentz::fuzz {
namespace {

namespace mpi = boost::mpi;
using SteadyClock = std::chrono::steady_clock;

enum Message { kReport = 1, kOrders };

constexpr std::chrono::milliseconds kLook{2}, kLongestSilence{100};

// Number of stints that a rank keeps ready for each of its threads.
constexpr std::size_t kBatchesAhead = 4;

}  // namespace

// ---- what is sent, for Boost.Serialization

template <class Archive, class T>
void transfer(Archive& archive, std::optional<T>& value) {
  bool is_there = value.has_value();
  archive& is_there;
  if (!is_there) return value.reset();
  if (!value) value.emplace();
  archive&* value;
}

template <class Archive>
void serialize(Archive& archive, Stint& s, unsigned) {
  archive& s.target& s.begin& s.end;
}
template <class Archive>
void serialize(Archive& archive, TargetTally& a, unsigned) {
  archive& a.next& a.cases& a.variants& a.reworded& a.counts& a.stages& a.sorts& a.margin& a.margin_index;
}
template <class Archive>
void serialize(Archive& archive, CaseText& t, unsigned) {
  archive& t.scene& t.query& t.given& t.exact& t.departs;
  transfer(archive, t.margin);
}
template <class Archive>
void serialize(Archive& archive, Finding& f, unsigned) {
  archive& f.target& f.index& f.step& f.words& f.kind& f.sort& f.cause& f.text& f.shrunk;
  archive& f.shrinking& f.bits& f.complexity& f.tries;
}
template <class Archive>
void serialize(Archive& archive, StintResult::Kept& k, unsigned) {
  archive& k.finding& k.ordinal;
}
template <class Archive>
void serialize(Archive& archive, StintResult& r, unsigned) {
  archive& r.met& r.kept;
}
template <class Archive>
void serialize(Archive& archive, Done& d, unsigned) {
  archive& d.stint& d.seconds& d.answerer_failed;
  transfer(archive, d.result);
  transfer(archive, d.shrunk);
}
template <class Archive>
void serialize(Archive& archive, Assignment& a, unsigned) {
  archive& a.stint& a.known& a.most_seconds;
  transfer(archive, a.due);
}
namespace {

struct Report {
  std::vector<Done> done;
  std::uint64_t wants = 0, batch_size = 1;
  bool last = false;
  std::string failure;

  template <class Archive>
  void serialize(Archive& archive, unsigned) {
    archive& done& wants& batch_size& last& failure;
  }
};

struct Orders {
  std::vector<Assignment> assignments;
  bool stop = false;

  template <class Archive>
  void serialize(Archive& archive, unsigned) {
    archive& assignments& stop;
  }
};

// ---- another rank's threads take from here

class RemoteWork final : public WorkSource {
 public:
  explicit RemoteWork(unsigned jobs) : jobs_(jobs) {}

  std::optional<Assignment> take(std::uint64_t batch_size) override {
    std::unique_lock lock(mutex_);
    report_.batch_size = batch_size;
    changed_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
    if (stop_) return std::nullopt;
    Assignment next = std::move(waiting_.front());
    waiting_.pop_front();
    return next;
  }
  void hand_in(Done done) override {
    const std::lock_guard lock(mutex_);
    report_.done.push_back(std::move(done));
  }
  void fail(std::exception_ptr failure) override {
    const std::lock_guard lock(mutex_);
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      report_.failure = error.what();
    }
  }
  const std::atomic<bool>& stop() const override { return stop_; }

  bool has_news() {
    const std::lock_guard lock(mutex_);
    return !report_.done.empty() || !report_.failure.empty() || waiting_.size() < jobs_;
  }
  Report report() {
    const std::lock_guard lock(mutex_);
    const std::size_t most = kBatchesAhead * jobs_;
    report_.wants = most - std::min(most, waiting_.size());
    Report report = std::exchange(report_, {});
    report_.batch_size = report.batch_size;
    return report;
  }
  void obey(Orders orders) {
    const std::lock_guard lock(mutex_);
    for (Assignment& one : orders.assignments) waiting_.push_back(std::move(one));
    if (orders.stop) stop_ = true;
    changed_.notify_all();
  }

 private:
  const unsigned jobs_;
  std::deque<Assignment> waiting_;
  Report report_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace

void Ranks::serve(Ledger& ledger) {
  const mpi::communicator& world = mpi().world;
  while (const auto status = world.iprobe(mpi::any_source, kReport)) {
    Report report;
    world.recv(status->source(), kReport, report);
    for (Done& done : report.done) ledger.hand_in(std::move(done));
    if (!report.failure.empty()) ledger.fail(std::make_exception_ptr(std::runtime_error(report.failure)));
    dismissed_ += report.last;
    if (report.last) continue;
    Orders orders{ledger.take_some(report.wants, report.batch_size), ledger.stop()};
    world.send(status->source(), kOrders, orders);
  }
}

void Ranks::dismiss(Ledger& ledger) {
  while (dismissed_ < size() - 1) {
    serve(ledger);
    std::this_thread::sleep_for(kLook);
  }
}

void Ranks::work(const Plan& plan, unsigned jobs, const MakeAnswerer& make_answerer) {
  const mpi::communicator& world = mpi().world;
  RemoteWork work(jobs);
  Workers workers(plan, make_answerer, work, jobs);
  auto last_sent = SteadyClock::now() - kLongestSilence;
  while (!work.stop()) {
    std::this_thread::sleep_for(kLook);
    if (!work.has_news() && SteadyClock::now() - last_sent < kLongestSilence) continue;
    last_sent = SteadyClock::now();
    world.send(0, kReport, work.report());
    while (!world.iprobe(0, kOrders)) std::this_thread::sleep_for(kLook);
    Orders orders;
    world.recv(0, kOrders, orders);
    work.obey(std::move(orders));
  }
  workers.join();
  Report report = work.report();
  report.last = true;
  world.send(0, kReport, report);
}

}  // namespace lorentz::fuzz
