#include "golden/production.hpp"

#include <fmt/format.h>

#include <charconv>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <unordered_set>

#include "golden/maker.hpp"

namespace lorentz::golden {
namespace {

constexpr std::uint64_t kBatch = cases::kCasesPerScene;

struct Made {
  std::string scene_line;
  Components components = 2;
  MadeRecord record;
};

using Batch = std::vector<Made>;

// The questions of one batch, all of which mostly share a scene.
Batch make_batch(const Order& order, std::uint64_t number) {
  Batch batch;
  std::optional<Maker> maker;
  std::string scene_line;
  for (std::uint64_t i = 0; i < kBatch; ++i) {
    const std::uint64_t index = number * kBatch + i;
    if (index >= order.set->most) break;
    const SetQuestion question = order.set->question(order.seed, index);
    scene_line.clear();
    append_scene_line(scene_line, question.scene);
    scene_line.pop_back();
    if (!maker || maker->scene_line() != scene_line)
      maker.emplace(question.scene, Others{}, order.set->precision);
    batch.push_back({scene_line, question.scene, maker->make(question.text, question.query)});
    batch.back().record.record.tags = question.tags;
  }
  return batch;
}

// Batches made by several threads, handed out in order. No more than a few are waiting at any time.
class BatchQueue {
 public:
  BatchQueue(const Order& order, std::uint64_t first) : order_(order), next_(first), wanted_(first) {
    for (std::uint64_t i = 0; i < order.jobs; ++i) threads_.emplace_back([this] { work(); });
  }
  ~BatchQueue() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  BatchQueue(const BatchQueue&) = delete;
  BatchQueue& operator=(const BatchQueue&) = delete;

  Batch next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || ready_.contains(wanted_); });
    if (failure_) std::rethrow_exception(failure_);
    Batch batch = std::move(ready_.extract(wanted_).mapped());
    ++wanted_;
    lock.unlock();
    changed_.notify_all();
    return batch;
  }

 private:
  void work() {
    for (std::unique_lock lock(mutex_);;) {
      changed_.wait(lock, [&] { return closed_ || failure_ || next_ < wanted_ + 4 * order_.jobs; });
      if (closed_ || failure_) return;
      const std::uint64_t number = next_++;
      lock.unlock();
      try {
        Batch batch = make_batch(order_, number);
        lock.lock();
        ready_.emplace(number, std::move(batch));
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        failure_ = std::current_exception();
      }
      changed_.notify_all();
    }
  }

  const Order& order_;
  std::uint64_t next_, wanted_;
  std::map<std::uint64_t, Batch> ready_;
  std::exception_ptr failure_;
  bool closed_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::thread> threads_;
};

// How far a production is. What a resumed one needs to go on as if nothing had happened.
struct ProductionState {
  std::uint64_t next_batch = 0;
  RecordCounts counts;
  std::string scene_line;  // the last one written
  std::unordered_set<std::uint64_t> ids;
};

// Of the sixteen hexadecimal digits that an id is.
std::uint64_t number_of(std::string_view id) {
  std::uint64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number, 16);
  return number;
}

void count(RecordCounts& counts, const MadeRecord& made) {
  ++counts.records;
  counts.walked += made.walked;
  switch (made.record.expect.outcome) {
    case Outcome::hit:
      ++counts.hits;
      break;
    case Outcome::inside:
      ++counts.insides;
      break;
    case Outcome::never:
      ++counts.nevers;
      break;
    default:
      ++counts.errors;
  }
}

// Makes what is missing; `write` gets the text of one batch at a time, and `state` says what is made with it.
void produce_rest(const Order& order, ProductionState& state,
                  const std::function<void(std::string_view)>& write, const OnProgress& progress) {
  BatchQueue queue(order, state.next_batch);
  while (state.counts.records < order.count) {
    std::string text;
    for (const Made& made : queue.next()) {
      const Record& record = made.record.record;
      if (state.counts.records == order.count || !state.ids.insert(number_of(record.id)).second) continue;
      if (made.scene_line != state.scene_line) {
        state.scene_line = made.scene_line;
        text += state.scene_line + '\n';
      }
      append_record_line(text, record, made.components);
      count(state.counts, made.record);
    }
    ++state.next_batch;
    write(text);
    if (progress) progress(state.counts.records);
  }
}

// A piece is what was made with a batch, in numbers, and the batch's text.
std::string piece_of(const RecordCounts& a, std::string_view text) {
  return fmt::format("{} {} {} {} {} {}\n{}", a.records, a.walked, a.hits, a.insides, a.nevers, a.errors,
                     text);
}

std::string text_in(const std::string& piece, ProductionState& state) {
  RecordCounts& a = state.counts;
  std::istringstream in(piece);
  in >> a.records >> a.walked >> a.hits >> a.insides >> a.nevers >> a.errors;
  if (!in || in.get() != '\n') throw InputError("is not a batch of records");
  const auto begin = static_cast<std::size_t>(in.tellg());
  constexpr std::string_view kId = "{\"id\":\"";
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(kId))
      state.ids.insert(number_of(line.substr(kId.size(), 16)));
    else
      state.scene_line = line;
  if (state.ids.size() != a.records) throw InputError("has another number of records than it says");
  ++state.next_batch;
  return piece.substr(begin);
}

}  // namespace

Header header_of(const Order& order) {
  const Set& set = *order.set;
  Header header{set.name, set.description, {}, LORENTZ_VERSION, order.count, {}, set.precision};
  const bool is_wide = set.precision == NumberFormat::binary64;
  header.generator = fmt::format("lorentz golden make --set {}{} --count {} --seed {}", set.family,
                                 is_wide ? "" : " --precision binary32", order.count, order.seed);
  for (const cases::Tag& tag : set.tags) header.tags.emplace_back(tag.name, tag.note);
  return header;
}

RecordCounts produce(const Order& order, const std::function<void(std::string_view)>& write,
                     const OnProgress& progress, runs::PieceStore* kept) {
  std::string header;
  append_header_line(header, header_of(order));
  write(header);
  ProductionState state;
  if (kept) kept->each([&](const std::string& piece) { write(text_in(piece, state)); });
  produce_rest(
      order, state,
      [&](std::string_view text) {
        write(text);
        if (kept) kept->add({piece_of(state.counts, text)});
      },
      progress);
  return state.counts;
}

runs::Plan plan_of(const Order& order) {
  std::string header;
  append_header_line(header, header_of(order));
  return {{"header", header}};
}

}  // namespace lorentz::golden
