#include "golden/production.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <charconv>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <unordered_set>

#include "golden/maker.hpp"
#include "src/problem/write_error.hpp"
#include "store/check.hpp"

namespace lorentz::golden {
namespace {

constexpr std::uint64_t kBatch = cases::kCasesPerScene;

struct Made {
  std::string scene_line;
  int dimension = 0;
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
    const Question question = order.set->question(order.seed, index);
    scene_line.clear();
    append_scene_line(scene_line, question.scene);
    scene_line.pop_back();
    if (!maker || maker->scene_line() != scene_line) maker.emplace(question.scene);
    batch.push_back({scene_line, question.scene.dimension, maker->make(question.text, question.query)});
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
      append_record_line(text, record, made.dimension);
      count(state.counts, made.record);
    }
    ++state.next_batch;
    write(text);
    if (progress) progress(state.counts.records);
  }
}

[[noreturn]] void fail(const std::string& path) {
  throw write_error(path, errno);
}

// The unfinished file, and beside it a note of how far it is, with the check of all its text. The note is
// replaced as a whole after each write, so what lies beyond it in the file is not there.
class PartFile {
 public:
  PartFile(const Order& order, const std::string& path)
      : path_(path), part_(path + ".part"), note_(path + ".part.note"), header_([&] {
          std::string line;
          append_header_line(line, header_of(order));
          return line;
        }()) {}
  ~PartFile() {
    if (file_) std::fclose(file_);
    close(lock_);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  // Goes on with what is there if it is of the same order, else begins anew.
  ProductionState open() {
    ProductionState state;
    std::error_code error;
    const auto there = std::filesystem::symlink_status(path_, error);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
      throw FileError(path_ + ": is no regular file; name another, or use standard output");
    lock_ = ::open(part_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (lock_ == -1) fail(part_);
    if (flock(lock_, LOCK_EX | LOCK_NB) != 0) throw FileError(part_ + ": another run is writing it");
    const bool resumed = read_note(state);
    if (::ftruncate(lock_, static_cast<off_t>(bytes_)) != 0) fail(part_);
    file_ = ::fdopen(::dup(lock_), "wb");
    if (!file_) fail(part_);
    if (!resumed) write(header_, state);
    return state;
  }

  void write(std::string_view text, const ProductionState& state) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
      fail(part_);
    bytes_ += text.size();
    check_ = store::check_of(text, check_);
    const RecordCounts& a = state.counts;
    const std::string fresh = note_ + ".new";
    std::ostringstream state_text;
    state_text << bytes_ << ' ' << check_ << ' ' << state.next_batch << ' ' << a.records << ' ' << a.walked
               << ' ' << a.hits << ' ' << a.insides << ' ' << a.nevers << ' ' << a.errors << " end\n";
    std::remove(fresh.c_str());  // no link is followed, and no file of another name is written
    const int note = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const std::string line = state_text.str();
    if (note == -1) fail(note_);
    const bool written = ::write(note, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    ::close(note);
    if (!written || std::rename(fresh.c_str(), note_.c_str()) != 0) fail(note_);
  }

  void finish() {
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    if (!closed || std::rename(part_.c_str(), path_.c_str()) != 0) fail(part_);
    std::remove(note_.c_str());
  }

 private:
  bool read_note(ProductionState& state) {
    std::ifstream note(note_);
    RecordCounts& a = state.counts;
    std::string end;
    if (!(note >> bytes_ >> check_ >> state.next_batch >> a.records >> a.walked >> a.hits >> a.insides >>
          a.nevers >> a.errors >> end) ||
        end != "end" || !read_part(state)) {
      state = {};
      bytes_ = 0;
      check_ = store::kCheckOfNothing;
      return false;
    }
    return true;
  }

  // The ids and the last scene of the part that the note speaks of.
  bool read_part(ProductionState& state) const {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(part_, error); error || size < bytes_) return false;
    std::ifstream part(part_);
    std::string line;
    if (!std::getline(part, line) || line + '\n' != header_) return false;
    std::uint64_t read = line.size() + 1, check = store::check_of(header_);
    constexpr std::string_view kId = "{\"id\":\"";
    while (read < bytes_ && std::getline(part, line)) {
      read += line.size() + 1;
      check = store::check_of(line + '\n', check);
      if (line.starts_with(kId))
        state.ids.insert(number_of(line.substr(kId.size(), 16)));
      else
        state.scene_line = line;
    }
    return read == bytes_ && check == check_ && state.ids.size() == state.counts.records;
  }

  std::string path_, part_, note_, header_;
  std::FILE* file_ = nullptr;
  int lock_ = -1;  // held on the part for as long as this lives
  std::uint64_t bytes_ = 0, check_ = store::kCheckOfNothing;
};

}  // namespace

Header header_of(const Order& order) {
  Header header{order.set->name, order.set->description, {}, LORENTZ_VERSION, order.count, {}};
  header.generator = "lorentz golden make --set " + order.set->name + " --count " +
                     std::to_string(order.count) + " --seed " + std::to_string(order.seed);
  for (const cases::Tag& tag : order.set->tags) header.tags.emplace_back(tag.name, tag.note);
  return header;
}

RecordCounts produce(const Order& order, const std::function<void(std::string_view)>& write,
                     const OnProgress& progress) {
  std::string header;
  append_header_line(header, header_of(order));
  write(header);
  ProductionState state;
  produce_rest(order, state, write, progress);
  return state.counts;
}

RecordCounts produce_file(const Order& order, const std::string& path, const OnProgress& progress) {
  PartFile part(order, path);
  ProductionState state = part.open();
  produce_rest(
      order, state, [&](std::string_view text) { part.write(text, state); }, progress);
  part.finish();
  return state.counts;
}

}  // namespace lorentz::golden
