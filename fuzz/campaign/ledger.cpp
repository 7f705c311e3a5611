#include "fuzz/campaign/ledger.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <tuple>
#include <utility>

namespace lorentz::fuzz {
namespace {

// Number of a target's stints that may be handed out and not recorded, for each thread.
constexpr std::size_t kAhead = 64;

// Stints of cheap cases are made longer, as long as they take no longer than this. Then most stints have all
// cases of a scene, which is prepared once, and a stop in a stint loses little. An answerer that takes many
// cases at once gets as many as take no longer than kSecondsOfMany, because another program's answers are
// awaited once per stint.
constexpr double kSecondsOfStint = 0.02, kSecondsOfMany = 0.25;
constexpr std::uint64_t kLongestStint = 1024;

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

}  // namespace

Ledger::Ledger(const Plan& plan, const Bounds& bounds, std::size_t threads, std::vector<TargetTally>& tallies,
               Journal& journal, const std::vector<Finding>& known)
    : plan_(plan),
      count_(bounds.count),
      first_(bounds.first),
      threads_(threads),
      most_shrinking_(most_shrinking(plan, bounds, threads)),
      tallies_(tallies),
      journal_(journal) {
  for (const cases::Target* target : plan.targets) {
    Queue& queue = queues_.emplace_back();
    for (const Finding& one : known) {
      // Shrinking that was cut short would be cut short again, unless the time is unlimited.
      const bool is_due =
          one.shrinking == Shrinking::due || (one.shrinking == Shrinking::cut_short && !bounds.limits_time());
      if (is_due && one.target == target->name()) queue.due.emplace(rank_of(one.kind), one);
    }
  }
}

// ---- handing out

// The first index that is not handed out.
std::uint64_t Ledger::next_index(const Queue& queue) const {
  return queue.places.empty() ? tallies_[target_of(queue)].next : queue.places.back().stint.end;
}

bool Ledger::has_cases(const Queue& queue) const {
  return !is_closing_ && next_index(queue) < count_ && queue.places.size() < kAhead * threads_;
}

// The target with the least time among those that have work. One that has more under way than others comes
// after them, because that time is not known yet.
Ledger::Queue* Ledger::next_queue() {
  const auto has_work = [&](const Queue& queue) { return has_cases(queue) || !queue.due.empty(); };
  std::size_t working = 0, under_way = 0;
  for (const Queue& queue : queues_)
    if (has_work(queue)) ++working, under_way += queue.under_way;
  if (working == 0) return nullptr;
  const auto turn = [&](const Queue& queue) {
    return std::tuple(!has_work(queue), queue.under_way > under_way / working, queue.seconds);
  };
  return &*std::ranges::min_element(queues_, {}, turn);
}

bool Ledger::shrinks_next(const Queue& queue) const {
  if (queue.due.empty() || !has_cases(queue)) return !queue.due.empty();
  const double share =
      queue.due.begin()->first < rank_of(name_of(Kind::undecided).words) ? kShareOfWrong : kShareOfOthers;
  return queue.in_shrinking == 0 && queue.shrinking_seconds <= share * queue.seconds;
}

Assignment Ledger::assign(Queue& queue, std::uint64_t batch_size) {
  ++queue.under_way;
  return shrinks_next(queue) ? assign_shrinking(queue) : assign_cases(queue, batch_size);
}

Assignment Ledger::assign_shrinking(Queue& queue) {
  const auto first = queue.due.begin();
  Assignment one{
      .stint = {target_of(queue), 0, 0}, .due = std::move(first->second), .most_seconds = most_shrinking_};
  queue.due.erase(first);
  ++queue.in_shrinking;
  return one;
}

// One case until the pace is known. Ends on a multiple of its length, so that stints share a scene where
// cases do.
Assignment Ledger::assign_cases(Queue& queue, std::uint64_t batch_size) {
  std::uint64_t cases = 1;
  const auto double_until = [&](std::uint64_t most, double most_seconds) {
    while (queue.pace > 0 && 2 * cases <= most && 2 * static_cast<double>(cases) * queue.pace <= most_seconds)
      cases *= 2;
  };
  double_until(batch_size, kSecondsOfMany);
  double_until(kLongestStint, kSecondsOfStint);
  const std::size_t target = target_of(queue);
  const std::uint64_t begin = next_index(queue), end = std::min((begin / cases + 1) * cases, count_);
  queue.places.push_back({{target, begin, end}});
  return {queue.places.back().stint, tallies_[target].sorts};
}

std::optional<Assignment> Ledger::take(std::uint64_t batch_size) {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    if (Queue* queue = next_queue()) return assign(*queue, batch_size);
    changed_.wait_for(lock, std::chrono::milliseconds(50));
  }
  return std::nullopt;
}

std::vector<Assignment> Ledger::take_some(std::size_t most, std::uint64_t batch_size) {
  const std::lock_guard lock(mutex_);
  std::vector<Assignment> some;
  while (some.size() < most && !stop_) {
    Queue* queue = next_queue();
    if (!queue) break;
    some.push_back(assign(*queue, batch_size));
  }
  return some;
}

// ---- taking back

void Ledger::hand_in(Done done) {
  const std::lock_guard lock(mutex_);
  Queue& queue = queues_[done.stint.target];
  --queue.under_way;
  queue.seconds += done.seconds;
  if (done.answerer_failed && (done.result || done.shrunk)) answerer_failed_ = true;
  if (const std::uint64_t cases = done.stint.end - done.stint.begin) {
    const double each = done.seconds / static_cast<double>(cases);
    queue.pace = queue.pace > 0 ? (queue.pace + each) / 2 : each;
    const auto place = std::ranges::lower_bound(queue.places, done.stint.begin, {},
                                                [](const Place& one) { return one.stint.begin; });
    place->result = std::move(done.result);
  } else {
    queue.shrinking_seconds += done.seconds;
    --queue.in_shrinking;
    if (done.shrunk) queue.shrunk.push_back(std::move(*done.shrunk));
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
  for (Queue& queue : queues_) has_new |= record(queue);
  if (has_new) changed_.notify_all();
  return !stop_ && !std::ranges::all_of(queues_, [&](const Queue& queue) { return is_complete(queue); });
}

bool Ledger::is_complete(const Queue& queue) const {
  return (is_closing_ || tallies_[target_of(queue)].next >= count_) && queue.due.empty() &&
         queue.in_shrinking == 0;
}

// Returns whether there is a new finding to shrink.
bool Ledger::record(Queue& queue) {
  const std::size_t target = target_of(queue), due_before = queue.due.size();
  std::vector<Finding> news = std::exchange(queue.shrunk, {});
  bool is_new = !news.empty();
  for (; !is_closing_ && !queue.places.empty() && queue.places.front().result; is_new = true) {
    record(queue, queue.places.front(), news);
    queue.places.pop_front();
  }
  if (is_new) journal_.record(*plan_.targets[target], tallies_[target], news);
  return queue.due.size() != due_before;
}

// Only now is it certain how many findings of each sort come before.
void Ledger::record(Queue& queue, Place& first, std::vector<Finding>& kept) {
  TargetTally& tally = tallies_[target_of(queue)];
  for (StintResult::Kept& one : first.result->kept) {
    if (tally.sorts[one.finding.sort] + one.ordinal > plan_.keep) continue;
    if (one.finding.shrinking == Shrinking::due) queue.due.emplace(rank_of(one.finding.kind), one.finding);
    kept.push_back(std::move(one.finding));
  }
  tally.add(first.result->met);
  tally.next = first.stint.end;
  is_closing_ |= first_ && !first.result->met.sorts.empty();
}

}  // namespace lorentz::fuzz
