// The only messages are a report from a rank and orders in return, as pieces of JSON (src/exchange/json_piece.hpp).
// Both sides poll for them and sleep in between.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "fuzz/campaign/ledger.hpp"
#include "fuzz/campaign/ranks.hpp"
#include "src/exchange/json_piece.hpp"

namespace lorentz::fuzz {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{2}, kLongestSilence{100};

// Number of stints that a rank keeps ready for each of its threads, which may take 2 ms each.
constexpr std::size_t kStintsAhead = 8;

struct Report {
  std::vector<Done> done;
  std::uint64_t wants = 0, batch_size = 1;
  bool last = false;
  std::string failure;

  friend auto members_of(Report& self) {
    return std::tie(self.done, self.wants, self.batch_size, self.last, self.failure);
  }
};

using Orders = std::pair<std::vector<Assignment>, bool>;  // and whether to stop

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
    const std::size_t most = kStintsAhead * jobs_;
    report_.wants = most - std::min(most, waiting_.size());
    Report report = std::exchange(report_, {});
    report_.batch_size = report.batch_size;
    return report;
  }
  void obey(Orders orders) {
    const std::lock_guard lock(mutex_);
    for (Assignment& one : orders.first) waiting_.push_back(std::move(one));
    if (orders.second) stop_ = true;
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
  while (const auto message = received()) {
    Report report;
    json::read_piece(message->text, report);
    for (Done& done : report.done) ledger.hand_in(std::move(done));
    if (!report.failure.empty()) ledger.fail(std::make_exception_ptr(std::runtime_error(report.failure)));
    dismissed_ += report.last;
    if (report.last) continue;
    const Orders orders{ledger.take_some(report.wants, report.batch_size), ledger.stop()};
    send(message->from, 0, json::piece_of(orders));
  }
}

void Ranks::dismiss(Ledger& ledger) {
  while (dismissed_ < size() - 1) {
    serve(ledger);
    std::this_thread::sleep_for(kLook);
  }
}

void Ranks::work(const Plan& plan, unsigned jobs, const MakeAnswerer& make_answerer) {
  RemoteWork work(jobs);
  Workers workers(plan, make_answerer, work, jobs);
  auto last_sent = SteadyClock::now() - kLongestSilence;
  while (!work.stop()) {
    std::this_thread::sleep_for(kLook);
    if (!work.has_news() && SteadyClock::now() - last_sent < kLongestSilence) continue;
    last_sent = SteadyClock::now();
    send(0, 0, json::piece_of(work.report()));
    std::optional<Message> reply;
    while (!(reply = received())) std::this_thread::sleep_for(kLook);
    Orders orders;
    json::read_piece(reply->text, orders);
    work.obey(std::move(orders));
  }
  workers.join();
  Report report = work.report();
  report.last = true;
  send(0, 0, json::piece_of(report));
}

}  // namespace lorentz::fuzz
