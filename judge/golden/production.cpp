#include "judge/golden/production.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <unordered_set>

#include "judge/golden/maker.hpp"
#include "judge/golden/seen.hpp"

namespace lorentz::golden {

namespace {

constexpr std::uint64_t kBatch = cases::kCasesPerScene;

struct Made {
  std::string scene_line;
  Components components = 2;
  std::optional<MadeRecord> record;  // nothing: the question is left out
};

using Batch = std::vector<Made>;

// The number of questions.
std::uint64_t number_in(const Order& order) {
  return order.given ? order.given->questions.size() : order.set->most;
}

SetQuestion posed(const Order& order, std::uint64_t index) {
  return order.given ? order.given->questions[index] : order.set->question(order.seed, index);
}

NumberFormat precision_of(const Order& order) {
  return order.given ? order.given->header.precision : order.set->precision;
}

// Nothing if a given question cannot be proved.
std::optional<MadeRecord> make_record(const Maker& maker, const Order& order, const SetQuestion& question) {
  try {
    MadeRecord made = maker.make(question.text, question.query);
    if (order.given && order.given->look && !question.query) made.record.tags.emplace_back("invalid");
    if (order.given && order.given->look && question.query) {
      for (std::string& tag : tags_seen(question.scene, *question.query, made.record.expect, made.hardest))
        made.record.tags.push_back(std::move(tag));
    }
    made.record.tags.insert(made.record.tags.begin(), question.tags.begin(), question.tags.end());
    made.record.source_id = question.source_id;
    return made;
  } catch (const ProofTooLong&) {
    if (!order.given) throw;
    return std::nullopt;
  }
}

// The questions of one batch, most of which share a scene.
Batch make_batch(const Order& order, std::uint64_t number) {
  Batch batch;
  std::optional<Maker> maker;
  const std::uint64_t end = std::min(number_in(order), (number + 1) * kBatch);
  for (std::uint64_t index = number * kBatch; index < end; ++index) {
    const SetQuestion question = posed(order, index);
    const std::string scene_line = scene_line_of(question.scene);
    if (!maker || maker->scene_line() != scene_line)
      maker.emplace(question.scene, Others{}, precision_of(order));
    batch.push_back({scene_line, question.scene, make_record(*maker, order, question)});
  }
  return batch;
}

// Batches made by several threads, handed out in order. Only a few wait at any time.
class BatchQueue {
 public:
  explicit BatchQueue(const Order& order) : order_(order) {
    for (std::uint64_t i = 0; i < order.jobs; ++i)
      threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  }
  ~BatchQueue() {
    for (std::jthread& thread : threads_) thread.request_stop();
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
  void work(const std::stop_token& stop) {
    for (std::unique_lock lock(mutex_);;) {
      changed_.wait(lock, stop, [&] { return failure_ || next_ < wanted_ + 4 * order_.jobs; });
      if (stop.stop_requested() || failure_) return;
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
  std::uint64_t next_ = 0, wanted_ = 0;
  std::map<std::uint64_t, Batch> ready_;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<std::jthread> threads_;
};

// The number with the sixteen hexadecimal digits of an id.
std::uint64_t number_of(std::string_view id) {
  std::uint64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number, 16);
  return number;
}

void count(RecordCounts& counts, const MadeRecord& made) {
  ++counts.records;
  counts.needing_judge += needs_judge(made.record);
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

// Makes all records, and passes on the text of one batch at a time.
RecordCounts produce_lines(const Order& order, const Write& write, const OnProgress& progress) {
  BatchQueue queue(order);
  RecordCounts counts;
  std::string scene_line;  // the last one written
  std::unordered_set<std::uint64_t> ids;
  while (counts.records + counts.left_out < order.count) {
    std::string text;
    for (const Made& made : queue.next()) {
      if (!made.record) ++counts.left_out;
      if (!made.record) continue;
      const Record& record = made.record->record;
      if (counts.records == order.count || !ids.insert(number_of(record.id)).second) continue;
      if (made.scene_line != scene_line) {
        scene_line = made.scene_line;
        text += scene_line + '\n';
      }
      append_record_line(text, record, made.components);
      count(counts, *made.record);
    }
    write(text);
    if (progress) progress(counts.records);
  }
  return counts;
}

}  // namespace

bool GivenQuestions::add(SetQuestion question) {
  const auto [place, is_new] =
      by_id_.try_emplace(id_of(scene_line_of(question.scene), question.text), questions.size());
  if (is_new) {
    questions.push_back(std::move(question));
    return true;
  }
  std::vector<std::string>& tags = questions[place->second].tags;
  for (std::string& tag : question.tags)
    if (std::ranges::find(tags, tag) == tags.end()) tags.push_back(std::move(tag));
  return false;
}

Header header_of(const Order& order) {
  Header header;
  if (order.given) {
    header = order.given->header;
    if (order.given->look) header.tags.insert(header.tags.end(), seen_tags().begin(), seen_tags().end());
  } else {
    const Set& set = *order.set;
    header = {.name = set.name,
              .description = set.description,
              .version = LORENTZ_VERSION,
              .precision = set.precision};
    const bool is_wide = set.precision == NumberFormat::binary64;
    header.generator = fmt::format("lorentz golden make --set {}{} --count {} --seed {}", set.family,
                                   is_wide ? "" : " --precision binary32", order.count, order.seed);
    for (const cases::Tag& tag : set.tags) header.tags.emplace_back(tag.name, tag.note);
  }
  header.count = order.count;
  header.tags.emplace_back(kNeedsJudge, kNeedsJudgeNote);
  return header;
}

namespace {

std::string header_line(Order order, std::uint64_t count) {
  order.count = count;
  std::string line;
  append_header_line(line, header_of(order));
  return line;
}

}  // namespace

// For given questions the number of records is known only at the end.
RecordCounts produce(const Order& order, const Write& write, const OnProgress& progress) {
  if (!order.given) {
    write(header_line(order, order.count));
    return produce_lines(order, write, progress);
  }
  std::string all;
  const RecordCounts counts = produce_lines(
      order, [&](std::string_view text) { all += text; }, progress);
  write(header_line(order, counts.records));
  write(all);
  return counts;
}

}  // namespace lorentz::golden
